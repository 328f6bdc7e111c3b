#include "stepping/moreau.hpp"

namespace clatter::stepping {

template <Effects E>
Outcome Moreau<E>::advance_long(State& state, double end, std::int64_t origin, Any& observer) {
  Stage<Moreau, Any> stage(*this, state, end, origin, observer);
  this->drive_ = this->constants().drive(this->phase(state)).sine;
  if constexpr (E.soft)
    if (state.within == Side::none) this->look_beyond(state, 0.0);  // a start beyond a soft stop's place is no touch
  if (!bounce_off(stage)) return Outcome::event_budget;
  while (end - state.phase_turns > 2 * epsilon<double>()) {
    this->report(state);
    if (!step(stage, this->next_turns(state.phase_turns, end))) return Outcome::event_budget;
  }
  state.phase_turns = end;
  return this->outcome_of(state);
}

template class Moreau<effect_sets::with_standing_stops(Damping::light, Forcing::regular)>;
template class Moreau<effect_sets::with_standing_stops(Damping::heavy, Forcing::regular)>;
template class Moreau<effect_sets::with_everything(Damping::light, Forcing::regular)>;
template class Moreau<effect_sets::with_everything(Damping::heavy, Forcing::regular)>;

}  // namespace clatter::stepping
