#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "branches/branch.hpp"
#include "branches/settings.hpp"
#include "certificates/certificate_text.hpp"
#include "certificates/tally.hpp"
#include "results/dataset_file.hpp"
#include "sweep/sweep.hpp"
#include "tables/point_rows.hpp"

namespace clatter::app {

/// An output of `clatter branch` whose branches are followed anew and certified.
class CertifiedBranches {
 public:
  /// Reads the configuration and the results that are compared, and follows the branches. Throws UsageError, IoError.
  explicit CertifiedBranches(const std::string& path);

  /// Passes on the certificates of so many points and special points, spread evenly, or of all, one a line.
  [[nodiscard]] certificates::Tally certify(const std::optional<std::size_t>& sample,
                                            const std::function<void(std::string_view line)>& take) const;

 private:
  /// Points that were followed anew, and those of the file.
  struct Compared {
    PointRows followed, stored;
  };
  void compare_with(const std::string& path, const results::FileSummary& summary);
  /// Whether a special point of one of these kinds is at a point of its branch.
  [[nodiscard]] bool is_at(const branches::BranchPoint& point, std::span<const branches::SpecialKind> kinds) const;
  [[nodiscard]] certificates::CertifiedPlace place_of(std::size_t number, const branches::BranchPoint& point) const;

  sweep::Sweep sweep_;
  branches::BranchSettings settings_;
  std::optional<branches::StartProblem> start_{};
  branches::Branches found_;
  std::optional<Compared> points_{}, special_{};
};

}  // namespace clatter::app
