#include "sweep/stack.hpp"

#include <pthread.h>
#include <sys/resource.h>

#include <cstdint>
#include <cstdlib>
#include <string>

namespace clatter {
namespace {

std::string kibibytes(std::size_t bytes) { return std::to_string(bytes >> 10U) + " KiB"; }

/// The variable that gave the threads of OpenMP their stacks; libgomp's own comes first.
const char* stack_variable() {
  for (const char* const name : {"GOMP_STACKSIZE", "OMP_STACKSIZE"})
    if (std::getenv(name) != nullptr) return name;
  return "ulimit -s";
}

/// The whole stack of this thread, and what is left of it; all there is where the system doesn't tell.
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

}  // namespace

void require_main_stack() {
  rlimit limit{};
  if (getrlimit(RLIMIT_STACK, &limit) != 0 || limit.rlim_cur >= needed_stack) return;
  throw LimitError("the stack is too small: ulimit -s permits " + kibibytes(limit.rlim_cur) + ", " +
                   kibibytes(needed_stack) + " are needed; raise it, e.g. ulimit -s 8192");
}

void require_thread_stack() {
  constexpr std::size_t begun = std::size_t{32} << 10U;  // the thread's own data, and the calls up to here
  const Stack stack = stack_of_thread();
  if (stack.left + begun >= needed_stack) return;
  const std::string name = stack_variable();
  throw LimitError("the stack of a thread is too small: " + name + " gives it " + kibibytes(stack.size) + ", " +
                   kibibytes(needed_stack) + " are needed; " +
                   (name == "ulimit -s" ? "raise it, e.g. ulimit -s 8192" : "unset " + name + ", or set it to 8M"));
}

}  // namespace clatter
