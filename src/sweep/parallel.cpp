#include "sweep/parallel.hpp"

#include <omp.h>

#if defined(__SANITIZE_THREAD__)
#define CLATTER_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CLATTER_THREAD_SANITIZER 1
#endif
#endif

#ifdef CLATTER_THREAD_SANITIZER
/// Marks a function that contains only a parallel region: ThreadSanitizer doesn't watch its own reads of the data that
/// libgomp passes to it, but does watch the functions that it calls.
#define CLATTER_PARALLEL_REGION __attribute__((no_sanitize("thread")))
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#else
#define CLATTER_PARALLEL_REGION
#endif

namespace clatter::sweep {
namespace {

/// Tells ThreadSanitizer the order that libgomp, which isn't built for it, guarantees: everything before a parallel
/// region happens before its threads run, and all that they do happens before the code after it. Races between the
/// threads are still found. In other builds it does nothing.
class ForkJoin {
 public:
#ifdef CLATTER_THREAD_SANITIZER
  void fork() { __tsan_release(&begin_); }
  void join() { __tsan_acquire(&end_); }

  /// One thread's work on one iteration.
  class Iteration {
   public:
    explicit Iteration(ForkJoin& region) : region_(region) { __tsan_acquire(&region_.begin_); }
    ~Iteration() { __tsan_release(&region_.end_); }
    Iteration(const Iteration&) = delete;
    Iteration& operator=(const Iteration&) = delete;

   private:
    ForkJoin& region_;
  };

 private:
  char begin_ = 0, end_ = 0;
#else
  void fork() {}
  void join() {}

  struct Iteration {
    explicit Iteration(ForkJoin&) {}
  };
#endif
};

}  // namespace

CLATTER_PARALLEL_REGION void parallel_for(std::size_t count, int threads,
                                          const std::function<void(std::size_t)>& work) {
  ForkJoin fork_join;
  fork_join.fork();
#pragma omp parallel for schedule(dynamic) num_threads(threads)
  for (std::size_t i = 0; i < count; ++i) {
    const ForkJoin::Iteration iteration(fork_join);
    work(i);
  }
  fork_join.join();
}

CLATTER_PARALLEL_REGION void on_each_thread(int threads, const std::function<void(std::size_t)>& work) {
  ForkJoin fork_join;
  fork_join.fork();
#pragma omp parallel num_threads(threads)
  {
    const ForkJoin::Iteration iteration(fork_join);
    work(static_cast<std::size_t>(omp_get_thread_num()));
  }
  fork_join.join();
}

int default_threads() { return omp_get_max_threads(); }

}  // namespace clatter::sweep
