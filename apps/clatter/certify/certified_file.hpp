#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "certificates/tally.hpp"
#include "lanes/instruction_set.hpp"
#include "results/dataset_file.hpp"
#include "sweep/chains.hpp"
#include "sweep/sweep.hpp"
#include "tables/point_filter.hpp"
#include "tables/point_rows.hpp"

namespace clatter::app {

/// An output of `clatter run` whose points are run anew, compared with it, and certified.
class CertifiedFile {
 public:
  /// Reads the configuration, and which points are chosen. Throws UsageError, IoError, ChoiceError.
  CertifiedFile(const std::string& path, const std::vector<Condition>& where);

  [[nodiscard]] const std::vector<std::size_t>& points() const { return points_; }  ///< those chosen, ascending
  /// The instruction set of the file, if this machine lacks it, so that motion may settle otherwise; empty: it has it.
  [[nodiscard]] const std::string& lacking() const { return lacking_; }

  /// Passes on the certificates of some points, ascending, one a line; along `follow` in the order of chains. Throws
  /// IoError.
  [[nodiscard]] certificates::Tally certify(const std::vector<std::size_t>& points,
                                            const std::function<void(std::string_view line)>& take) const;

 private:
  /// Points that were run anew, as the run of the file ran them.
  struct Anew {
    PointRows rows;
    std::vector<certificates::KnownResult> known;  ///< by the index in `rows`
  };
  [[nodiscard]] Anew run(const sweep::Sweep& sweep, int threads) const;
  [[nodiscard]] PointRows stored(const std::vector<std::size_t>& points) const;

  std::string path_;
  results::FileSummary summary_;
  sweep::Sweep sweep_{};
  lanes::InstructionSet arch_ = lanes::widest_instruction_set();  ///< of the file, if this machine has it
  std::string lacking_{};
  std::vector<std::size_t> points_{};
};

}  // namespace clatter::app
