// A bug of clatter-verify on one line is the verdict on that line alone. No input is known that causes one, so here the
// check itself fails.
#include <gtest/gtest.h>

#include <atomic>
#include <filesystem>
#include <fstream>
#include <new>
#include <stdexcept>
#include <string>
#include <vector>

#include "verify/stream.hpp"

namespace verify::bug_test {
namespace {

std::string line_of(const std::string& name) {
  return R"({"format": "clatter-certificate-1", "name": ")" + name +
         R"(", "scene": {"h": 0, "k": 1, "f": 0, "nu": 1, "load": 0, "phase": 0}, "claim": "transient",)"
         R"( "start": {"time": 0, "x": 0, "v": 0}, "events": [], "end": {"time": 1, "x": [0, 0], "v": [0, 0]}})"
         "\n";
}

/// The verdict that a certificate's name asks for.
Finding as_named(const Certificate& certificate) {
  if (certificate.place == "wrong") return {Verdict::refuted, {"refuted: wrong"}, 64};
  if (certificate.place == "crash") throw std::logic_error("events out of order");
  if (certificate.place == "memory") throw std::bad_alloc();
  if (certificate.place == "unknown") throw 7;  // NOLINT: as a library may
  return {};
}

struct Told {
  std::string said;
  int code = 0;
  std::size_t certificates = 0;
};

/// What is told of certificates of these names.
Told told_of(const std::vector<std::string>& names, unsigned threads = 1, bool json = false) {
  const auto* const test = ::testing::UnitTest::GetInstance()->current_test_info();
  const auto file =
      std::filesystem::temp_directory_path() /
      (std::string("clatter_bug_") + test->name() + std::to_string(::testing::UnitTest::GetInstance()->random_seed()));
  std::ofstream out(file);
  for (const std::string& name : names) out << line_of(name);
  out.close();
  Result result(json);
  ::testing::internal::CaptureStdout();
  Manner manner;
  manner.threads = threads, manner.check = as_named;
  examine_file(file, manner, result);
  result.print();
  std::filesystem::remove(file);
  std::string said = ::testing::internal::GetCapturedStdout();
  for (std::size_t at = said.find(file.string()); at != std::string::npos; at = said.find(file.string()))
    said.replace(at, file.string().size(), "FILE");
  return {said, result.exit_code(), result.certificates()};
}

TEST(Bug, is_the_verdict_on_its_line_with_what_is_known_of_it) {
  const Told told = told_of({"right", "crash", "right"});
  EXPECT_EQ(told.said,
            "FILE:2: crash: bug: events out of order; please report it with this line\n"
            "2 proved, 0 refuted, 0 undecided, 1 bug\n");
  EXPECT_EQ(told.code, 70);
  EXPECT_EQ(told.certificates, 3u);
}

TEST(Bug, has_a_verdict_in_json_of_its_own) {
  const Told told = told_of({"crash", "right"}, 1, true);
  EXPECT_NE(told.said.find(R"("verdict": "bug")"), std::string::npos);
  EXPECT_NE(told.said.find(R"("bugs": 1)"), std::string::npos);
  EXPECT_NE(told.said.find(R"("proved": 1)"), std::string::npos);
}

TEST(Bug, counts_less_than_a_refuted_claim) { EXPECT_EQ(told_of({"crash", "wrong"}).code, 1); }

TEST(Bug, is_whatever_is_thrown) {
  const Told told = told_of({"memory", "unknown", "right"});
  EXPECT_NE(told.said.find("FILE:1: memory: bug: "), std::string::npos) << told.said;
  EXPECT_NE(told.said.find("FILE:2: unknown: bug: "), std::string::npos) << told.said;
  EXPECT_NE(told.said.find("1 proved, 0 refuted, 0 undecided, 2 bugs\n"), std::string::npos) << told.said;
}

TEST(Bug, leaves_no_thread) {
  std::vector<std::string> names;
  for (int i = 0; i < 200; ++i) names.insert(names.end(), {"right", "crash", "wrong"});
  const Told told = told_of(names, 8);
  EXPECT_NE(told.said.find("\n200 proved, 200 refuted, 0 undecided, 200 bugs\n"), std::string::npos);
}

}  // namespace
}  // namespace verify::bug_test
