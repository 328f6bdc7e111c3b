#pragma once

#include <array>
#include <cstddef>
#include <utility>
#include <variant>

#include "motion/dry_friction.hpp"
#include "motion/walls.hpp"
#include "observables/sensitivity/course.hpp"

namespace clatter::observables {

/// The oscillators that a main mass belongs to, alone, beside a loose one that slides to a side, and with one that it
/// carries: in its slips, in contact with soft stops, and while something holds it.
template <class Number, Effects E>
class MainOscillators {
 public:
  using Constants = motion::ArcConstants<Number, E>;

  /// `free`: that of the main mass alone.
  MainOscillators(const Constants& free, const BasicScene<Number>& scene)
      : held_(Held::of(Number(0), Number(0), free.nu, Number(0), Number(0), free.shape)),
        alone_{beside(free, scene, Side::lower), beside(free, scene, Side::none), beside(free, scene, Side::upper)},
        carrying_(of_both(free, scene)) {}

  /// Calls `function(constants)` with those of a stretch.
  template <class Function>
  void in_stretch(const Stretch& stretch, Function&& function) const {
    if (stretch.is_held) return function(held_);
    with_slips(stretch, [&](const auto&, const auto& slips) {
      if (stretch.pressed == Side::none)
        function(slips.towards(stretch.ahead));
      else
        slips.in_contact(stretch.pressed, stretch.ahead, function);
    });
  }
  /// Calls `function(still, slips)` with the oscillator of a stretch without friction of the main mass, and its slips.
  template <class Function>
  void with_slips(const Stretch& stretch, Function&& function) const {
    const auto call = [&](const auto& of) { function(of.still, of.slips); };
    if (stretch.carries) return std::visit(call, carrying_);
    call(alone_[static_cast<std::size_t>(1 + sign_of(stretch.slides_to))]);
  }

 private:
  template <Damping damping, Forcing forcing>
  static constexpr Effects effects{.damping = damping, .forcing = forcing, .stiffness = true};
  using Held = motion::ArcConstants<Number, effects<Damping::heavy, Forcing::regular>>;
  template <Effects of>
  struct Both {
    motion::ArcConstants<Number, of> still;  ///< without friction
    motion::Slips<Number, of> slips;
  };
  using Light = Both<effects<Damping::light, Forcing::secular>>;
  using Heavy = Both<effects<Damping::heavy, Forcing::regular>>;

  [[nodiscard]] static Both<E> beside(const Constants& free, const BasicScene<Number>& scene, Side slides_to) {
    const Constants still = slides_to == Side::none ? free : motion::drawn(free, scene.loose.friction, slides_to);
    return {still, {still, scene.friction, scene.stops}};
  }
  [[nodiscard]] static std::variant<Light, Heavy> of_both(const Constants& free, const BasicScene<Number>& scene) {
    const auto make = [&]<class Of>() {
      const auto still = motion::carrying<decltype(Of::still)>(free, scene.loose);
      return Of{still,
                {still, motion::friction_of_both(scene.friction, scene.loose.ratio),
                 motion::stops_of_both(scene.stops, scene.loose.ratio)}};
    };
    if (motion::rotates_carrying(free, scene.loose)) return make.template operator()<Light>();
    return make.template operator()<Heavy>();
  }

  Held held_;                     ///< no force moves the mass
  std::array<Both<E>, 3> alone_;  ///< beside a loose one that slides to the lower side, flies, slides to the upper one
  std::variant<Light, Heavy> carrying_;
};

}  // namespace clatter::observables
