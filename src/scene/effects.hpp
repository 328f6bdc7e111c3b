#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <tuple>

#include "scene/oscillator.hpp"
#include "scene/scene.hpp"

namespace clatter {
inline namespace scene {

/// h = 0, 0 < h^2 < k, h^2 = k, h^2 > k: no decay, a decaying rotation, its limit, two exponentials. Without a spring
/// (k <= 0) motion is always the sum of two exponentials, one of which doesn't decay.
enum class Damping : std::uint8_t { none, light, critical, heavy };

/// f = 0, away from resonance, at it or so near that the response is nearly secular.
enum class Forcing : std::uint8_t { none, regular, secular };

/// The effects that a motion has. As a template argument they keep absent effects out of the code, so these cost
/// nothing.
struct Effects {
  Damping damping = Damping::none;
  Forcing forcing = Forcing::none;
  bool load = false;                  ///< a constant force
  bool lower = false, upper = false;  ///< a stop in reach
  bool dissipation = false;           ///< speed is lost at a stop in reach: R < 1
  bool rest = false;                  ///< chatter and rest: a stop in reach may be pressed
  bool stiffness = false;             ///< a spring of stiffness k other than 1, or none
  bool soft = false;                  ///< a soft stop in reach
  bool friction = false;              ///< dry friction
  bool loose = false;                 ///< a loose mass between walls that the main mass carries
  bool own_motion = false;            ///< a stop in reach that moves by itself

  [[nodiscard]] constexpr bool stops() const { return lower || upper; }

  /// The effects that arcs between impacts depend on.
  [[nodiscard]] constexpr Effects arc() const {
    return {.damping = damping, .forcing = forcing, .stiffness = stiffness};
  }

  friend constexpr bool operator==(const Effects&, const Effects&) = default;
};

/// Whether code compiled for `all` simulates every effect in `some`.
[[nodiscard]] constexpr bool contains(const Effects& all, const Effects& some) {
  const bool decays_twice = some.damping >= Damping::critical;
  const bool damping =
      decays_twice ? all.damping == Damping::heavy : all.damping <= Damping::light && all.damping >= some.damping;
  const bool stiffness = all.stiffness == some.stiffness || ((all.soft || all.loose) && all.stiffness);
  return damping && stiffness && all.forcing >= some.forcing && all.load >= some.load && all.lower >= some.lower &&
         all.upper >= some.upper && all.dissipation >= some.dissipation && all.rest >= some.rest &&
         all.soft >= some.soft && all.friction >= some.friction && all.loose == some.loose &&
         all.own_motion >= some.own_motion;
}

namespace effect_sets {

[[nodiscard]] constexpr Effects free_of_stops(Damping damping, Forcing forcing) {
  return {.damping = damping, .forcing = forcing, .load = true};
}
[[nodiscard]] constexpr Effects complete(Damping damping, Forcing forcing) {
  return {.damping = damping,
          .forcing = forcing,
          .load = true,
          .lower = true,
          .upper = true,
          .dissipation = true,
          .rest = true};
}
[[nodiscard]] constexpr Effects of_any_stiffness(Damping damping, Forcing forcing) {
  Effects effects = complete(damping, forcing);
  effects.stiffness = true;
  return effects;
}
[[nodiscard]] constexpr Effects with_soft_stops(Damping damping, Forcing forcing) {
  Effects effects = of_any_stiffness(damping, forcing);
  effects.soft = true;
  return effects;
}
/// All that a mass without a loose one can have but stops that move by themselves.
[[nodiscard]] constexpr Effects with_standing_stops(Damping damping, Forcing forcing) {
  Effects effects = with_soft_stops(damping, forcing);
  effects.friction = true;
  return effects;
}
[[nodiscard]] constexpr Effects with_friction(Damping damping, Forcing forcing) {
  Effects effects = with_standing_stops(damping, forcing);
  effects.own_motion = true;
  return effects;
}
/// The main mass has no stops. While a wall presses the loose mass the two move as one, on a spring of another k.
[[nodiscard]] constexpr Effects with_loose_mass(Damping damping, Forcing forcing) {
  return {.damping = damping, .forcing = forcing, .load = true, .stiffness = true, .loose = true};
}

/// A loose mass, and a main mass with stops of any kind and friction.
[[nodiscard]] constexpr Effects with_everything(Damping damping, Forcing forcing) {
  Effects effects = with_standing_stops(damping, forcing);
  effects.loose = true;
  return effects;
}

}  // namespace effect_sets

/// The compiled sets of effects, the cheaper before the dearer. An effect has sets without it if leaving it out saves
/// 5 % or more of a run. The others cost less to carry: the load (one addition), the second stop (one check a step, not
/// in every evaluation), dissipation (one multiplication an impact), chatter and rest (one comparison an impact), and
/// critical damping, which is rare. A stiffness other than 1 has two sets that contain all the rest: points with k > 0
/// are run with k = 1, in other units of time, so only those without a spring or with an unstable one need them.
/// Soft stops need them, too, as the mass moves on another spring while it is in contact; and so does friction, which
/// has two sets of its own, as it divides each flight into slips; these serve stops that move by themselves, too. A
/// loose mass has two, too: its motion has twice as many numbers, and other events; and two more if its main mass has
/// stops or friction. src/scene/README.md has the cost of each effect.
inline constexpr std::array compiled_effects{
    effect_sets::free_of_stops(Damping::none, Forcing::none),
    effect_sets::free_of_stops(Damping::light, Forcing::regular),
    effect_sets::free_of_stops(Damping::heavy, Forcing::regular),
    effect_sets::free_of_stops(Damping::light, Forcing::secular),
    effect_sets::complete(Damping::none, Forcing::none),
    effect_sets::complete(Damping::light, Forcing::none),
    effect_sets::complete(Damping::none, Forcing::regular),
    effect_sets::complete(Damping::light, Forcing::regular),
    effect_sets::complete(Damping::none, Forcing::secular),
    effect_sets::complete(Damping::light, Forcing::secular),
    effect_sets::complete(Damping::heavy, Forcing::none),
    effect_sets::complete(Damping::heavy, Forcing::regular),
    effect_sets::of_any_stiffness(Damping::light, Forcing::secular),
    effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular),
    effect_sets::with_soft_stops(Damping::light, Forcing::secular),
    effect_sets::with_soft_stops(Damping::heavy, Forcing::regular),
    effect_sets::with_friction(Damping::light, Forcing::secular),
    effect_sets::with_friction(Damping::heavy, Forcing::regular),
    effect_sets::with_loose_mass(Damping::light, Forcing::secular),
    effect_sets::with_loose_mass(Damping::heavy, Forcing::regular),
    effect_sets::with_everything(Damping::light, Forcing::secular),
    effect_sets::with_everything(Damping::heavy, Forcing::regular),
};

/// The cheapest compiled set that contains the effects: an index of `compiled_effects`.
[[nodiscard]] constexpr std::size_t effect_set_of(const Effects& effects) {
  std::size_t set = 0;
  while (!contains(compiled_effects[set], effects)) ++set;
  return set;
}

/// Whether one set of effects stands before another in lists: by the cost of their compiled sets, else in a fixed
/// order.
[[nodiscard]] inline bool cheaper(const Effects& one, const Effects& other) {
  const auto key = [](const Effects& e) {
    return std::tuple(effect_set_of(e), e.damping, e.forcing, e.stiffness, e.load, e.lower, e.upper, e.dissipation,
                      e.rest, e.soft, e.friction, e.loose, e.own_motion);
  };
  return key(one) < key(other);
}

/// Distance of i nu from the oscillator's roots below which forced response and transient are formed together (eq. 11):
/// at this distance each is up to 1/(2 * distance) times the force, and so would be the rounding error of their sum.
inline constexpr double secular_distance = 1.0 / 16.0;

/// h^2/k as it decides the class of free motion; a rotation is below 1. Without a spring there is none.
[[nodiscard]] constexpr bool rotates(const Oscillator& oscillator) {
  return oscillator.damping * oscillator.damping < oscillator.stiffness;
}

/// Whether the arcs of an oscillator need the sets of any stiffness: its own is another, or its force is no sine.
[[nodiscard]] constexpr bool is_general(const Oscillator& oscillator) {
  return oscillator.stiffness != 1.0 || !oscillator.shape.is_sine();
}

/// Every effect that an oscillator with this damping and stiffness can have; from h = 1/16 on there is no resonance.
[[nodiscard]] constexpr Effects all_effects(const Oscillator& oscillator) {
  const double h = oscillator.damping;
  if (is_general(oscillator))
    return rotates(oscillator) ? effect_sets::of_any_stiffness(Damping::light, Forcing::secular)
                               : effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular);
  if (h >= 1.0) return effect_sets::complete(Damping::heavy, Forcing::regular);
  return effect_sets::complete(Damping::light, h >= secular_distance ? Forcing::regular : Forcing::secular);
}

/// Whether a main mass has stops or dry friction.
[[nodiscard]] inline bool has_events_of_its_own(const Scene& scene) {
  return is_finite(scene.stops.lower) || is_finite(scene.stops.upper) || has_friction(scene.friction);
}

/// Every effect that a scene can have.
[[nodiscard]] inline Effects all_effects(const Scene& scene) {
  const bool rotates = clatter::rotates(scene.oscillator);
  if (has_loose_mass(scene.loose)) {
    if (!has_events_of_its_own(scene))
      return rotates ? effect_sets::with_loose_mass(Damping::light, Forcing::secular)
                     : effect_sets::with_loose_mass(Damping::heavy, Forcing::regular);
    return rotates ? effect_sets::with_everything(Damping::light, Forcing::secular)
                   : effect_sets::with_everything(Damping::heavy, Forcing::regular);
  }
  if (has_friction(scene.friction) || move_by_themselves(scene.stops))
    return rotates ? effect_sets::with_friction(Damping::light, Forcing::secular)
                   : effect_sets::with_friction(Damping::heavy, Forcing::regular);
  if (!has_soft_stop(scene.stops)) return all_effects(scene.oscillator);
  return rotates ? effect_sets::with_soft_stops(Damping::light, Forcing::secular)
                 : effect_sets::with_soft_stops(Damping::heavy, Forcing::regular);
}

[[nodiscard]] constexpr Damping damping_of(const Oscillator& oscillator) {
  const double h = oscillator.damping, k = oscillator.stiffness;
  if (is_general(oscillator)) {
    if (!rotates(oscillator)) return h * h == k && k > 0 ? Damping::critical : Damping::heavy;
    return h == 0.0 ? Damping::none : Damping::light;
  }
  return h == 0.0 ? Damping::none : h < 1.0 ? Damping::light : h == 1.0 ? Damping::critical : Damping::heavy;
}

[[nodiscard]] Forcing forcing_of(const Oscillator& oscillator);

[[nodiscard]] constexpr bool every_scene_has_a_set() {
  for (const double h : {0.0, secular_distance / 2, secular_distance, 1.0, 2.0})
    for (const Forcing forcing : {Forcing::none, Forcing::regular, Forcing::secular}) {
      const bool exists = forcing != Forcing::secular || h < secular_distance;
      if (exists && !contains(all_effects({.damping = h}), effect_sets::complete(damping_of({.damping = h}), forcing)))
        return false;
    }
  return true;
}
static_assert(every_scene_has_a_set());

namespace detail {

template <std::size_t candidate, class Function>
decltype(auto) with_effect_set(std::size_t set, Function&& function) {
  if constexpr (candidate + 1 < compiled_effects.size()) {
    if (set != candidate) return with_effect_set<candidate + 1>(set, static_cast<Function&&>(function));
  }
  return function.template operator()<compiled_effects[candidate]>();
}

}  // namespace detail

/// Calls `function.operator()<set>()` for the cheapest compiled set that contains the effects.
template <class Function>
decltype(auto) with_effects(const Effects& effects, Function&& function) {
  return detail::with_effect_set<0>(effect_set_of(effects), static_cast<Function&&>(function));
}

/// The effects that general methods simulate in every scene; damping only says how small changes of a motion decay.
[[nodiscard]] constexpr Effects general_effects(const Oscillator& oscillator) {
  const double h = oscillator.damping;
  if (is_general(oscillator))
    return effect_sets::of_any_stiffness(rotates(oscillator) ? Damping::light : Damping::heavy, Forcing::regular);
  const Damping damping = h == 0 ? Damping::none : h < 1 ? Damping::light : Damping::heavy;
  return effect_sets::complete(damping, Forcing::regular);
}

/// The same for a scene, which may have soft stops, friction or a loose mass.
[[nodiscard]] inline Effects general_effects(const Scene& scene) {
  const Damping damping = rotates(scene.oscillator) ? Damping::light : Damping::heavy;
  if (has_loose_mass(scene.loose))
    return has_events_of_its_own(scene) ? effect_sets::with_everything(damping, Forcing::regular)
                                        : effect_sets::with_loose_mass(damping, Forcing::regular);
  if (has_friction(scene.friction)) return effect_sets::with_standing_stops(damping, Forcing::regular);
  if (!has_soft_stop(scene.stops)) return general_effects(scene.oscillator);
  return effect_sets::with_soft_stops(damping, Forcing::regular);
}

/// Calls `function.operator()<set>()` for one of the sets that general methods, which take no stops that move by
/// themselves, are compiled with: two without a loose mass and two with it. Each contains all effects of its scenes:
/// beside their evaluations of the equation no effect costs anything worth leaving it out.
template <class Function>
decltype(auto) with_general_effects(const Scene& scene, Function&& function) {
  if (has_loose_mass(scene.loose)) {
    if (rotates(scene.oscillator))
      return function.template operator()<effect_sets::with_everything(Damping::light, Forcing::regular)>();
    return function.template operator()<effect_sets::with_everything(Damping::heavy, Forcing::regular)>();
  }
  if (rotates(scene.oscillator))
    return function.template operator()<effect_sets::with_standing_stops(Damping::light, Forcing::regular)>();
  return function.template operator()<effect_sets::with_standing_stops(Damping::heavy, Forcing::regular)>();
}

/// Calls `function.operator()<set>()` for an oscillator between any rigid stops: one of the twelve complete sets.
template <class Function>
decltype(auto) with_any_stops(const Oscillator& oscillator, Function&& function) {
  if (is_general(oscillator)) {
    if (rotates(oscillator))
      return function.template operator()<effect_sets::of_any_stiffness(Damping::light, Forcing::secular)>();
    return function.template operator()<effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular)>();
  }
  const Damping damping = damping_of(oscillator);
  const Forcing forcing = forcing_of(oscillator);
  const auto with_damping = [&]<Damping d>() -> decltype(auto) {
    if (forcing == Forcing::none) return function.template operator()<effect_sets::complete(d, Forcing::none)>();
    if constexpr (d != Damping::heavy)
      if (forcing == Forcing::secular)
        return function.template operator()<effect_sets::complete(d, Forcing::secular)>();
    return function.template operator()<effect_sets::complete(d, Forcing::regular)>();
  };
  if (damping == Damping::none) return with_damping.template operator()<Damping::none>();
  if (damping == Damping::light) return with_damping.template operator()<Damping::light>();
  return with_damping.template operator()<Damping::heavy>();
}

/// The same for a scene, which may have soft stops and friction.
template <class Function>
decltype(auto) with_any_stops(const Scene& scene, Function&& function) {
  if (has_friction(scene.friction) || move_by_themselves(scene.stops)) {
    if (rotates(scene.oscillator))
      return function.template operator()<effect_sets::with_friction(Damping::light, Forcing::secular)>();
    return function.template operator()<effect_sets::with_friction(Damping::heavy, Forcing::regular)>();
  }
  if (!has_soft_stop(scene.stops)) return with_any_stops(scene.oscillator, static_cast<Function&&>(function));
  if (rotates(scene.oscillator))
    return function.template operator()<effect_sets::with_soft_stops(Damping::light, Forcing::secular)>();
  return function.template operator()<effect_sets::with_soft_stops(Damping::heavy, Forcing::regular)>();
}

}  // namespace scene
}  // namespace clatter
