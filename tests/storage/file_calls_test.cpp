#include "storage/file_calls.hpp"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/resource.h>

#include <cerrno>

#include "storage/error.hpp"
#include "storage/input_file.hpp"
#include "storage/run_in_child.hpp"

namespace clatter::storage::file_calls_test {
namespace {

/// Leaves no descriptor to open a file with.
class NoMoreFiles {
 public:
  NoMoreFiles() {
    ::getrlimit(RLIMIT_NOFILE, &before_);
    const int next = ::open("/dev/null", O_RDONLY);
    ::close(next);
    const rlimit none{static_cast<rlim_t>(next), before_.rlim_max};
    ::setrlimit(RLIMIT_NOFILE, &none);
  }
  ~NoMoreFiles() { ::setrlimit(RLIMIT_NOFILE, &before_); }
  NoMoreFiles(const NoMoreFiles&) = delete;
  NoMoreFiles& operator=(const NoMoreFiles&) = delete;

 private:
  rlimit before_{};
};

template <typename Work>
std::string message_without_files(Work work) {
  try {
    const NoMoreFiles none;  // not beyond the exception: the sanitizers' look at it needs a descriptor
    work();
  } catch (const IoError& error) {
    return error.what();
  }
  return "done";
}

TEST(ReasonAndWayOut, of_any_error_is_the_given_one) {
  EXPECT_EQ(reason_and_way_out(EACCES, "ask"), "Permission denied; ask");
  EXPECT_EQ(reason_and_way_out(EACCES, ""), "Permission denied");
}

TEST(ReasonAndWayOut, of_too_many_open_files_is_the_limit) {
  rlimit limit{};
  ASSERT_EQ(::getrlimit(RLIMIT_NOFILE, &limit), 0);
  EXPECT_EQ(reason_and_way_out(EMFILE, "ask"),
            "too many open files (ulimit -n is " + std::to_string(limit.rlim_cur) + "); raise it");
  EXPECT_NE(reason_and_way_out(ENFILE, "ask").find("system"), std::string::npos);
}

TEST(ReasonAndWayOut, is_told_by_every_function_that_opens_files) {
  for (const std::string& message :
       {message_without_files([] { (void)open_input("/dev/null", "a file"); }),
        message_without_files([] { (void)run_in_child([] { return ""; }, {}); }),
        message_without_files([] { refuse("a.h5", ::open("/", O_RDONLY) < 0 ? errno : 0); })})
    EXPECT_NE(message.find("too many open files (ulimit -n is "), std::string::npos) << message;
}

}  // namespace
}  // namespace clatter::storage::file_calls_test
