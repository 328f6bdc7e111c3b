#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "results/dataset.hpp"
#include "results/dataset_file.hpp"
#include "tables/point_filter.hpp"

namespace clatter::app {

/// What has a row of a table.
enum class TableRows {
  points,
  impacts,  ///< of the log
  samples,  ///< of trajectories
  motions,  ///< that starts end in, at each value of the parameters: the first point that ends in it
  special   ///< points of branches
};

/// The part of an output that becomes a table.
struct TableChoice {
  std::vector<std::string> only{};  ///< results, or components such as v_before[-1]; empty: all
  std::vector<Condition> where{};   ///< that points meet
  TableRows rows = TableRows::points;
};

/// An output file as a table in CSV: lines that begin with # tell title, origin, and the unit and meaning of each
/// variable; then one header row (RFC 4180), and one row a point, an impact, a sample, a motion or a special point. The
/// axes come first, the other numbers next, and all texts behind them. Numbers have the digits that read back to the
/// same double, nan or inf; flags such as `status` are their meanings and come last.
class CsvTable {
 public:
  /// Throws ChoiceError, or IoError if the file isn't a whole output.
  CsvTable(const results::FileSummary& summary, const std::string& path, TableChoice choice);

  /// The variables whose values `write` needs.
  [[nodiscard]] const std::vector<std::string>& variables() const { return names_; }

  /// Passes the text on in pieces. The dataset holds `variables()` of the file. Throws ChoiceError if no axis has a
  /// value that `where` asks for.
  void write(const results::Dataset& dataset, const std::function<void(std::string_view)>& take) const;

  /// The indexes of the points that `where` chooses, the last axis fastest. Throws as `write` does.
  [[nodiscard]] std::vector<std::size_t> points(const results::Dataset& dataset) const;

  /// A column: the values of a variable that it has in each row.
  struct Column {
    std::string name;
    const results::Variable* variable;
    std::vector<std::string> meanings;                    ///< of flags, by their value
    std::size_t width = 1, part = 0;                      ///< values of a row, and which of them
    std::optional<std::size_t> dimension = std::nullopt;  ///< of an axis: its place among those of the rows
    /// The index of each point's value, if it isn't that of the row.
    std::shared_ptr<const std::vector<std::size_t>> by_point = nullptr;
  };

 private:
  [[nodiscard]] std::vector<results::NamedLength> dimensions_of_rows() const;
  [[nodiscard]] const results::FileSummary::Entry* find(std::string_view name) const;
  [[nodiscard]] std::vector<std::string> results_in_file() const;
  [[noreturn]] void refuse_rows(const std::string& option, const std::string& lack, const std::string& setting) const;
  void require_known(const std::string& typed, const std::string& name, const std::vector<std::string>& known) const;
  [[nodiscard]] bool has_components(const std::string& name) const;
  [[nodiscard]] bool is_named(const std::string& name) const;
  void collect_variables();
  [[nodiscard]] std::vector<Column> columns_of(const std::string& name, const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<Column> columns(const results::Dataset& dataset) const;
  [[nodiscard]] std::string comments(const std::vector<Column>& columns) const;
  [[nodiscard]] std::vector<bool> chosen(const results::Dataset& dataset) const;
  [[nodiscard]] std::vector<Column> motion_columns(const results::Dataset& dataset) const;
  void require_complete(const std::vector<Column>& columns, std::size_t rows) const;
  [[nodiscard]] std::vector<std::size_t> rows_of_points(const results::Dataset& dataset) const;
  [[nodiscard]] bool is_ragged() const;

  const results::FileSummary& summary_;
  std::string path_;
  TableChoice choice_;
  std::vector<results::NamedLength> rows_;  ///< dimensions whose combinations are the points
  PointFilter filter_;
  std::vector<std::string> axes_{};     ///< coordinates along them
  std::vector<std::string> results_{};  ///< variables with a value, or several, for each row
  std::vector<std::string> motions_{};  ///< of --motions: variables with a value for each motion
  std::vector<std::string> names_{};
};

}  // namespace clatter::app
