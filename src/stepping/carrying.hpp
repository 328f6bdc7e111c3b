#pragma once

#include <array>
#include <cmath>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "motion/walls.hpp"
#include "stepping/integration.hpp"
#include "stepping/other_mass.hpp"

/// A main mass with a loose one: its housing, and both as one while a wall presses that, or friction holds it.
namespace clatter::stepping {

/// What makes a loose mass move with the main one, against leaving it to one side: the force of a wall, or friction.
template <class Number>
struct Pressing {
  Side wall;    ///< that of the force, opposite to the side to which the mass would leave
  Number load;  ///< y'' without that force, but with the friction at its level
};

/// The loop with another main mass: both as one, or one beside which the loose mass flies or slides. Modes take it in
/// place of the loop.
template <class Loop, class Mass, bool both_as_one>
class WithMass : public WithOtherMass<Loop, Mass> {
  using Base = WithOtherMass<Loop, Mass>;

 public:
  using Number = typename Base::Number;
  using State = typename Base::State;
  static constexpr bool carries = both_as_one;

  WithMass(Loop& loop, const Mass& mass, const motion::Walls<Number>& walls) : Base(loop, mass), walls_(walls) {}

  [[nodiscard]] const auto& walls() const { return walls_; }  ///< of a slide those with its friction
  /// Calls `function(loop)` with that of a main mass beside which the loose one flies, or slides to a side.
  template <class Function>
  decltype(auto) beside(Side towards, Function&& function) const {
    return this->loop_.beside(towards, std::forward<Function>(function));
  }
  template <class Stage>
  [[nodiscard]] Outcome run_carrying(Stage& stage) const {
    return this->loop_.run_carrying(stage);
  }
  [[nodiscard]] bool loses() const { return this->loop_.loses(); }
  [[nodiscard]] const auto& held_constants(bool with_loose) const { return this->loop_.held_constants(with_loose); }

  [[nodiscard]] auto held(const State& state) const { return this->mass_.held(state, push(state)); }
  [[nodiscard]] auto holding_at(const State& state) const { return this->mass_.holding_at(state, push(state)); }
  [[nodiscard]] auto holding_stop(const State& state) const { return this->mass_.holding_stop(state, push(state)); }
  /// The force of a soft wall on the main mass, without which that is known.
  [[nodiscard]] Number push(const State& state) const { return both_as_one ? Number(0) : walls_.push(state.loose); }

 private:
  const motion::Walls<Number>& walls_;
};

/// The main mass with a loose one that moves with it: (1 + eps) times as heavy, and drawn by eps y'', too (eq. 71).
/// Its damping is of a class of its own.
template <class Number, Effects E>
class CarryingMass {
 public:
  CarryingMass(const MainMass<Number, E>& alone, const BasicScene<Number>& scene) : of_(of(alone, scene)) {}

  /// Calls `function(mass)`.
  template <class Function>
  decltype(auto) with_mass(Function&& function) const {
    return std::visit(std::forward<Function>(function), of_);
  }

 private:
  template <Damping damping, Forcing forcing>
  [[nodiscard]] static constexpr Effects effects() {
    Effects effects = E;
    effects.damping = damping, effects.forcing = forcing;
    return effects;
  }
  using Light = MainMass<Number, effects<Damping::light, Forcing::secular>()>;
  using Heavy = MainMass<Number, effects<Damping::heavy, Forcing::regular>()>;
  static constexpr bool rotates = E.damping == Damping::light;  ///< alone, and so with more mass
  using Any = std::conditional_t<rotates, std::variant<Light>, std::variant<Light, Heavy>>;

  [[nodiscard]] static Any of(const MainMass<Number, E>& alone, const BasicScene<Number>& scene) {
    const Number& ratio = scene.loose.ratio;
    const auto make = [&]<class Mass>() -> Any {
      return Mass(motion::carrying<typename Mass::Constants>(alone.constants(), scene.loose),
                  motion::stops_of_both(alone.stops(), ratio), motion::friction_of_both(scene.friction, ratio),
                  alone.start_turns());
    };
    if constexpr (!rotates)
      if (!motion::rotates_carrying(alone.constants(), scene.loose)) return make.template operator()<Heavy>();
    return make.template operator()<Light>();
  }

  Any of_;
};

/// The constants of a main mass that something holds: no force moves it.
template <class Number>
using HeldConstants =
    motion::ArcConstants<Number, Effects{.damping = Damping::heavy, .forcing = Forcing::regular, .stiffness = true}>;

/// A main mass beside which the loose one slides to a side: friction draws it along.
template <class Number, Effects E>
struct Slide {
  Slide(const MainMass<Number, E>& alone, const BasicScene<Number>& scene, Side towards)
      : walls(motion::Walls<Number>::of_slide(scene.loose, towards)),
        mass(motion::drawn(alone.constants(), Number(scene.loose.friction), towards), alone.stops(), scene.friction,
             alone.start_turns()) {}

  motion::Walls<Number> walls;
  MainMass<Number, E> mass;
};

/// The housing of a loose mass, and the main mass that carries it.
template <class Number, Effects E>
class Housing {
 public:
  Housing(const MainMass<Number, E>& alone, const BasicScene<Number>& scene)
      : walls(scene.loose),
        carrying(alone, scene),
        loses(alone.loses() || walls.rule.loses() || walls.is_rough()),
        held_{unmoved(alone), unmoved(alone)} {
    held_[1].carried = scene.loose.ratio;
    if (!walls.is_rough()) return;
    for (const Side towards : {Side::lower, Side::upper}) slides_.emplace_back(alone, scene, towards);
  }

  /// The main mass beside which a loose one that rubs slides to a side.
  [[nodiscard]] const Slide<Number, E>& slide(Side towards) const { return slides_[index_of(towards)]; }

  /// Those of the main mass alone, and with the loose one, while something holds it.
  [[nodiscard]] const HeldConstants<Number>& held(bool carries) const { return held_[carries ? 1 : 0]; }

  motion::Walls<Number> walls;
  CarryingMass<Number, E> carrying;
  bool loses;  ///< impacts, or friction, take energy, so that chatter ends

 private:
  [[nodiscard]] static HeldConstants<Number> unmoved(const MainMass<Number, E>& alone) {
    const auto& of = alone.constants();
    auto constants = HeldConstants<Number>::of(Number(0), Number(0), of.nu, Number(0), Number(0), of.shape);
    constants.period = alone.period();
    return constants;
  }

  std::array<HeldConstants<Number>, 2> held_;
  std::vector<Slide<Number, E>> slides_{};  ///< [side]; none if nothing rubs
};
/// In place of it without a loose mass.
struct NoHousing {
  template <class Mass, class Scene>
  NoHousing(const Mass&, const Scene&) {}
};

}  // namespace clatter::stepping
