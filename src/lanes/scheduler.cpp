#include "lanes/scheduler.hpp"

#include <utility>

namespace clatter::lanes {
namespace {

constexpr std::size_t most_waiting = 8 * LaneArray::width;

}  // namespace

Scheduler::Scheduler(InstructionSet arch, point::ThreadScratch& scratch, WorkQueue next, ResultSink take)
    : arch_(arch), scratch_(scratch), next_(std::move(next)), take_(std::move(take)) {}

void Scheduler::run() {
  for (;;) {
    if (waiting_[false].empty() && waiting_[true].empty()) {
      auto item = next_();
      if (!item) return;
      const bool stiffness = item->effects.stiffness;
      waiting_[stiffness].push_back(std::move(*item));
    }
    if (waiting_[true].empty()) {
      run_with<sprung>();
    } else {
      run_with<unsprung>();
    }
  }
}

template <Effects E>
void Scheduler::run_with() {
  BlockScheduler<E> blocks(
      arch_, scratch_, [this] { return next_with(E.stiffness); }, take_);
  blocks.run();
  proved_ += blocks.proved(), refined_ += blocks.refined();
}

std::optional<point::WorkItem> Scheduler::next_with(bool stiffness) {
  std::vector<point::WorkItem>&ready = waiting_[stiffness], &others = waiting_[!stiffness];
  if (!ready.empty()) {
    std::optional<point::WorkItem> item = std::move(ready.back());
    ready.pop_back();
    return item;
  }
  while (others.size() < most_waiting) {
    std::optional<point::WorkItem> item = next_();
    if (!item || item->effects.stiffness == stiffness) return item;
    others.push_back(std::move(*item));
  }
  return std::nullopt;
}

}  // namespace clatter::lanes
