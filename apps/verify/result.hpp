#pragma once

#include <array>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "check.hpp"

namespace verify {

enum ExitCode : int {
  all_proved = 0,
  some_refuted = 1,
  usage_error = 2,
  some_undecided = 3,
  internal_error = 70,
  io_error = 74
};

/// A line of a file, and what is found of it.
struct Line {
  std::size_t number = 0;
  std::string text{}, place{};
  std::string malformed{}, bug{};         ///< what is wrong with it, or with this program
  std::vector<std::string> for_people{};  ///< members of which nothing is proved
  std::optional<ListLine> of_list{};      ///< it is no certificate, but begins or ends a list of them
  Finding finding{};
};

/// The counts of all files, and what is printed of each line that isn't proved.
class Result {
 public:
  explicit Result(bool json) : json_(json) {}

  void add(const std::string& file, const Line& line);
  /// A mistake in a list of certificates: it was cut, or put together from others.
  void add_malformed(const std::string& file, std::size_t line, const std::string& what);
  /// A file of which no more is read.
  void add_failure(ExitCode code, const std::string& what);
  void print() const;
  /// What is refuted counts most, and then what keeps others from being proved.
  [[nodiscard]] ExitCode exit_code() const;
  [[nodiscard]] std::size_t certificates() const { return certificates_; }

 private:
  /// A line that isn't proved, as JSON tells it.
  struct Told {
    std::string file{}, place{}, verdict{};
    std::size_t line = 0;
    slong bits = 0;
    std::vector<std::string> remarks{};
  };
  void tell(const std::string& file, const Line& line, const char* verdict, const std::vector<std::string>& remarks);

  bool json_;
  std::size_t certificates_ = 0, malformed_ = 0, bugs_ = 0;
  std::array<std::size_t, 3> count_{};  ///< [Verdict]
  bool has_unread_files_ = false, has_empty_files_ = false;
  std::vector<Told> claims_{};
  std::set<std::string> for_people_{};
};

}  // namespace verify
