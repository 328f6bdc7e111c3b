#pragma once

#include <utility>

#include "stepping/integration.hpp"
#include "stepping/main_mass.hpp"

namespace clatter::stepping {

/// The loop with another main mass, which modes take in place of the loop.
template <class Loop, class Mass>
class WithOtherMass {
 public:
  using Number = typename Loop::Number;
  using State = motion::State<Number>;
  static constexpr Effects effects = Mass::effects;
  static constexpr bool carries = false;

  WithOtherMass(Loop& loop, const Mass& mass) : loop_(loop), mass_(mass) {}

  [[nodiscard]] auto& method() const { return loop_.method(); }
  [[nodiscard]] bool count_impact() const { return loop_.count_impact(); }
  [[nodiscard]] static Outcome outcome_at(const motion::Crossing<Number>& crossing) {
    return Loop::outcome_at(crossing);
  }
  [[nodiscard]] static bool finite(const Number& x) { return Loop::finite(x); }

  [[nodiscard]] const auto& constants() const { return mass_.constants(); }
  [[nodiscard]] const auto& stops() const { return mass_.stops(); }
  [[nodiscard]] const auto& slips() const { return mass_.slips(); }
  [[nodiscard]] const Number& period() const { return mass_.period(); }
  [[nodiscard]] const Number& start_turns() const { return mass_.start_turns(); }
  [[nodiscard]] bool has_soft_stops() const { return mass_.has_soft_stops(); }
  [[nodiscard]] bool is_rough() const { return mass_.is_rough(); }
  [[nodiscard]] auto phase(const State& state) const { return mass_.phase(state); }
  [[nodiscard]] auto held(const State& state) const { return mass_.held(state); }
  [[nodiscard]] auto holding_at(const State& state) const { return mass_.holding_at(state); }
  [[nodiscard]] auto holding_stop(const State& state) const { return mass_.holding_stop(state); }
  [[nodiscard]] Number anchor(const State& state) const { return mass_.anchor(state); }
  [[nodiscard]] Number shortest_hop() const { return mass_.shortest_hop(); }
  template <class Of>
  [[nodiscard]] auto motion(const Of& constants, const State& state, const Number& released = Number(0)) const {
    return mass_.motion(constants, state, released);
  }
  template <class Function>
  decltype(auto) in_contact(Side side, Function&& function) const {
    return mass_.in_contact(side, std::forward<Function>(function));
  }

 protected:
  Loop& loop_;
  const Mass& mass_;
};

}  // namespace clatter::stepping
