#pragma once

#if defined(__SANITIZE_THREAD__)
#define CLATTER_THREAD_SANITIZER 1
#elif defined(__has_feature)
#if __has_feature(thread_sanitizer)
#define CLATTER_THREAD_SANITIZER 1
#endif
#endif

#ifdef CLATTER_THREAD_SANITIZER
extern "C" {
void __tsan_acquire(void* address);
void __tsan_release(void* address);
}
#endif

namespace clatter {

/// Tells ThreadSanitizer what libgomp, which isn't built for it, orders: all before a parallel region happens before
/// its threads, and all of theirs before what follows it. Races between the threads are still found. In other builds it
/// is nothing.
class ForkJoin {
 public:
#ifdef CLATTER_THREAD_SANITIZER
  ForkJoin() { __tsan_release(&begin_); }
  void join() { __tsan_acquire(&end_); }

  /// One thread's stay in the region.
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
  void join() {}

  struct Member {
    explicit Member(ForkJoin&) {}
  };
#endif
};

}  // namespace clatter
