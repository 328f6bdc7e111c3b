#include "storage/run_in_child.hpp"

#include <gtest/gtest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <atomic>
#include <cerrno>
#include <csignal>
#include <cstdlib>
#include <new>
#include <stdexcept>
#include <string>

#include "storage/error.hpp"

namespace clatter::storage::run_in_child_test {
namespace {

/// The reason why a child fails that does this work.
std::string death_of(const std::function<std::string()>& work, const ChildLimits& limits = {}) {
  try {
    (void)run_in_child(work, limits);
    return "";
  } catch (const ChildFailed& death) {
    return death.what();
  }
}

bool has_no_child() { return ::waitpid(-1, nullptr, WNOHANG) == -1 && errno == ECHILD; }

TEST(RunInChild, returns_the_result_of_the_work) {
  EXPECT_EQ(run_in_child([] { return std::string(); }, {}), "");
  const std::string large(30'000'000, 'x');  // more than a pipe holds
  EXPECT_TRUE(run_in_child([&] { return large + std::string("\0y", 2); }, {}) == large + std::string("\0y", 2));
  EXPECT_TRUE(has_no_child());
}

TEST(RunInChild, leaves_this_process_as_it_is) {
  int changed = 0;
  (void)run_in_child([&] { return std::to_string(++changed); }, {});
  EXPECT_EQ(changed, 0);
}

TEST(RunInChild, passes_errors_on) {
  EXPECT_THROW((void)run_in_child([]() -> std::string { throw IoError("no such file"); }, {}), IoError);
  EXPECT_THROW((void)run_in_child([]() -> std::string { throw std::out_of_range("a bug"); }, {}), std::logic_error);
  EXPECT_NE(death_of([]() -> std::string { throw std::bad_alloc(); }).find("memory"), std::string::npos);
  EXPECT_TRUE(has_no_child());
}

TEST(RunInChild, outlives_the_work) {
  EXPECT_NE(death_of([]() -> std::string { std::abort(); }).find("crash (SIGABRT)"), std::string::npos);
  EXPECT_NE(death_of([]() -> std::string { ::_exit(0); }), "");
  EXPECT_NE(death_of([]() -> std::string { ::kill(::getpid(), SIGKILL), std::abort(); }).find("killed"),
            std::string::npos);
  EXPECT_TRUE(has_no_child());
}

TEST(RunInChild, ends_work_without_end) {
  const auto endless = []() -> std::string {
    for (std::atomic<int> turn = 0;;) ++turn;
  };
  EXPECT_NE(death_of(endless, {.seconds = 1}).find("1 s of processor time"), std::string::npos);
  EXPECT_TRUE(has_no_child());
}

TEST(RunInChild, ends_work_that_waits_for_nobody) {
  const auto waiting = []() -> std::string {
    for (;;) ::pause();
  };
  EXPECT_NE(death_of(waiting, {.wall_seconds = 1}).find("within 1 s"), std::string::npos);
  EXPECT_TRUE(has_no_child());
}

TEST(RunInChild, keeps_to_its_memory) {
  EXPECT_NE(death_of([] { return std::string(100'000'000, 'x'); }, {.memory = 10'000'000}), "");
  EXPECT_EQ(run_in_child([] { return std::string(1'000'000, 'x'); }, {.memory = 10'000'000}).size(), 1'000'000U);
}

TEST(RunInChild, works_if_nobody_asks_for_ended_children) {
  const auto before = std::signal(SIGCHLD, SIG_IGN);
  EXPECT_EQ(run_in_child([] { return std::string("done"); }, {}), "done");
  EXPECT_NE(death_of([]() -> std::string { std::abort(); }), "");
  std::signal(SIGCHLD, before);
}

}  // namespace
}  // namespace clatter::storage::run_in_child_test
