#include "csv_table.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "config/suggestion.hpp"
#include "csv_text.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {
namespace {

using Entry = results::FileSummary::Entry;

constexpr std::int64_t most_impacts = std::int64_t{1} << 40;
constexpr std::string_view log_counts = "impact_count";

/// Columns of numbers come first, those of texts next, and flags, whose numbers are written as words, last.
enum class ColumnKind { numbers, texts, flags };

ColumnKind kind_of(const CsvTable::Column& column) {
  if (!column.meanings.empty()) return ColumnKind::flags;
  const bool is_text = std::holds_alternative<std::vector<std::string>>(column.variable->values);
  return is_text ? ColumnKind::texts : ColumnKind::numbers;
}

void append_row(Pieces& pieces, const std::vector<CsvTable::Column>& columns, const std::vector<std::size_t>& at,
                std::size_t row) {
  bool first = true;
  for (const CsvTable::Column& column : columns) {
    if (!std::exchange(first, false)) pieces.text() += ',';
    const std::size_t index = column.dimension ? at[*column.dimension] : row * column.width + column.part;
    append_value(pieces.text(), column.variable->values, index, column.meanings);
  }
  pieces.end_line();
}

}  // namespace

CsvTable::CsvTable(const results::FileSummary& summary, const std::string& path, TableChoice choice)
    : summary_(summary), path_(path), choice_(std::move(choice)) {
  rows_ = choice_.special ? dimensions_of_specials() : dimensions_of_points(summary_, path_);
  for (const results::NamedLength& dimension : rows_)
    for (const std::string& name : coordinates_along(summary_, dimension)) axes_.push_back(name);
  const std::vector<std::string> known = results_in_file();
  for (const std::string& name : choice_.only)  // axes have columns whatever is chosen
    if (std::ranges::find(axes_, name) == axes_.end()) require_known(name, known);
  for (const std::string& name : known)
    if (choice_.only.empty() || is_named(name)) results_.push_back(name);
  for (const Place& place : choice_.where)
    if (std::ranges::find(axes_, place.axis) == axes_.end()) refuse_axis(place.axis);
  collect_variables();
}

const Entry* CsvTable::find(std::string_view name) const { return find_variable(summary_, name); }

std::vector<results::NamedLength> CsvTable::dimensions_of_specials() const {
  const Entry* const kind = find("special_kind");
  if (kind == nullptr)
    throw ChoiceError("--special: " + storage::quoted_name(path_) +
                      " has no special points; `clatter branch` writes files that have them");
  return kind->dimensions;
}

/// All variables with a value or several for each row.
std::vector<std::string> CsvTable::results_in_file() const {
  const auto is_logged = [](const Entry& entry) {
    return entry.dimensions.size() == 1 && entry.dimensions[0].name == logged_impacts;
  };
  if (choice_.impacts && find(log_counts) == nullptr)
    throw ChoiceError(
        "--impacts: " + storage::quoted_name(path_) + " has no impact log; " +
        (holds_branches(summary_) ? "no branch has one" : "run its configuration with --set observe.impact_log=true"));
  std::vector<std::string> names;
  for (const Entry& entry : summary_.variables) {
    const bool is_axis = std::ranges::find(axes_, entry.name) != axes_.end();
    const bool is_over_rows = entry.dimensions.size() >= rows_.size() && entry.dimensions.size() <= rows_.size() + 1 &&
                              std::equal(rows_.begin(), rows_.end(), entry.dimensions.begin(), are_same);
    const bool is_result = is_over_rows && !is_own_coordinate(entry);
    if (choice_.impacts ? is_logged(entry) : is_result && !is_axis && !is_logged(entry)) names.push_back(entry.name);
  }
  return names;
}

void CsvTable::require_known(const std::string& name, const std::vector<std::string>& known) const {
  const ComponentName part(name);
  if (std::ranges::find(known, part.variable) != known.end()) return;
  const std::vector<std::string_view> names(known.begin(), known.end());
  throw ChoiceError("--only: " + config::in_quotes(name) + " is no column of " + storage::quoted_name(path_) +
                    config::suggestion(part.variable, names, "; there are "));
}

void CsvTable::refuse_axis(const std::string& axis) const {
  const std::vector<std::string_view> names(axes_.begin(), axes_.end());
  throw ChoiceError("--where: " + config::in_quotes(axis) + " is no axis of " + storage::quoted_name(path_) +
                    (names.empty() ? ", which has none" : config::suggestion(axis, names, "; its axes are ")));
}

/// Whether --only names a result or a component of it.
bool CsvTable::is_named(const std::string& name) const {
  return std::ranges::any_of(choice_.only,
                             [&](const std::string& only) { return ComponentName(only).variable == name; });
}

/// The axes, the results and the coordinates of their components; of impacts also their counts.
void CsvTable::collect_variables() {
  names_ = axes_;
  if (choice_.impacts) names_.emplace_back(log_counts);
  for (const std::string& name : results_) {
    const std::vector<results::NamedLength>& dimensions = find(name)->dimensions;
    if (!choice_.impacts && dimensions.size() > rows_.size() && find(dimensions.back().name) != nullptr)
      names_.push_back(dimensions.back().name);
    names_.push_back(name);
  }
  std::vector<std::string> once;
  for (const std::string& name : names_)
    if (std::ranges::find(once, name) == once.end()) once.push_back(name);
  names_ = std::move(once);
}

/// The columns of a result: one, or one for each component that is wanted.
std::vector<CsvTable::Column> CsvTable::columns_of(const std::string& name, const results::Dataset& dataset) const {
  const results::Variable& variable = variable_of(dataset, name);
  const std::vector<results::NamedLength>& dimensions = find(name)->dimensions;
  if (choice_.impacts || dimensions.size() == rows_.size()) return {{name, &variable, meanings_of(variable)}};
  const results::NamedLength& along = dimensions.back();
  std::vector<Column> columns;
  for (std::size_t part = 0; part < along.length; ++part) {
    const std::string full = name + '[' + component_name(dataset, along.name, part) + ']';
    const auto names_it = [&](const std::string& only) { return only == name || only == full; };
    if (choice_.only.empty() || std::ranges::any_of(choice_.only, names_it))
      columns.push_back({full, &variable, meanings_of(variable), along.length, part});
  }
  if (columns.empty())
    throw ChoiceError("--only: " + config::in_quotes(choice_.only.front()) + " is no component; there are " +
                      component_names(dataset, name, along));
  return columns;
}

std::vector<CsvTable::Column> CsvTable::columns(const results::Dataset& dataset) const {
  std::vector<Column> columns;
  for (const std::string& axis : axes_) {
    const std::string& dimension = find(axis)->dimensions[0].name;
    const auto place = std::ranges::find(rows_, dimension, &results::NamedLength::name) - rows_.begin();
    columns.push_back({axis, &variable_of(dataset, axis), {}, 1, 0, static_cast<std::size_t>(place)});
  }
  for (const std::string& name : results_)
    for (Column& column : columns_of(name, dataset)) columns.push_back(std::move(column));
  std::ranges::stable_sort(columns, {}, kind_of);
  return columns;
}

/// Title and origin of the file, then unit and meaning of each variable: text of a file, so it is made printable.
std::string CsvTable::comments(const std::vector<Column>& columns) const {
  std::string text;
  for (const std::string_view name : {"title", "source", "clatter_version", "config_sha256"})
    for (const auto& [key, value] : summary_.attributes)
      if (key == name && !value.empty()) text += "# " + key + ": " + storage::printable(value) + '\n';
  std::string_view last;
  for (const Column& column : columns) {
    if (std::exchange(last, column.variable->name) == column.variable->name) continue;
    const Entry& entry = *find(column.variable->name);
    text +=
        "# " + entry.name + " (" + storage::printable(entry.units) + "): " + storage::printable(entry.meaning()) + '\n';
  }
  return text;
}

/// Which indexes along each dimension of the rows are wanted.
std::vector<std::vector<bool>> CsvTable::wanted(const results::Dataset& dataset) const {
  std::vector<std::vector<bool>> wanted;
  for (const results::NamedLength& dimension : rows_) wanted.emplace_back(dimension.length, true);
  for (const Place& asked : choice_.where) {
    const Entry& entry = *find(asked.axis);
    const std::string& dimension = entry.dimensions[0].name;
    const auto place = std::ranges::find(rows_, dimension, &results::NamedLength::name) - rows_.begin();
    std::vector<bool>& along = wanted[static_cast<std::size_t>(place)];
    const std::vector<bool> here = indexes_at(asked, variable_of(dataset, asked.axis), entry, path_);
    for (std::size_t i = 0; i < along.size(); ++i) along[i] = along[i] && here[i];
  }
  return wanted;
}

/// Throws IoError unless each column has a value for each row: anyone may have made the file.
void CsvTable::require_complete(const std::vector<Column>& columns, std::size_t rows) const {
  for (const Column& column : columns) {
    const std::size_t length = std::visit([](const auto& values) { return values.size(); }, column.variable->values);
    const std::size_t wanted = column.dimension ? rows_[*column.dimension].length : rows * column.width;
    if (length != wanted)
      storage::refuse_reading(path_, "is damaged: " + config::in_quotes(column.variable->name) + " has another length",
                              "run its configuration again");
  }
}

/// The impacts of each point.
std::vector<std::size_t> CsvTable::rows_of_points(const results::Dataset& dataset) const {
  std::vector<std::size_t> rows(points_of(rows_), 1);
  if (!choice_.impacts) return rows;
  const auto* const counts = std::get_if<std::vector<std::int64_t>>(&variable_of(dataset, log_counts).values);
  const bool is_sound =
      counts != nullptr && counts->size() == rows.size() &&
      std::ranges::all_of(*counts, [](std::int64_t count) { return count >= 0 && count < most_impacts; });
  if (!is_sound)
    storage::refuse_reading(path_, "is damaged: 'impact_count' is none of its points", "run its configuration again");
  std::ranges::transform(*counts, rows.begin(), [](std::int64_t count) { return static_cast<std::size_t>(count); });
  return rows;
}

/// Whether `where` chooses each point.
std::vector<bool> CsvTable::chosen(const results::Dataset& dataset) const {
  const std::vector<std::vector<bool>> is_wanted = wanted(dataset);
  std::vector<std::size_t> at(rows_.size(), 0);
  std::vector<bool> chosen(points_of(rows_), true);
  for (std::size_t point = 0; point < chosen.size(); ++point, advance(at, rows_))
    for (std::size_t d = 0; d < at.size(); ++d) chosen[point] = chosen[point] && is_wanted[d][at[d]];
  return chosen;
}

std::vector<std::size_t> CsvTable::points(const results::Dataset& dataset) const {
  require_complete(columns(dataset), points_of(rows_));
  const std::vector<bool> is_chosen = chosen(dataset);
  std::vector<std::size_t> points;
  for (std::size_t point = 0; point < is_chosen.size(); ++point)
    if (is_chosen[point]) points.push_back(point);
  return points;
}

void CsvTable::write(const results::Dataset& dataset, const std::function<void(std::string_view)>& take) const {
  const std::vector<Column> shown = columns(dataset);
  const std::vector<std::size_t> rows = rows_of_points(dataset);
  require_complete(shown, std::accumulate(rows.begin(), rows.end(), std::size_t{0}));
  const std::vector<bool> is_chosen = chosen(dataset);
  Pieces pieces(take);
  pieces.text() = comments(shown);
  for (const Column& column : shown) append_text(pieces.text() += &column == shown.data() ? "" : ",", column.name);
  pieces.end_line();
  std::vector<std::size_t> at(rows_.size(), 0);
  std::size_t row = 0;
  for (std::size_t point = 0; point < rows.size(); ++point, advance(at, rows_)) {
    for (std::size_t i = 0; is_chosen[point] && i < rows[point]; ++i) append_row(pieces, shown, at, row + i);
    row += rows[point];
  }
  pieces.flush();
}

}  // namespace clatter::app
