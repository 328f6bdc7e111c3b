#include "lanes/scalar_fallback.hpp"

#include <algorithm>
#include <optional>

#include "lanes/observed.hpp"

namespace clatter::lanes {
namespace {

/// Observes, as in any other run, what the scalar loop does for a lane.
class LaneObserver {
 public:
  LaneObserver(LaneView& lane, bool observes, double frequency) : lane_(lane) {
    if (observes) observed_ = Observed{.jumps{frequency, lane.highest_harmonic()}};
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (observed_) observed_->extrema.arc(arc, begin, length);
    if constexpr (A::effects.stiffness)
      if (arc.constants().stop.side != Side::none) lane_.add_to_log_area(-2 * arc.constants().stop.damping * length);
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.lasts()) rested_ = true, held_by_ = event.held ? event.side : held_by_;
    const bool is_impact = event.kind == Kind::impact;
    if (is_impact || event.kind == Kind::touch || event.kind == Kind::renewal) lane_.add_to_itinerary(event.side);
    if (!is_impact || !observed_) return;
    if (!observed_->first) observed_->first = event;
    observed_->extrema.event(event), observed_->impacts.event(event), observed_->jumps.impact(event);
  }

  /// Adds it to what the lane has seen.
  void finish() {
    if (observed_) lane_.include(*observed_);
  }
  [[nodiscard]] bool rested() const { return rested_; }
  [[nodiscard]] Side held_by() const { return held_by_; }  ///< the stop of the last rest

 private:
  LaneView& lane_;
  bool rested_ = false;
  Side held_by_ = Side::none;
  std::optional<Observed> observed_;
};

}  // namespace

template <Effects E>
stepping::Outcome ScalarFallback<E>::advance(LaneView& lane) {
  const LaneState now = lane.state();
  motion::State<double> state;
  state.x = now.x, state.v = now.v, state.phase_turns = now.phase_turns;
  if (now.x == loop_.stops().lower) state.from_stop = Side::lower;
  if (now.x == loop_.stops().upper) state.from_stop = Side::upper;
  if (lane.mark() == mark_) state = end_;  // a lane can't hold a release or a short offset
  if constexpr (E.soft)
    if (now.within != Side::none)
      state.within = state.from_stop = now.within, state.pressed = now.pressed, state.offset = now.offset;
  double end = std::min(1.0, state.phase_turns + lane.turns_of_two_steps());
  LaneObserver observer(lane, observes_, loop_.constants().nu);
  stepping::Outcome outcome = loop_.advance(state, end, 0, observer);
  // all motion from the same release is the same: so that it is so to the last bit, it goes on to the section here
  if (outcome == stepping::Outcome::completed && observer.rested())
    outcome = loop_.advance(state, end = 1.0, 0, observer);
  observer.finish();
  ++calls_, rested_ = rested_ || observer.rested();
  if (observer.held_by() != Side::none) held_by_ = observer.held_by();
  double between = lane.sections_between();
  if (end == 1.0) {
    between = between == 0 ? lane.pass_section(state.x, state.v) : between - 1;
    state.phase_turns = 0;
  }
  lane.set_state({state.x, state.v, state.phase_turns, state.within, state.pressed, state.offset}, between);
  end_ = state, mark_ = lane.mark();
  return outcome;
}

template class ScalarFallback<sprung>;
template class ScalarFallback<unsprung>;
template class ScalarFallback<cushioned>;

}  // namespace clatter::lanes
