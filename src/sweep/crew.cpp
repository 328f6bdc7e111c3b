#include "sweep/crew.hpp"

#include <bit>
#include <utility>

#include "sweep/crew_member.hpp"

namespace clatter {
namespace {

/// The first lane of a set, which then is out of it.
std::size_t taken_from(LaneSet& set) {
  const auto lane = static_cast<std::size_t>(std::countr_zero(set));
  set &= set - 1;
  return lane;
}

constexpr std::uint64_t between_looks = 1 << 17;  ///< visits: some tenth of a second

}  // namespace

Crew::Crew(const Visits& visits, Workshop& workshop, Next next, Take take)
    : visits_(visits), workshop_(workshop), next_(std::move(next)), take_(std::move(take)) {}

Crew::~Crew() = default;

void Crew::run() {
  for (std::size_t lane = 0; lane < Row::width; ++lane) vacate(settling_.lanes, lane), vacate(observing_.lanes, lane);
  for (;;) {
    fill();
    if (settling_.taken + observing_.taken == 0) return;
    if (++visits_made_ % between_looks == 0) take_stock();
    const bool observe = observing_.taken == Row::width || settling_.taken == 0;  // a full bench costs no more
    if (observe) {
      visit(observing_, visits_.observed);
    } else {
      visit(settling_, visits_.plain);
    }
  }
}

/// Looks at points that are long at work between two sections: whether they have spent their budget, and how far all
/// have come.
void Crew::take_stock() {
  double shares = 0;
  for (Bench* const bench : {&settling_, &observing_})
    for (std::size_t lane = 0; lane < Row::width; ++lane) {
      if (!bench->members[lane]) continue;
      if (bench->members[lane]->has_spent_budget(bench->lanes.impacts.lane[lane])) {
        const std::unique_ptr<Member> left = leave(*bench, lane, bench->lanes.impacts.lane[lane]);
        take_(left->task(), left->result(workshop_));
        if (bench == &observing_) observe_next(lane);
      } else {
        shares += bench->members[lane]->share(bench->lanes, lane);
      }
    }
  if (workshop_.progress) workshop_.progress(shares);
}

/// Lets the next points settle in free lanes, unless many wait to be observed.
void Crew::fill() {
  for (std::size_t lane = 0; lane < Row::width && settling_.taken < Row::width && !exhausted_; ++lane)
    if (!settling_.members[lane] && waiting_.size() < Row::width) settle_next(lane);
}

void Crew::visit(Bench& bench, VisitLanes kernel) {
  bench.lanes.arrived = bench.lanes.stuck = 0;
  kernel(bench.lanes);
  // sections first: a lane that has passed one may have got stuck beyond it, which no longer matters if it is done
  look(bench);
  while (bench.lanes.stuck != 0) help(bench, taken_from(bench.lanes.stuck));
  look(bench);
}

/// Looks at the lanes that have passed a section.
void Crew::look(Bench& bench) {
  while (bench.lanes.arrived != 0) look(bench, taken_from(bench.lanes.arrived));
}

/// Takes a member off its lane, where it has met so many impacts.
std::unique_ptr<Crew::Member> Crew::leave(Bench& bench, std::size_t lane, double impacts) {
  bench.lanes.stuck &= ~(LaneSet{1} << lane);
  bench.members[lane]->add_impacts(impacts);
  --bench.taken;
  vacate(bench.lanes, lane);
  return std::move(bench.members[lane]);
}

void Crew::settle_next(std::size_t lane) {
  while (waiting_.size() < Row::width) {
    const std::optional<Task> task = next_();
    exhausted_ = !task;
    if (exhausted_) break;
    auto member = std::make_unique<Member>(*task);
    const auto found = member->begin(settling_.lanes, lane);
    if (!found) {
      settling_.members[lane] = std::move(member), ++settling_.taken;
      return;
    }
    if (member->can_observe(*found)) {
      settled(std::move(member));
    } else {
      take_(member->task(), member->result(workshop_));
    }
  }
}

/// Observes a member in a free lane, or lets it wait for one.
void Crew::settled(std::unique_ptr<Member> member) {
  waiting_.push_back(std::move(member));
  for (std::size_t lane = 0; lane < Row::width && !waiting_.empty(); ++lane)
    if (!observing_.members[lane]) observe_next(lane);
}

void Crew::observe_next(std::size_t lane) {
  if (waiting_.empty()) return;
  observing_.members[lane] = std::move(waiting_.back()), ++observing_.taken;
  waiting_.pop_back();
  observing_.members[lane]->begin_to_observe(observing_.lanes, lane);
}

void Crew::help(Bench& bench, std::size_t lane) {
  Member& member = *bench.members[lane];
  const bool observes = &bench == &observing_;
  const Outcome outcome = member.help(bench.lanes, lane);
  if (outcome == Outcome::completed && !member.needs_no_lane()) return;
  bench.lanes.arrived &= ~(LaneSet{1} << lane);
  const std::unique_ptr<Member> left = leave(bench, lane, bench.lanes.impacts.lane[lane]);
  if (observes) {
    take_(left->task(), left->result(workshop_));
    return observe_next(lane);
  }
  if (outcome == Outcome::completed) {
    run_batch({&left->task(), 1}, workshop_, take_);
  } else {
    (void)left->can_observe(left->failure(outcome));
    take_(left->task(), left->result(workshop_));
  }
}

void Crew::look(Bench& bench, std::size_t lane) {
  Member& member = *bench.members[lane];
  if (&bench == &observing_) {
    if (!member.ends(bench.lanes, lane)) return;
    take_(member.task(),
          member.needs_no_lane() ? member.result(workshop_) : member.result(bench.lanes, lane, workshop_));
    (void)leave(bench, lane, bench.lanes.section_impacts.lane[lane]);
    return observe_next(lane);
  }
  const auto found = member.at_section(bench.lanes, lane);
  if (!found) return;
  const bool in_lanes = member.can_observe(*found);
  std::unique_ptr<Member> left = leave(bench, lane, bench.lanes.section_impacts.lane[lane]);
  if (in_lanes) {
    settled(std::move(left));
  } else {
    take_(left->task(), left->result(workshop_));
  }
}

}  // namespace clatter
