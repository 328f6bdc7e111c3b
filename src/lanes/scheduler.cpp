#include "lanes/scheduler.hpp"

#include <algorithm>
#include <utility>

namespace clatter::lanes {
namespace {

constexpr std::size_t most_waiting = 8 * LaneArray::width;

}  // namespace

Scheduler::Scheduler(InstructionSet arch, point::ThreadScratch& scratch, WorkQueue next, ResultSink take)
    : arch_(arch), scratch_(scratch), next_(std::move(next)), take_(std::move(take)) {}

void Scheduler::run() {
  for (;;) {
    std::size_t kind = kinds;
    while (kind > 0 && waiting_[kind - 1].empty()) --kind;
    if (kind == 0) {
      auto item = next_();
      if (!item) return;
      kind = 1 + kind_of(item->effects);
      waiting_[kind - 1].push_back(std::move(*item));
    }
    switch (kind - 1) {
      case kind_of(sprung):
        run_with<sprung>();
        break;
      case kind_of(unsprung):
        run_with<unsprung>();
        break;
      default:
        run_with<cushioned>();
    }
  }
}

template <Effects E>
void Scheduler::run_with() {
  BlockScheduler<E> blocks(
      arch_, scratch_, [this] { return next_of(kind_of(E)); }, take_);
  blocks.run();
  proved_ += blocks.proved(), refined_ += blocks.refined();
}

std::optional<point::WorkItem> Scheduler::next_of(std::size_t kind) {
  std::vector<point::WorkItem>& ready = waiting_[kind];
  if (!ready.empty()) {
    std::optional<point::WorkItem> item = std::move(ready.back());
    ready.pop_back();
    return item;
  }
  const auto full = [](const std::vector<point::WorkItem>& items) { return items.size() >= most_waiting; };
  while (std::ranges::none_of(waiting_, full)) {
    std::optional<point::WorkItem> item = next_();
    if (!item || kind_of(item->effects) == kind) return item;
    waiting_[kind_of(item->effects)].push_back(std::move(*item));
  }
  return std::nullopt;
}

}  // namespace clatter::lanes
