#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "results/dataset.hpp"
#include "results/dataset_file.hpp"
#include "steady/status.hpp"
#include "tables/point_filter.hpp"

namespace clatter::app {

/// A number that says where a point lies, or which component of a result it has: "frequency", 21.25, "Hz".
struct Whereabouts {
  std::string name;
  double value;
  std::string units;
};

/// A point at which a result is among the largest, or the smallest.
struct Extreme {
  double value;                                            ///< of its best component
  std::vector<Whereabouts> axes;                           ///< of the point
  std::vector<Whereabouts> component;                      ///< of the result; empty: it has one value a point
  std::vector<std::pair<std::string, std::string>> words;  ///< "status" and "periodic", "impact_word" and "LU"
};

inline constexpr std::size_t most_extremes = 5;

/// The points of a file at which a result is largest, or smallest. A result with a value for each stop, harmonic, ...
/// counts by the best of a point, or by the one that is named, as in v_before[-1]. Failed points and NaN don't count.
class Extremes {
 public:
  /// Which points count.
  struct Choice {
    bool periodic = false;           ///< only those whose motion is periodic
    std::vector<Condition> where{};  ///< only those that meet these
    std::string for_axis{};          ///< the best point for each value of this axis; empty: the best of all
  };

  /// `name` may name a component. Throws ChoiceError if the file has no such result or axis, it isn't one of numbers,
  /// or no status says what is periodic; IoError if it is a shard.
  Extremes(const results::FileSummary& summary, const std::string& path, const std::string& name, bool largest,
           Choice choice);

  /// The variables whose values `of` needs.
  [[nodiscard]] const std::vector<std::string>& variables() const { return names_; }

  /// At most five points, the best first, equal ones in the order of the file, or the best for each value of the axis,
  /// in the order of these; the dataset holds `variables()`. Throws ChoiceError if no component has that name, IoError
  /// if the file contradicts itself.
  [[nodiscard]] std::vector<Extreme> of(const results::Dataset& dataset) const;

  [[nodiscard]] const results::FileSummary::Entry& result() const { return *result_; }
  [[nodiscard]] bool is_largest() const { return is_largest_; }
  [[nodiscard]] const std::string& for_axis() const { return choice_.for_axis; }

 private:
  struct Candidate {
    std::size_t point, part;
    double value;
  };

  [[nodiscard]] const results::FileSummary::Entry& require_result(const std::string& name) const;
  void collect_variables();
  [[nodiscard]] std::vector<bool> wanted_parts(const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<Candidate> best_of(std::vector<Candidate> found, const results::Dataset& dataset) const;
  [[nodiscard]] bool counts(steady::Status status) const;
  [[nodiscard]] std::vector<Candidate> candidates(const results::Dataset& dataset) const;
  [[nodiscard]] Extreme described(const Candidate& candidate, const results::Dataset& dataset) const;
  void require_complete(const results::Dataset& dataset) const;

  const results::FileSummary& summary_;
  std::string path_, named_;
  bool is_largest_;
  Choice choice_;
  std::vector<results::NamedLength> of_points_;  ///< dimensions of the file's points
  const results::FileSummary::Entry* result_;
  std::vector<results::NamedLength> places_{}, parts_{};  ///< dimensions of the result: of points, of components
  std::vector<std::string> axes_{}, words_{}, names_{};
  std::optional<PointFilter> filter_{};
};

}  // namespace clatter::app
