#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/dataset.hpp"
#include "results/dataset_file.hpp"
#include "tables/condition.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {

/// The number that a condition has, in the unit of a variable. Throws ChoiceError if it has none, or if its unit
/// doesn't fit.
[[nodiscard]] double number_of(const Condition& condition, const results::FileSummary::Entry& entry,
                               const std::string& path);

/// Whether the stops of a result stand for the harder one of them if none is named.
[[nodiscard]] bool has_harder_stop(std::string_view result);

/// The points of a file that meet all of some conditions. Axes are compared to 1e-9 of their length. Failed points meet
/// none on results, and neither do values that are NaN.
class PointFilter {
 public:
  /// `rows` are the dimensions of the points, or of special points. Throws ChoiceError if the file hasn't what is
  /// compared.
  PointFilter(const results::FileSummary& summary, std::string path, std::vector<results::NamedLength> rows,
              std::vector<Condition> conditions);

  /// The variables whose values `chosen` needs.
  [[nodiscard]] const std::vector<std::string>& variables() const { return names_; }

  /// Whether each point is chosen, the last dimension fastest; the dataset holds `variables()`. Throws ChoiceError if
  /// an axis has no value that it shall equal, IoError if the file contradicts itself.
  [[nodiscard]] std::vector<bool> chosen(const results::Dataset& dataset) const;

  /// Throws ChoiceError that names the conditions and the values that there are, if they choose no point.
  void require_some(const std::vector<bool>& chosen, const results::Dataset& dataset) const;

  /// Which values there are of what no point meets, for people: "frequency is 15 ... 60 Hz"; the dataset holds
  /// `variables()`.
  [[nodiscard]] std::string values_there(const results::Dataset& dataset) const;

  /// Of the points that haven't failed, those at which a condition compares a result that is NaN.
  [[nodiscard]] std::size_t without_value(const results::Dataset& dataset) const;

 private:
  using Entry = results::FileSummary::Entry;

  /// How a variable lies over the points; of motions, each point has the value of the one that it ends in.
  enum class Layout { axis, result, components, ended };
  struct Compared {
    Condition condition;
    const Entry* entry;
    Layout layout;
  };

  [[nodiscard]] Compared compared(Condition condition) const;
  [[nodiscard]] const Entry* find(const std::string& name) const;
  [[nodiscard]] std::optional<Layout> layout_of(const Entry& entry) const;
  [[noreturn]] void refuse(const std::string& name) const;
  void refuse_contradictions() const;
  void require_complete(const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<bool> met(const Compared& asked, const results::Dataset& dataset) const;
  void keep_along_axis(const Compared& asked, const results::Dataset& dataset, std::vector<bool>& kept) const;
  void keep_results(const Compared& asked, const results::Dataset& dataset, std::vector<bool>& kept) const;
  [[nodiscard]] std::vector<double> numbers_of(const Compared& asked, const results::Dataset& dataset) const;
  template <class Value>
  [[nodiscard]] std::vector<Value> by_point(const Compared& asked, std::vector<Value> values,
                                            const results::Dataset& dataset) const;
  [[nodiscard]] std::string values_of(const Compared& asked, const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<double> of_components(const Compared& asked, const results::Dataset& dataset,
                                                  const std::vector<double>& all) const;
  [[nodiscard]] std::vector<bool> failed_points(const results::Dataset& dataset) const;

  const results::FileSummary& summary_;
  std::string path_;
  std::vector<results::NamedLength> rows_;
  std::vector<Compared> asked_{};
  std::vector<std::string> names_{};
};

}  // namespace clatter::app
