#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "certificates/certified_point.hpp"

namespace clatter::certificates {

/// Counts points by what became of them.
class Tally {
 public:
  /// Counts a point that was run anew with the result of its file.
  void add(const CertifiedPoint& point);
  /// Counts a point whose result isn't that of its file.
  void add_not_reproduced() { ++not_reproduced_; }

  [[nodiscard]] std::size_t not_reproduced() const { return not_reproduced_; }
  /// One line: "5 points: 3 certificates (3 periodic), 2 without a claim (2 aperiodic)".
  [[nodiscard]] std::string text() const;

 private:
  std::map<std::string, std::size_t> certificates_{}, without_{};  ///< by their kind
  std::size_t not_reproduced_ = 0;
};

}  // namespace clatter::certificates
