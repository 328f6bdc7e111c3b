#include "csv_table.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include "config/suggestion.hpp"
#include "csv_text.hpp"
#include "scene/parameter.hpp"
#include "storage/error.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {
namespace {

using Entry = results::FileSummary::Entry;

constexpr double same = 1e-9;  ///< of the length of an axis: values that count as equal
constexpr std::int64_t most_impacts = std::int64_t{1} << 40;
constexpr std::string_view log_counts = "impact_count", log_dimension = "impact";

/// The name of a result, and of which component: "v_before[-1]" is {"v_before", "-1"}.
struct ComponentName {
  std::string variable;
  std::optional<std::string> component;

  explicit ComponentName(const std::string& name) : variable(name.substr(0, name.find('['))) {
    if (name.ends_with(']')) component = name.substr(variable.size() + 1, name.size() - variable.size() - 2);
  }
};

const results::Variable& variable_of(const results::Dataset& dataset, std::string_view name) {
  return *std::ranges::find(dataset.variables, name, &results::Variable::name);
}

/// The name of each component along a dimension: by its coordinate, else counted from 0.
std::string component_name(const results::Dataset& dataset, const std::string& dimension, std::size_t part) {
  const auto coordinate = std::ranges::find(dataset.variables, dimension, &results::Variable::name);
  std::string text;
  if (coordinate == dataset.variables.end()) return std::to_string(part);
  append_value(text, coordinate->values, part, {});
  return text;
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

bool are_same(const results::NamedLength& one, const results::NamedLength& other) {
  return one.name == other.name && one.length == other.length;
}

bool is_own_coordinate(const Entry& entry) {
  return entry.dimensions.size() == 1 && entry.dimensions[0].name == entry.name;
}

std::size_t points_of(const std::vector<results::NamedLength>& rows) {
  std::size_t points = 1;
  for (const results::NamedLength& dimension : rows) points *= dimension.length;
  return points;
}

/// Advances to the next point, the last dimension first.
void advance(std::vector<std::size_t>& at, const std::vector<results::NamedLength>& rows) {
  for (std::size_t d = rows.size(); d-- > 0;) {
    if (++at[d] < rows[d].length) return;
    at[d] = 0;
  }
}

/// Which values of an axis are the one that --where asks for.
std::vector<bool> indexes_of(const results::Variable& axis, double wanted) {
  std::vector<double> values;
  std::visit(
      [&]<class T>(const std::vector<T>& of_type) {
        if constexpr (std::is_arithmetic_v<T>)
          for (const T value : of_type) values.push_back(static_cast<double>(value));
      },
      axis.values);
  const double extent = values.empty() ? 0.0 : std::ranges::max(values) - std::ranges::min(values);
  const double near_enough = same * (std::isfinite(extent) ? std::max(extent, std::abs(wanted)) : std::abs(wanted));
  const auto is_it = [&](double value) {
    return value == wanted || (std::isfinite(wanted) && std::abs(value - wanted) <= near_enough);
  };
  std::vector<bool> here;
  for (const double value : values) here.push_back(is_it(value));
  if (std::ranges::find(here, true) != here.end()) return here;
  std::string asked, near;
  append_number(asked, wanted);
  std::ranges::sort(values, {}, [&](double value) { return std::abs(value - wanted); });
  for (std::size_t i = 0; i < std::min<std::size_t>(2, values.size()); ++i)
    append_number(near += i == 0 ? "" : " and ", values[i]);
  throw ChoiceError("--where " + axis.name + '=' + asked + ": the axis has no such value; the nearest are " + near);
}

}  // namespace

CsvTable::CsvTable(const results::FileSummary& summary, const std::string& path, TableChoice choice)
    : summary_(summary), path_(path), choice_(std::move(choice)) {
  const Entry* const status = find("status");
  for (const auto& [name, value] : summary_.attributes)
    if (name == "shard")
      throw storage::IoError(storage::quoted_name(path_) + " is shard " + storage::excerpt(value) +
                             " of a sweep; join all with `clatter merge` first");
  if (status == nullptr && find("arclength") != nullptr)
    throw storage::IoError(storage::quoted_name(path_) +
                           " holds branches, not points of a sweep; read it with h5py, xarray or plot.py");
  if (status == nullptr) storage::refuse_reading(path_, "has no status", "name a whole output of clatter");
  rows_ = status->dimensions;
  for (const results::NamedLength& dimension : rows_)
    for (const Entry& entry : summary_.variables)
      if (is_coordinate(entry, dimension)) axes_.push_back(entry.name);
  const std::vector<std::string> known = results_in_file();
  for (const std::string& name : choice_.only) require_known(name, known);
  for (const std::string& name : known)
    if (choice_.only.empty() || is_named(name)) results_.push_back(name);
  for (const auto& [axis, value] : choice_.where)
    if (std::ranges::find(axes_, axis) == axes_.end()) refuse_axis(axis);
  collect_variables();
}

/// Whether a variable gives the places of the points along a dimension of the rows: the axis that names it, one linked
/// to that, or a direction.
bool CsvTable::is_coordinate(const Entry& entry, const results::NamedLength& dimension) {
  if (entry.dimensions.size() != 1 || !are_same(entry.dimensions[0], dimension)) return false;
  return entry.name == dimension.name || Parameter::of(entry.name).has_value();
}

const Entry* CsvTable::find(std::string_view name) const {
  const auto found = std::ranges::find(summary_.variables, name, &Entry::name);
  return found == summary_.variables.end() ? nullptr : &*found;
}

/// All variables with a value or several for each row.
std::vector<std::string> CsvTable::results_in_file() const {
  const auto is_logged = [](const Entry& entry) {
    return entry.dimensions.size() == 1 && entry.dimensions[0].name == log_dimension;
  };
  if (choice_.impacts && find(log_counts) == nullptr)
    throw ChoiceError("--impacts: " + storage::quoted_name(path_) +
                      " has no impact log; run its configuration with --set observe.impact_log=true");
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
    throw ChoiceError("--only: " + config::in_quotes(choice_.only.front()) + " is no component; there are " + name +
                      '[' + component_name(dataset, along.name, 0) + "] to " + name + '[' +
                      component_name(dataset, along.name, along.length - 1) + ']');
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
  for (const auto& [axis, value] : choice_.where) {
    const std::string& dimension = find(axis)->dimensions[0].name;
    const auto place = std::ranges::find(rows_, dimension, &results::NamedLength::name) - rows_.begin();
    std::vector<bool>& along = wanted[static_cast<std::size_t>(place)];
    const std::vector<bool> here = indexes_of(variable_of(dataset, axis), value);
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
