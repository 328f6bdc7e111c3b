#pragma once

#include <cstddef>
#include <map>
#include <string>

#include "certificates/certified_point.hpp"

namespace clatter::certificates {

/// Counts points by what became of them.
class Tally {
 public:
  void add(const CertifiedPoint& point);

  [[nodiscard]] bool all_reproduced() const { return not_reproduced_.empty(); }
  /// One line: "5 points: 3 certificates (3 periodic), 2 without a claim (2 aperiodic)".
  [[nodiscard]] std::string text() const;

 private:
  std::map<std::string, std::size_t> certificates_{}, without_{};  ///< by their kind
  std::map<std::string, std::size_t> not_reproduced_{};            ///< by the result that differs
};

}  // namespace clatter::certificates
