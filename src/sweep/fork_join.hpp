#pragma once

#if defined(__SANITIZE_THREAD__)
#define CLATTER_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CLATTER_THREAD_SANITIZER 1
#endif
#endif

#ifdef CLATTER_THREAD_SANITIZER
/// Marks a function that holds nothing but a parallel region: its own reads of what libgomp hands it aren't watched,
/// what it calls is.
#define CLATTER_PARALLEL_REGION __attribute__((no_sanitize("thread")))
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#else
#define CLATTER_PARALLEL_REGION
#endif

namespace clatter {

/// Tells ThreadSanitizer what libgomp, which isn't built for it, orders: all before a parallel region happens before
/// its threads, and all of theirs before what follows it. Races between the threads are still found. In other builds it
/// is nothing.
class ForkJoin {
 public:
#ifdef CLATTER_THREAD_SANITIZER
  void fork() { __tsan_release(&begin_); }
  void join() { __tsan_acquire(&end_); }

  /// One thread's work on one iteration.
  class Member {
   public:
    explicit Member(ForkJoin& region) : region_(region) { __tsan_acquire(&region_.begin_); }
    ~Member() { __tsan_release(&region_.end_); }
    Member(const Member&) = delete;
    Member& operator=(const Member&) = delete;

   private:
    ForkJoin& region_;
  };

 private:
  char begin_ = 0, end_ = 0;
#else
  void fork() {}
  void join() {}

  struct Member {
    explicit Member(ForkJoin&) {}
  };
#endif
};

}  // namespace clatter
