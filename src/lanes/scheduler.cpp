#include "lanes/scheduler.hpp"

#include <bit>
#include <utility>

#include "lanes/lane_task.hpp"

namespace clatter::lanes {
namespace {

/// The first lane of a set, removed from it.
std::size_t taken_from(LaneMask& set) {
  const auto lane = static_cast<std::size_t>(std::countr_zero(set));
  set &= set - 1;
  return lane;
}

constexpr std::uint64_t between_reports = 1 << 17;  ///< steps of a block: some tenth of a second

}  // namespace

Scheduler::Scheduler(const StepFunctions& step_functions, point::ThreadScratch& scratch, WorkQueue next,
                     ResultSink take)
    : step_functions_(step_functions), scratch_(scratch), next_(std::move(next)), take_(std::move(take)) {}

Scheduler::~Scheduler() = default;

void Scheduler::run() {
  for (std::size_t lane = 0; lane < LaneArray::width; ++lane)
    clear_lane(settling_.lanes, lane), clear_lane(observing_.lanes, lane);
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

/// Fails points that have spent their budget of impacts between two sections, and reports the progress of all.
void Scheduler::take_stock() {
  double shares = 0;
  for (Block* const block : {&settling_, &observing_})
    for (std::size_t lane = 0; lane < LaneArray::width; ++lane) {
      if (!block->tasks[lane]) continue;
      if (block->tasks[lane]->fail_if_budget_is_spent(block->lanes.impacts.lane[lane])) {
        const std::unique_ptr<LaneTask> left = leave(*block, lane, block->lanes.impacts.lane[lane]);
        take_(left->item(), left->result(scratch_));
        if (block == &observing_) observe_next(lane);
      } else {
        shares += block->tasks[lane]->share(block->lanes, lane);
      }
    }
  if (scratch_.progress) scratch_.progress(shares);
}

/// Loads the next points into free lanes to settle, unless many wait to be observed.
void Scheduler::fill() {
  for (std::size_t lane = 0; lane < LaneArray::width && settling_.taken < LaneArray::width && !exhausted_; ++lane)
    if (!settling_.tasks[lane] && waiting_.size() < LaneArray::width) settle_next(lane);
}

void Scheduler::step_block(Block& block, StepFunction step) {
  block.lanes.arrived = block.lanes.to_scalar = 0;
  step(block.lanes);
  // sections first: a lane that needs the scalar loop beyond its section doesn't if it is done there
  handle_sections(block);
  while (block.lanes.to_scalar != 0) scalar_fallback(block, taken_from(block.lanes.to_scalar));
  handle_sections(block);
}

/// Handles the lanes that have passed a section.
void Scheduler::handle_sections(Block& block) {
  while (block.lanes.arrived != 0) handle_section(block, taken_from(block.lanes.arrived));
}

/// Takes a point off its lane, in which it has met `impacts` impacts.
std::unique_ptr<Scheduler::LaneTask> Scheduler::leave(Block& block, std::size_t lane, double impacts) {
  block.lanes.to_scalar &= ~(LaneMask{1} << lane);
  block.tasks[lane]->add_impacts(impacts);
  --block.taken;
  clear_lane(block.lanes, lane);
  return std::move(block.tasks[lane]);
}

void Scheduler::settle_next(std::size_t lane) {
  while (waiting_.size() < LaneArray::width) {
    const std::optional<point::WorkItem> item = next_();
    exhausted_ = !item;
    if (exhausted_) break;
    auto task = std::make_unique<LaneTask>(*item);
    const auto found = task->begin(settling_.lanes, lane);
    if (!found) {
      settling_.tasks[lane] = std::move(task), ++settling_.taken;
      return;
    }
    task->keep(*found);
    if (task->lanes_can_observe()) {
      observe_or_queue(std::move(task));
    } else {
      take_(task->item(), task->result(scratch_));
    }
  }
}

/// Observes a point in a free lane, or queues it for one.
void Scheduler::observe_or_queue(std::unique_ptr<LaneTask> task) {
  waiting_.push_back(std::move(task));
  for (std::size_t lane = 0; lane < LaneArray::width && !waiting_.empty(); ++lane)
    if (!observing_.tasks[lane]) observe_next(lane);
}

void Scheduler::observe_next(std::size_t lane) {
  if (waiting_.empty()) return;
  observing_.tasks[lane] = std::move(waiting_.back()), ++observing_.taken;
  waiting_.pop_back();
  observing_.tasks[lane]->begin_to_observe(observing_.lanes, lane);
}

void Scheduler::scalar_fallback(Block& block, std::size_t lane) {
  LaneTask& task = *block.tasks[lane];
  const bool observes = &block == &observing_;
  const stepping::Outcome outcome = task.scalar_fallback(block.lanes, lane);
  if (outcome == stepping::Outcome::completed && !task.leaves_lane()) return;
  block.lanes.arrived &= ~(LaneMask{1} << lane);
  const std::unique_ptr<LaneTask> left = leave(block, lane, block.lanes.impacts.lane[lane]);
  if (observes) {
    take_(left->item(), left->result(scratch_));
    return observe_next(lane);
  }
  if (outcome == stepping::Outcome::completed) {
    run_batch({&left->item(), 1}, scratch_, take_);
  } else {
    left->keep(left->failure(outcome));
    take_(left->item(), left->result(scratch_));
  }
}

void Scheduler::handle_section(Block& block, std::size_t lane) {
  LaneTask& task = *block.tasks[lane];
  if (&block == &observing_) {
    if (!task.pass_section(block.lanes, lane)) return;
    take_(task.item(), task.leaves_lane() ? task.result(scratch_) : task.result(block.lanes, lane, scratch_));
    (void)leave(block, lane, block.lanes.section_impacts.lane[lane]);
    return observe_next(lane);
  }
  const auto found = task.at_section(block.lanes, lane);
  if (!found) return;
  task.keep(*found);
  std::unique_ptr<LaneTask> left = leave(block, lane, block.lanes.section_impacts.lane[lane]);
  if (left->lanes_can_observe()) {
    observe_or_queue(std::move(left));
  } else {
    take_(left->item(), left->result(scratch_));
  }
}

}  // namespace clatter::lanes
