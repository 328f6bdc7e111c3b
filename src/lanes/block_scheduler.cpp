#include "lanes/block_scheduler.hpp"

#include <bit>
#include <type_traits>
#include <utility>

namespace clatter::lanes {
namespace {

/// The first lane of a set, removed from it.
std::size_t taken_from(LaneMask& set) {
  const auto lane = static_cast<std::size_t>(std::countr_zero(set));
  set &= set - 1;
  return lane;
}

constexpr int contacts_in_a_step = 16;              ///< of a block, if no lane has to report before
constexpr std::uint64_t between_reports = 1 << 14;  ///< steps of a block: some tenth of a second

}  // namespace

template <Effects E>
BlockScheduler<E>::BlockScheduler(InstructionSet arch, point::ThreadScratch& scratch, WorkQueue next, ResultSink take)
    : step_functions_(step_functions_of<E>(arch)), scratch_(scratch), next_(std::move(next)), take_(std::move(take)) {}

template <Effects E>
void BlockScheduler<E>::run() {
  for (std::size_t lane = 0; lane < LaneArray::width; ++lane)
    clear_lane(settling_.lanes, lane), clear_lane(observing_.lanes, lane);
  settling_.lanes.most_contacts = observing_.lanes.most_contacts = contacts_in_a_step;
  for (;;) {
    fill();
    if (settling_.taken + observing_.taken == 0) return;
    if (++steps_made_ % between_reports == 0) take_stock();
    const bool observe = observing_.taken == LaneArray::width || settling_.taken == 0;  // a full block costs no more
    if (observe) {
      step_block(observing_, step_functions_.observed);
    } else {
      step_block(settling_, step_functions_.plain);
    }
  }
}

/// Loads the next points into free lanes to settle, unless many wait to be observed.
template <Effects E>
void BlockScheduler<E>::fill() {
  for (std::size_t lane = 0; lane < LaneArray::width && settling_.taken < LaneArray::width && !exhausted_; ++lane)
    if (!settling_.tasks[lane] && waiting_.size() < LaneArray::width) settle_next(lane);
}

template <Effects E>
void BlockScheduler<E>::settle_next(std::size_t lane) {
  while (waiting_.size() < LaneArray::width) {
    const std::optional<point::WorkItem> item = next_();
    exhausted_ = !item;
    if (exhausted_) return;
    auto task = std::make_unique<SettleTask<E>>(*item);
    LaneView view = task->view(settling_.lanes, lane);
    auto settled = task->begin(view);
    if (!settled) {
      settling_.tasks[lane] = std::move(task), ++settling_.taken;
      return;
    }
    finish(std::move(*settled));
  }
}

/// Observes a point in a free lane or queues it for one, if lanes can do so; else in the scalar loop.
template <Effects E>
void BlockScheduler<E>::finish(SettledPoint<E> settled) {
  settled.observed = scratch_.decisions.decided(settled.item.problem, std::move(settled.observed));
  if (!lanes_can_observe(settled)) return put(settled.item, observe_in_scalar_loop(settled, scratch_));
  waiting_.push_back(std::make_unique<ObserveTask<E>>(settled));
  for (std::size_t lane = 0; lane < LaneArray::width && !waiting_.empty(); ++lane)
    if (!observing_.tasks[lane]) observe_next(lane);
}

/// Passes a result on; it may be the one that another point has waited for.
template <Effects E>
void BlockScheduler<E>::put(const point::WorkItem& item, point::PointResult&& result) {
  take_(item, std::move(result));
  exhausted_ = false;
}

template <Effects E>
void BlockScheduler<E>::observe_next(std::size_t lane) {
  if (waiting_.empty()) return;
  observing_.tasks[lane] = std::move(waiting_.back()), ++observing_.taken;
  waiting_.pop_back();
  LaneView view = observing_.view(lane);
  observing_.tasks[lane]->begin(view);
}

template <Effects E>
template <class Task>
void BlockScheduler<E>::step_block(Block<Task>& block, StepFunction step) {
  block.lanes.arrived = block.lanes.to_scalar = 0;
  step(block.lanes);
  // sections first: a lane that needs the scalar loop beyond its section doesn't if it is done there
  handle_sections(block);
  while (block.lanes.to_scalar != 0) fall_back(block, taken_from(block.lanes.to_scalar));
  handle_sections(block);
}

template <Effects E>
template <class Task>
void BlockScheduler<E>::handle_sections(Block<Task>& block) {
  while (block.lanes.arrived != 0) handle_section(block, taken_from(block.lanes.arrived));
}

template <Effects E>
void BlockScheduler<E>::handle_section(Block<SettleTask<E>>& block, std::size_t lane) {
  if (block.tasks[lane]->pass_section(block.view(lane))) look(lane);
}

/// Shows the search the sections that a lane has passed; returns whether its point goes on in the lane.
template <Effects E>
bool BlockScheduler<E>::look(std::size_t lane) {
  LaneView view = settling_.view(lane);
  SettleTask<E>& task = *settling_.tasks[lane];
  auto settled = task.look(view);
  if (settled) {
    leave(settling_, lane);
    finish(std::move(*settled));
  } else if (task.leaves_lane()) {
    hand_over(settling_, lane);
  } else {
    return true;
  }
  return false;
}

template <Effects E>
void BlockScheduler<E>::handle_section(Block<ObserveTask<E>>& block, std::size_t lane) {
  ObserveTask<E>& task = *block.tasks[lane];
  LaneView view = block.view(lane);
  if (!task.pass_section(view)) return;
  put(task.item(), task.result(view, scratch_));
  leave(block, lane);
}

template <Effects E>
void BlockScheduler<E>::fall_back(Block<SettleTask<E>>& block, std::size_t lane) {
  if (!look(lane)) return;
  SettleTask<E>& task = *block.tasks[lane];
  LaneView view = block.view(lane);
  const stepping::Outcome outcome = task.fall_back(view);
  if (outcome != stepping::Outcome::completed) return fail(block, lane, outcome);
  if (task.leaves_lane()) hand_over(block, lane);
}

/// Leaves a point to the scalar loop alone, from its start on.
template <Effects E>
void BlockScheduler<E>::hand_over(Block<SettleTask<E>>& block, std::size_t lane) {
  run_batch({&block.tasks[lane]->item(), 1}, scratch_,
            [this](const point::WorkItem& done, point::PointResult&& result) { put(done, std::move(result)); });
  leave(block, lane);
}

template <Effects E>
void BlockScheduler<E>::fall_back(Block<ObserveTask<E>>& block, std::size_t lane) {
  ObserveTask<E>& task = *block.tasks[lane];
  LaneView view = block.view(lane);
  if (task.fall_back(view) == stepping::Outcome::completed && !task.leaves_lane()) return;
  put(task.item(), observe_in_scalar_loop(task.settled(), scratch_));
  leave(block, lane);
}

/// Fails points that have spent their budget of impacts between two sections, and reports the progress of all.
template <Effects E>
void BlockScheduler<E>::take_stock() {
  const double shares = take_stock(settling_) + take_stock(observing_);
  if (scratch_.progress) scratch_.progress(shares);
}

template <Effects E>
template <class Task>
double BlockScheduler<E>::take_stock(Block<Task>& block) {
  double shares = 0;
  for (std::size_t lane = 0; lane < LaneArray::width; ++lane) {
    if (!block.tasks[lane]) continue;
    if constexpr (std::is_same_v<Task, SettleTask<E>>)
      if (!look(lane)) continue;
    const LaneView view = block.view(lane);
    if (block.tasks[lane]->has_spent_budget(view))
      fail(block, lane, stepping::Outcome::event_budget);
    else
      shares += block.tasks[lane]->share(view);
  }
  return shares;
}

template <Effects E>
template <class Task>
void BlockScheduler<E>::fail(Block<Task>& block, std::size_t lane, stepping::Outcome outcome) {
  const SettledPoint<E> failed = block.tasks[lane]->failed(outcome, block.view(lane));
  put(failed.item, observe_in_scalar_loop(failed, scratch_));
  leave(block, lane);
}

/// Takes a point off its lane; one that waits to be observed takes its place.
template <Effects E>
template <class Task>
void BlockScheduler<E>::leave(Block<Task>& block, std::size_t lane) {
  const LaneMask others = ~(LaneMask{1} << lane);
  block.lanes.arrived &= others, block.lanes.to_scalar &= others;
  block.tasks[lane].reset(), --block.taken;
  clear_lane(block.lanes, lane);
  if constexpr (std::is_same_v<Task, ObserveTask<E>>) observe_next(lane);
}

template class BlockScheduler<sprung>;
template class BlockScheduler<unsprung>;
template class BlockScheduler<cushioned>;

}  // namespace clatter::lanes
