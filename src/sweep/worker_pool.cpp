#include "sweep/worker_pool.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "lanes/run_in_lanes.hpp"
#include "lanes/scheduler.hpp"
#include "sweep/chains.hpp"
#include "sweep/parallel.hpp"

namespace clatter::sweep {
namespace {

/// Chains whose results are stored before those of other slabs: all, or of a great many points some that take a few ten
/// megabytes.
std::size_t slab_of(const Share& share) {
  constexpr std::size_t many = 1UL << 22U, slab = 1UL << 18U;  // points
  return share.points() <= many ? share.count() : slab / share.length() + 1;
}

/// The work on the points with the same effects.
WorkStats& work_with(const Effects& effects, std::vector<WorkStats>& work) {
  const auto same = std::ranges::find(work, effects, &WorkStats::effects);
  return same != work.end() ? *same : work.emplace_back(WorkStats{.effects = effects});
}

void add(WorkStats& sum, const point::PointResult& result) {
  ++sum.points, ++sum.found_by[static_cast<std::size_t>(result.found_by)];
  sum.impacts += result.impacts, sum.periods += result.periods, sum.evaluations += result.evaluations;
}

void add(WorkStats& sum, const WorkStats& part) {
  sum.points += part.points;
  for (std::size_t i = 0; i < part.found_by.size(); ++i) sum.found_by[i] += part.found_by[i];
  sum.impacts += part.impacts, sum.periods += part.periods, sum.evaluations += part.evaluations;
}

/// An item whose effects aren't known yet; a function of its own, in which GCC doesn't clear the item before it fills
/// it.
point::WorkItem begun(std::size_t chain, std::size_t position, const Sweep& sweep, std::size_t point) {
  return {chain, position, problem_at(sweep, point)};
}

}  // namespace

WorkerPool::WorkerPool(const Sweep& sweep, const Share& share, const RunOptions& options, int threads,
                       ResultStore& store, ChainStates& states, std::size_t restored)
    : sweep_(sweep),
      share_(share),
      see_(options.see),
      store_(store),
      states_(states),
      progress_(options, static_cast<std::size_t>(threads), share.points(), restored),
      chunk_(sweep.follow ? 1
                          : std::clamp<std::size_t>(share_.count() / (64 * static_cast<std::size_t>(threads)), 1, 64)),
      chunks_((share_.count() + chunk_ - 1) / chunk_, (slab_of(share) + chunk_ - 1) / chunk_),
      most_branches_((share_.count() + static_cast<std::size_t>(threads) - 1) / static_cast<std::size_t>(threads)),
      arch_(options.arch),
      in_lanes_(runs_in_lanes(sweep, options.arch)),
      mirror_images_(sweep),
      has_whole_pairs_(mirror_images_.exist() && share.points() == size(sweep)),
      scratches_(static_cast<std::size_t>(threads)),
      work_(static_cast<std::size_t>(threads)) {
  for (std::size_t thread = 0; options.progress && thread < scratches_.size(); ++thread)
    scratches_[thread].progress = [this, thread](double part) { progress_.add_part(thread, part); };
  const observables::FourierScratch fourier = observables::Harmonics::scratch_for(sweep.problem.observe);
  for (point::ThreadScratch& scratch : scratches_) scratch.fourier = fourier.for_another_thread();
  for (std::size_t point = 0; has_whole_pairs_ && restored > 0 && point < share_.count(); ++point)
    if (const auto original = mirror_images_.original_of(point))
      if (!states_.is_finished(point) && states_.is_saved(*original)) bereft_.push_back(point);
}

void WorkerPool::run() {
  on_each_thread(static_cast<int>(scratches_.size()), [this](std::size_t thread) { run_thread(thread); });
}

std::vector<WorkStats> WorkerPool::work() const {
  std::vector<WorkStats> sum;
  for (const std::vector<WorkStats>& of_thread : work_)
    for (const WorkStats& part : of_thread) add(work_with(part.effects, sum), part);
  std::ranges::sort(sum, cheaper, &WorkStats::effects);
  return sum;
}

void WorkerPool::run_thread(std::size_t thread) noexcept {
  try {
    if (in_lanes_) {
      run_lanes(thread);
    } else {
      while (const auto chunk = next_chunk()) run_chunk(*chunk, thread);
    }
  } catch (...) {
    const std::lock_guard lock(mutex_);
    failure_ = std::current_exception();
    stopped_ = true;
  }
}

std::optional<WorkerPool::Chunk> WorkerPool::next_chunk() {
  for (;;) {
    const std::size_t turn = turn_.fetch_add(1);
    if (stopped_ || turn >= chunks_.turns()) return std::nullopt;
    const auto number = chunks_.number(turn);
    if (!number) continue;
    return Chunk{*number * chunk_, std::min((*number + 1) * chunk_, share_.count())};
  }
}

point::WorkItem WorkerPool::item_of(std::size_t chain, std::size_t position, const std::optional<point::End>& end,
                                    const Units& units_of_end) const {
  const std::size_t point = share_.point(chain, position);
  point::WorkItem item = begun(chain, position, sweep_, mirror_images_.original_of(point).value_or(point));
  if (sweep_.follow) start_from(item.problem, end, units_of_end);
  item.effects = effects_of(item.problem);
  return item;
}

void WorkerPool::run_lanes(std::size_t thread) {
  std::vector<point::WorkItem> ready;  // next points of chains that have been begun
  std::size_t begun = 0, ended = 0;    // chains
  const lanes::ResultSink take = [&](const point::WorkItem& item, point::PointResult&& result) {
    if (auto successor = store(item, std::move(result), thread))
      ready.push_back(std::move(*successor));
    else
      ++ended;
  };
  Chunk chunk{0, 0};
  const auto next_chain = [&]() -> std::optional<std::size_t> {
    if (sweep_.follow && begun - ended >= most_branches_) return std::nullopt;
    for (;; ++chunk.begin) {
      if (chunk.begin == chunk.end) {
        const auto other = next_chunk();
        if (!other) return std::nullopt;
        chunk = *other;
      }
      if (is_left_out(chunk.begin)) continue;
      ++begun;
      return chunk.begin++;
    }
  };
  const auto take_ready = [&] {
    point::WorkItem item = std::move(ready.back());
    ready.pop_back();
    return item;
  };
  const auto next = [&]() -> std::optional<point::WorkItem> {
    for (;;) {
      const std::optional<std::size_t> chain = ready.empty() ? next_chain() : std::nullopt;
      if (ready.empty() && !chain) return std::nullopt;
      const point::WorkItem item = chain ? item_of(*chain) : take_ready();
      if (lanes::accepts(item)) return item;
      run_batch({&item, 1}, scratches_[thread], take);
    }
  };
  lanes::Scheduler scheduler(arch_, scratches_[thread], next, take);
  scheduler.run();
  const std::lock_guard lock(mutex_);
  lane_work_.proved += scheduler.proved(), lane_work_.refined += scheduler.refined();
}

std::optional<point::WorkItem> WorkerPool::store(const point::WorkItem& item, point::PointResult&& result,
                                                 std::size_t thread) {
  const bool has_next = item.position + 1 < share_.length();
  std::optional<point::End> end;
  if (has_next && !failed(result.status)) end = end_for_next(item.problem, result.end);
  add(work_with(item.effects, work_[thread]), result);
  if (mirror_images_.exist()) {
    const std::size_t point = share_.point(item.chain, item.position);
    if (mirror_images_.original_of(point)) {
      result = mirrored(result);
    } else if (has_whole_pairs_) {
      store_image_of(point, result, item.problem.units, thread);
    }
  }
  keep(share_.local_index(item.chain, item.position), std::move(result), item.problem.units);
  progress_.add_point(thread);
  if (has_next) return item_of(item.chain, item.position + 1, end, item.problem.units);
  states_.finish(item.chain);
  return std::nullopt;
}

void WorkerPool::keep(std::size_t local_index, point::PointResult&& result, const Units& units) {
  if (see_) see_(local_index, result);
  store_.store(local_index, std::move(result), units);
}

void WorkerPool::store_image_of(std::size_t point, const point::PointResult& result, const Units& units,
                                std::size_t thread) {
  const auto image = mirror_images_.image_of(point);
  if (!image || is_restored(*image) || is_bereft(*image)) return;
  keep(*image, mirrored(result), units);
  progress_.add_point(thread);
  states_.finish(*image);
}

void WorkerPool::run_chain(std::size_t chain, std::size_t thread) {
  std::optional<point::WorkItem> item = item_of(chain), successor;
  for (; item; item = std::move(successor))
    run_batch({&*item, 1}, scratches_[thread], [&](const point::WorkItem& done, point::PointResult&& result) {
      successor = store(done, std::move(result), thread);
    });
}

void WorkerPool::run_chunk(const Chunk& chunk, std::size_t thread) {
  if (sweep_.follow) {
    if (!is_restored(chunk.begin)) run_chain(chunk.begin, thread);
  } else {
    run_points(chunk, thread);
  }
}

void WorkerPool::run_points(const Chunk& chunk, std::size_t thread) {
  std::vector<point::WorkItem> items;
  items.reserve(chunk.end - chunk.begin);
  for (std::size_t chain = chunk.begin; chain < chunk.end; ++chain)
    if (!is_left_out(chain)) items.push_back(item_of(chain));
  const auto set_of = [](const point::WorkItem& item) { return effect_set_of(item.effects); };
  std::ranges::stable_sort(items, {}, set_of);
  for (std::span<const point::WorkItem> left(items); !left.empty();) {
    const auto other =
        std::ranges::find_if(left, [&](const point::WorkItem& item) { return set_of(item) != set_of(left[0]); });
    const auto batch = static_cast<std::size_t>(other - left.begin());
    run_batch(left.first(batch), scratches_[thread], [&](const point::WorkItem& item, point::PointResult&& result) {
      store(item, std::move(result), thread);
    });
    left = left.subspan(batch);
  }
}

}  // namespace clatter::sweep
