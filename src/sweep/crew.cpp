#include "sweep/crew.hpp"

#include <algorithm>
#include <bit>
#include <limits>
#include <utility>

#include "sweep/point_run.hpp"

namespace clatter {
namespace {

constexpr Effects effects = kernels::complete(Damping::light, Forcing::regular);
using Kernel = Exact<double, effects>;

/// A number that is the same for the same stops in the same order, 0 without contact: as the lanes' kernel makes it.
class Trace {
 public:
  explicit Trace(double so_far) : value_(so_far) {}

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const Rest&) {}
  void impact(const Impact& impact) { value_ = 3 * value_ + (impact.side == Side::upper ? 2 : 1); }

  [[nodiscard]] double value() const { return value_; }

 private:
  double value_;
};

}  // namespace

/// A point in a lane.
class Crew::Seat {
 public:
  explicit Seat(const Task& task)
      : task_(task),
        exact_(task_.scene, stops_in_reach(task_.scene.stops, task_.effects)),
        search_(exact_, task_.scene, TakenBy::lanes) {}
  Seat(const Seat&) = delete;
  Seat& operator=(const Seat&) = delete;

  [[nodiscard]] const Task& task() const { return task_; }
  [[nodiscard]] const Stops& stops() const { return exact_.stops(); }

  /// What is known at the start.
  [[nodiscard]] std::optional<Observed> at_start() {
    return search_.at_section({.x = task_.scene.start.displacement, .v = task_.scene.start.velocity});
  }
  /// What is known at the section that the lane has passed.
  [[nodiscard]] std::optional<Observed> at_section(const Lanes& lanes, std::size_t lane) {
    search_.pass_period(std::bit_cast<std::uint64_t>(lanes.section_trace.lane[lane]));
    const double y = lanes.section_y.lane[lane], v = lanes.section_v.lane[lane] * lanes.rate.lane[lane];
    State<double> state{.x = task_.scene.oscillator.load + y, .v = v, .periods = ++sections_};
    for (const auto& [place, row] : {std::pair(stops().lower, &lanes.lower), std::pair(stops().upper, &lanes.upper)})
      if (y == row->lane[lane]) state.x = place;
    if (exact_.impacts() + lanes.impacts.lane[lane] > task_.scene.time.max_impacts)
      return failure(Outcome::event_budget);
    return search_.at_section(state);
  }
  [[nodiscard]] Observed failure(Outcome outcome) const { return search_.failure(outcome, {}); }

  /// Takes a stuck lane on by the scalar kernel: by two steps, or to the next section, where the turns become 1.
  [[nodiscard]] Outcome help(Lanes& lanes, std::size_t lane) {
    const Scene& scene = task_.scene;
    const LanePlace place = place_of(lanes, lane, scene);
    State<double> state{.x = place.x, .v = place.v, .turns = place.turns};
    if (place.x == stops().lower) state.left = Side::lower;
    if (place.x == stops().upper) state.left = Side::upper;
    if (lanes.left.lane[lane] == helped_left_) state = helped_to_;  // a lane can't hold a release or a short rise
    const double end = std::min(1.0, state.turns + 2 / lanes.period.lane[lane]);
    Trace met(lanes.trace.lane[lane]);
    const Outcome outcome = exact_.advance(state, end, 0, met);
    ++helped_;
    lanes.trace.lane[lane] = met.value();
    if (end == 1.0) {
      lanes.section_y.lane[lane] = state.x - scene.oscillator.load;
      lanes.section_v.lane[lane] = state.v / lanes.rate.lane[lane];
      lanes.section_trace.lane[lane] = std::exchange(lanes.trace.lane[lane], 0.0);
      lanes.arrived |= LaneSet{1} << lane;
      state.turns = 0;
    }
    put(lanes, lane, scene, {state.x, state.v, state.turns});
    helped_to_ = state, helped_left_ = lanes.left.lane[lane];
    return outcome;
  }
  /// Whether the scalar kernel alone would be quicker.
  [[nodiscard]] bool mostly_helped() const { return helped_ > 64 + 2 * sections_; }

  [[nodiscard]] PointResult result(const Observed& observed, double impacts, Workshop& workshop) const {
    PointResult result = Point(task_.scene, workshop, exact_).observe(observed);
    result.impacts += impacts;
    return result;
  }

 private:
  Task task_;
  Kernel exact_;
  SteadySearch<effects> search_;
  State<double> helped_to_{};                                      ///< where the scalar kernel left the lane
  double helped_left_ = std::numeric_limits<double>::quiet_NaN();  ///< its time to the next section then
  std::int64_t sections_ = 0, helped_ = 0;
};

Crew::Crew(VisitLanes visit, Workshop& workshop) : visit_(visit), workshop_(workshop) {}
Crew::~Crew() = default;

void Crew::run(const Next& next, const Take& take) {
  for (std::size_t lane = 0; lane < Row::width; ++lane) fill(lane, next, take);
  while (std::ranges::any_of(seats_, [](const auto& seat) { return seat != nullptr; })) {
    lanes_.arrived = lanes_.stuck = 0;
    visit_(lanes_);
    for (LaneSet left = lanes_.stuck; left != 0; left &= left - 1)
      help(static_cast<std::size_t>(std::countr_zero(left)), next, take);
    for (LaneSet left = lanes_.arrived; left != 0; left &= left - 1)
      look(static_cast<std::size_t>(std::countr_zero(left)), next, take);
  }
}

void Crew::fill(std::size_t lane, const Next& next, const Take& take) {
  while (const std::optional<Task> task = next()) {
    seats_[lane] = std::make_unique<Seat>(*task);
    seat(lanes_, lane, task->scene, seats_[lane]->stops());
    const auto found = seats_[lane]->at_start();
    if (!found) return;
    take(seats_[lane]->task(), seats_[lane]->result(*found, 0, workshop_));
  }
  seats_[lane].reset();
  vacate(lanes_, lane);
}

void Crew::finish(std::size_t lane, const Observed& observed, const Next& next, const Take& take) {
  const Seat& done = *seats_[lane];
  take(done.task(), done.result(observed, lanes_.impacts.lane[lane], workshop_));
  fill(lane, next, take);
}

void Crew::help(std::size_t lane, const Next& next, const Take& take) {
  const Outcome outcome = seats_[lane]->help(lanes_, lane);
  if (outcome == Outcome::completed && !seats_[lane]->mostly_helped()) return;
  lanes_.arrived &= ~(LaneSet{1} << lane);
  if (outcome != Outcome::completed) return finish(lane, seats_[lane]->failure(outcome), next, take);
  const Task task = seats_[lane]->task();
  run_batch({&task, 1}, workshop_, take);
  fill(lane, next, take);
}

void Crew::look(std::size_t lane, const Next& next, const Take& take) {
  if (const auto found = seats_[lane]->at_section(lanes_, lane)) finish(lane, *found, next, take);
}

}  // namespace clatter
