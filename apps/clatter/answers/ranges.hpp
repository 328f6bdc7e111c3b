#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "answers/extremes.hpp"
#include "results/dataset.hpp"
#include "results/dataset_file.hpp"
#include "tables/point_filter.hpp"

namespace clatter::app {

/// Neighbours along an axis that have the same word.
struct Range {
  std::string word;                              ///< of a result; of conditions alone: empty
  std::vector<Whereabouts> from, to;             ///< the axis, and those linked to it, at both ends
  std::size_t first, last, points;               ///< points of the file at both ends, and how many there are
  std::optional<std::size_t> before{}, after{};  ///< the points next to the ends; nothing: the axis ends there
};

/// What lies between two neighbouring points of the file that end one range and begin the next, where their refined
/// ends don't meet.
struct Gap {
  std::size_t after;  ///< which range
  std::vector<Whereabouts> from, to;
  std::string why;
};

/// The ranges along the axis at one value of each of the others.
struct RangeLine {
  std::vector<Whereabouts> at;
  std::vector<Range> ranges;
  std::vector<Gap> gaps{};  ///< of refined ranges
};

/// What --ranges and --where ask for.
struct RangeChoice {
  std::string result{};  ///< that is a name or a count, or a component of one; empty: conditions alone
  std::vector<Condition> where{};
  std::string along{};  ///< an axis; empty: the longest
};

/// How many points meet the conditions.
struct Met {
  std::size_t points, of;  ///< of those that haven't failed
  std::size_t failed, without_value;
  std::string there{};  ///< if none meets them, the values that there are: "impact_speed is 0.2 ... 0.4 m/s"
};

/// From where to where along one axis a result that is a name or a count keeps its word, or points meet conditions.
class Ranges {
 public:
  /// Throws ChoiceError if the file has no such result or axis, or a sample along it, which has no neighbours; IoError
  /// if it is no whole output.
  Ranges(const results::FileSummary& summary, const std::string& path, RangeChoice choice);

  /// The variables whose values the others need.
  [[nodiscard]] const std::vector<std::string>& variables() const { return names_; }

  [[nodiscard]] std::vector<RangeLine> of(const results::Dataset& dataset) const;
  [[nodiscard]] Met met(const results::Dataset& dataset) const;

  /// The word of each point: that of the result, or "yes"; empty if it meets the conditions not.
  [[nodiscard]] std::vector<std::string> words(const results::Dataset& dataset) const;

  [[nodiscard]] const RangeChoice& choice() const { return choice_; }
  [[nodiscard]] const results::FileSummary::Entry* result() const { return result_; }
  /// The name of the dimension along which ranges lie; empty: the file has one point.
  [[nodiscard]] std::string along() const { return rows_.empty() ? "" : rows_[along_].name; }
  /// Whether the points along it are a sample, of which nothing but the extent is told.
  [[nodiscard]] bool is_sample() const { return is_sample_; }

 private:
  using Entry = results::FileSummary::Entry;

  [[nodiscard]] const Entry& require_result() const;
  [[nodiscard]] std::size_t dimension_along() const;
  [[nodiscard]] std::vector<Whereabouts> coordinates(std::size_t dimension, std::size_t index,
                                                     const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<std::size_t> order_along(const results::Dataset& dataset) const;
  [[nodiscard]] std::size_t width_of_result() const;
  [[nodiscard]] std::size_t part_of_result(const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<std::string> words_of_result(const results::Dataset& dataset) const;
  void require_counts(const results::Dataset& dataset) const;
  [[nodiscard]] Range extent(const std::vector<std::size_t>& points, const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<Whereabouts> others(std::size_t point, const results::Dataset& dataset) const;
  [[nodiscard]] bool turns(const std::vector<std::size_t>& points, std::size_t i,
                           const results::Dataset& dataset) const;
  void add_line(const std::vector<std::size_t>& points, const std::vector<std::string>& words,
                const results::Dataset& dataset, std::vector<RangeLine>& lines) const;
  [[nodiscard]] std::size_t index_along(std::size_t point, std::size_t dimension) const;

  const results::FileSummary& summary_;
  std::string path_;
  RangeChoice choice_;
  std::string named_;  ///< the result by its name in the file
  std::vector<results::NamedLength> rows_;
  PointFilter filter_;
  const Entry* result_ = nullptr;
  std::size_t along_ = 0;  ///< dimension
  bool is_sample_ = false;
  std::vector<std::string> names_{};
};

}  // namespace clatter::app
