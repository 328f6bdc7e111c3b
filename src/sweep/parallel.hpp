#pragma once

#include <cstddef>
#include <functional>

namespace clatter::sweep {

/// Calls `work(i)` for every i < count on `threads` threads, each i as soon as one is free; `work` must not throw.
void parallel_for(std::size_t count, int threads, const std::function<void(std::size_t)>& work);

/// Calls `work(thread)` once on each of `threads` threads, the calling one included as number 0; `work` must not throw.
void on_each_thread(int threads, const std::function<void(std::size_t)>& work);

/// The threads that OpenMP would use: all cores, or what OMP_NUM_THREADS says.
[[nodiscard]] int default_threads();

}  // namespace clatter::sweep
