#pragma once

#include <utility>
#include <variant>

#include "motion/dry_friction.hpp"
#include "motion/walls.hpp"
#include "observables/sensitivity/course.hpp"

namespace clatter::observables {

/// The oscillators that a main mass belongs to, alone and with a loose one that a wall presses: in its slips, in
/// contact with soft stops, and while something holds it.
template <class Number, Effects E>
class MainOscillators {
 public:
  /// `free`: that of the main mass alone.
  MainOscillators(const motion::ArcConstants<Number, E>& free, const BasicScene<Number>& scene)
      : free_(free),
        held_(Held::of(Number(0), Number(0), free.nu, Number(0), Number(0))),
        alone_(free, scene.friction, scene.stops),
        carrying_(of_both(free, scene)) {}

  /// Calls `function(constants)` with those of a stretch.
  template <class Function>
  void in_stretch(const Stretch& stretch, Function&& function) const {
    if (stretch.is_held) return function(held_);
    with_slips(stretch.wall, [&](const auto&, const auto& slips) {
      if (stretch.pressed == Side::none)
        function(slips.towards(stretch.ahead));
      else
        slips.in_contact(stretch.pressed, stretch.ahead, function);
    });
  }
  /// Calls `function(still, slips)` with the oscillator without friction and its slips, with what `wall` presses.
  template <class Function>
  void with_slips(Side wall, Function&& function) const {
    if (wall == Side::none) return function(free_, alone_);
    std::visit([&](const auto& both) { function(both.still, both.slips); }, carrying_);
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

  [[nodiscard]] static std::variant<Light, Heavy> of_both(const motion::ArcConstants<Number, E>& free,
                                                          const BasicScene<Number>& scene) {
    const auto make = [&]<class Of>() {
      const auto still = motion::carrying<decltype(Of::still)>(free, scene.loose);
      return Of{still,
                {still, motion::friction_of_both(scene.friction, scene.loose.ratio),
                 motion::stops_of_both(scene.stops, scene.loose.ratio)}};
    };
    if (motion::rotates_carrying(free, scene.loose)) return make.template operator()<Light>();
    return make.template operator()<Heavy>();
  }

  motion::ArcConstants<Number, E> free_;
  Held held_;  ///< no force moves the mass
  motion::Slips<Number, E> alone_;
  std::variant<Light, Heavy> carrying_;
};

}  // namespace clatter::observables
