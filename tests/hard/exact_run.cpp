#include "hard/exact_run.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <type_traits>

#include "motion/chatter.hpp"
#include "point/every_effect.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"
#include "support/told.hpp"

namespace clatter::hard {
namespace {

using Kind = ExactEvent::Kind;

/// The largest and the smallest displacement of the arcs shown so far.
class Extrema {
 public:
  void add(const FiftyDigits& x) { least_ = std::min(least_, x), most_ = std::max(most_, x); }

  /// An arc for a time. In a step its velocity is taken to have one zero at most; the verifier sees what this misses.
  template <class A>
  void add(const A& arc, const FiftyDigits& length) {
    add(arc.start().x);
    const FiftyDigits step = 1 / std::max(FiftyDigits(arc.constants().natural), FiftyDigits(arc.constants().nu));
    motion::Motion<FiftyDigits> before = arc.start();
    for (FiftyDigits begin = 0; begin < length; begin += step) {
      const FiftyDigits end = std::min(FiftyDigits(begin + step), length);
      const motion::Motion<FiftyDigits> after = arc.at(end);
      if ((before.v > 0) != (after.v > 0)) add(turning_point(arc, begin, end, before.v > 0));
      before = after;
    }
  }
  [[nodiscard]] const FiftyDigits& least() const { return least_; }
  [[nodiscard]] const FiftyDigits& most() const { return most_; }

 private:
  /// The displacement at which the velocity changes its sign, by Newton's method within what bisection leaves.
  template <class A>
  [[nodiscard]] static FiftyDigits turning_point(const A& arc, FiftyDigits from, FiftyDigits to, bool rises) {
    constexpr int most_iterations = 200;
    FiftyDigits s = (from + to) / 2;
    motion::Motion<FiftyDigits> there = arc.at(s);
    for (int iteration = 0; iteration < most_iterations && there.v != 0; ++iteration) {
      ((there.v > 0) == rises ? from : to) = s;
      const FiftyDigits newton = s - there.v / there.a, next = newton > from && newton < to ? newton : (from + to) / 2;
      if (abs(next - s) <= 4 * epsilon<FiftyDigits>() * (1 + abs(s))) break;
      s = next, there = arc.at(s);
    }
    return there.x;
  }

  FiftyDigits least_ = std::numeric_limits<FiftyDigits>::infinity(), most_ = -least_;
};

/// Records a run from its state, which has the digits that observers are not told.
template <class Integrator>
class Recorder {
 public:
  using State = motion::State<FiftyDigits>;
  using FreeArc = motion::Arc<FiftyDigits, Integrator::effects.arc()>;

  Recorder(const Scene& scene, const Integrator& integrator, const State& state)
      : scene_(scene), integrator_(integrator), state_(state) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    end_stay();
    extrema_.add(arc, FiftyDigits(length));
    if constexpr (std::is_same_v<A, FreeArc>) flight_ = arc, flight_begin_ = now();
  }
  void impact(const motion::Event& impact) {
    const FiftyDigits time = now();
    add({Kind::impact, impact.side, time, flight_->at(time - flight_begin_).v});
    events_.back().low = is_low(impact.side);
  }
  void touch(const motion::Event& touch) {
    add({touch.kind == motion::Event::Kind::touch ? Kind::touch : Kind::renewal, touch.side, now(), state_.v});
  }
  void separate(const motion::Event& separation) { add({Kind::separation, separation.side, now(), state_.v}); }
  void rest(const motion::Event& rest) {
    end_stay();
    const Side side = rest.side;
    const auto is_last = [&](Kind kind) {
      return !events_.empty() && events_.back().kind == kind && events_.back().side == side;
    };
    const auto goes_on = [&](Kind kind) { return is_last(kind) && events_.back().until == now(); };
    if (!rest.held && is_last(Kind::impact))
      begin_chatter(side);
    else if (!goes_on(Kind::rest) && (rest.held || !goes_on(Kind::chatter)))
      add({Kind::rest, side, now()});
    stays_ = true;
  }

  /// The run at its end.
  [[nodiscard]] ExactRun finish() {
    const bool cut = stays_ && events_.back().kind == Kind::chatter;
    end_stay();
    if (cut) throw std::runtime_error("a run ends within a chatter that is summed");
    extrema_.add(state_.x);
    return {std::move(events_), state_.x, state_.v, extrema_.least(), extrema_.most()};
  }

 private:
  [[nodiscard]] static bool lasts(const ExactEvent& event) {
    return event.kind == Kind::rest || event.kind == Kind::chatter;
  }
  [[nodiscard]] FiftyDigits now() const {
    return (FiftyDigits(state_.periods) + state_.phase_turns) * integrator_.period();
  }
  void add(const ExactEvent& event) {
    end_stay();
    extrema_.add(state_.x);
    events_.push_back(event);
  }
  void end_stay() {
    if (stays_) events_.back().until = now();
    stays_ = false;
  }
  /// Replaces the low impacts that are last by their chatter.
  void begin_chatter(Side side) {
    const auto is_other = [side](const ExactEvent& e) { return !(e.kind == Kind::impact && e.side == side && e.low); };
    const auto first_low = std::find_if(events_.rbegin(), events_.rend(), is_other).base();
    if (first_low != events_.end()) events_.erase(first_low + 1, events_.end());
    events_.push_back({Kind::chatter, side, events_.back().time});
  }
  /// Whether a run in double sums the chatter that a rebound begins.
  [[nodiscard]] bool is_low(Side side) const {
    const auto stop = motion::stop_at<FiftyDigits>(scene_.stops, side);
    const FiftyDigits low = motion::low_rebound<double>(0) * motion::displacements_beside(scene_, side);
    const auto press = contact_force(integrator_.constants(), stop, integrator_.phase(state_));
    return motion::chatter_time(integrator_.constants(), stop, press, FiftyDigits(-stop.into(state_.v)), low,
                                FiftyDigits(epsilon<double>()))
        .has_value();
  }

  const Scene& scene_;
  const Integrator& integrator_;
  const State& state_;
  std::vector<ExactEvent> events_{};
  Extrema extrema_{};
  std::optional<FreeArc> flight_{};  ///< the latest
  FiftyDigits flight_begin_{};
  bool stays_ = false;  ///< a rest or a chatter is last, whose end isn't known yet
};

template <Effects E>
ExactRun run_with(const Case& one) {
  using Integrator = stepping::Exact<FiftyDigits, E>;
  Integrator integrator(one.scene, limits_of(one.scene));
  motion::State<FiftyDigits> state;
  state.x = one.scene.start.displacement, state.v = one.scene.start.velocity;
  Recorder<Integrator> recorder(one.scene, integrator, state);
  const FiftyDigits turns = FiftyDigits(one.duration) / integrator.period();
  support::Told told(recorder);
  if (run_for(integrator, state, turns, told) != stepping::Outcome::completed)
    throw std::runtime_error(one.row + ", " + one.what + ": the run in 50 digits isn't completed");
  return recorder.finish();
}

template <Effects E>
ExactRun flight_with(const Case& one) {
  const stepping::Exact<FiftyDigits, E> integrator(one.scene);
  const auto& constants = integrator.constants();
  const FiftyDigits x = one.scene.start.displacement, v = one.scene.start.velocity, none = 0;
  const auto [sine, cosine] = integrator.phase({});
  const FiftyDigits a = constants.acceleration(constants.from_equilibrium(x, x, none), v, {sine, cosine});
  const motion::Arc<FiftyDigits, E.arc()> arc(constants, {none, x, v, a, sine, cosine});
  const motion::Motion<FiftyDigits> end = arc.at(FiftyDigits(one.duration));
  return {.x = end.x, .v = end.v};
}

}  // namespace

ExactRun exact_run(const Case& one) {
  return point::with_every_effect_but_own_motion(one.scene, [&]<Effects E>() { return run_with<E>(one); });
}

ExactRun exact_flight(const Case& one) {
  return point::with_every_effect_but_own_motion(one.scene, [&]<Effects E>() { return flight_with<E>(one); });
}

}  // namespace clatter::hard
