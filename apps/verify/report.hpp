#pragma once

#include <algorithm>
#include <stdexcept>
#include <string>

#include "certificate.hpp"
#include "check.hpp"

namespace verify {

/// A claim is refuted: nothing that follows it can be proved.
class Refuted : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// The claims compared so far.
class Report {
 public:
  void compare(const std::string& name, const Ball& found, const Claimed& claimed) {
    const Ball distance = abs(found - claimed.value.ball()), error = claimed.error.ball();
    if (distance <= error) return;
    const bool refuted = distance > error;
    add(refuted ? Verdict::refuted : Verdict::undecided,
        name + ": claimed " + claimed.value.text() + " to " + claimed.error.text() + ", found " + found.text());
  }
  void add(Verdict verdict, const std::string& remark) {
    finding_.remarks.push_back((verdict == Verdict::refuted ? "refuted: " : "undecided: ") + remark);
    if (verdict == Verdict::refuted && first_refuted_.empty()) first_refuted_ = remark;
    finding_.verdict = std::max(finding_.verdict, verdict);
  }
  [[nodiscard]] const std::string& first_refuted() const { return first_refuted_; }
  [[nodiscard]] const Finding& finding() const { return finding_; }

 private:
  Finding finding_{};
  std::string first_refuted_{};
};

}  // namespace verify
