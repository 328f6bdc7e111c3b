#include "sweep/thread_stacks.hpp"

#include <pthread.h>
#include <sys/resource.h>

#include <atomic>
#include <cstdint>
#include <cstdlib>
#include <string>

#include "sweep/parallel.hpp"

namespace clatter::sweep {
namespace {

std::string kibibytes(std::size_t bytes) { return std::to_string(bytes >> 10U) + " KiB"; }

/// The variable that gives the threads of OpenMP their stacks, libgomp's own before the other; empty: there is none.
std::string stack_variable() {
  for (const char* const name : {"GOMP_STACKSIZE", "OMP_STACKSIZE"})
    if (std::getenv(name) != nullptr) return name;
  return {};
}

/// The size of this thread's stack, and how much of it is left; `needed_stack` if the system doesn't tell.
struct Stack {
  std::size_t size = needed_stack, left = needed_stack;
};

Stack stack_of_thread() {
  Stack stack;
  pthread_attr_t attributes;
  if (pthread_getattr_np(pthread_self(), &attributes) != 0) return stack;
  void* lowest = nullptr;
  std::size_t size = 0;
  if (pthread_attr_getstack(&attributes, &lowest, &size) == 0)
    stack = {size,
             reinterpret_cast<std::uintptr_t>(__builtin_frame_address(0)) - reinterpret_cast<std::uintptr_t>(lowest)};
  pthread_attr_destroy(&attributes);
  return stack;
}

/// The smallest stack of the threads of a parallel region; the main thread's isn't one of them.
class SmallestStack {
 public:
  std::size_t of(int threads) {
    on_each_thread(threads, [this](std::size_t thread) { look(thread > 0); });
    return smallest_;
  }

 private:
  void look(bool is_started) noexcept {
    constexpr std::size_t begun = std::size_t{32} << 10U;  // the thread's own data, and the calls up to here
    const Stack stack = stack_of_thread();
    if (!is_started || stack.left + begun >= needed_stack) return;
    for (std::size_t before = smallest_; stack.size < before && !smallest_.compare_exchange_weak(before, stack.size);) {
    }
  }

  std::atomic<std::size_t> smallest_ = needed_stack;
};

}  // namespace

std::string fault_of_main_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= needed_stack) return {};
  return "the stack is too small: ulimit -s permits " + kibibytes(limit.rlim_cur) + ", " + kibibytes(needed_stack) +
         " are needed; raise it, e.g. ulimit -s 8192";
}

void require_thread_stacks(int threads) {
  const std::string name = stack_variable();
  if (name.empty()) return;  // they have as much as the main thread
  const std::size_t size = SmallestStack().of(threads);
  if (size >= needed_stack) return;
  throw LimitError("the stack of a thread is too small: " + name + " gives it " + kibibytes(size) + ", " +
                   kibibytes(needed_stack) + " are needed; " + "unset " + name + ", or set it to 8M");
}

}  // namespace clatter::sweep
