#include "tables/csv_table.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "config/suggestion.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/csv_text.hpp"
#include "tables/motion_rows.hpp"
#include "tables/result_names.hpp"

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

/// What the names of variables that have a value for each row begin with.
std::string_view prefix_of(TableRows rows) {
  switch (rows) {
    case TableRows::impacts:
      return impact_prefix;
    case TableRows::motions:
      return motion_prefix;
    case TableRows::special:
      return special_prefix;
    default:
      return {};
  }
}

void append_row(Pieces& pieces, const std::vector<CsvTable::Column>& columns, const std::vector<std::size_t>& at,
                std::size_t point, std::size_t row) {
  bool first = true;
  for (const CsvTable::Column& column : columns) {
    if (!std::exchange(first, false)) pieces.text() += ',';
    const std::size_t index = column.dimension  ? at[*column.dimension]
                              : column.by_point ? (*column.by_point)[point]
                                                : row * column.width + column.part;
    append_value(pieces.text(), column.variable->values, index, column.meanings);
  }
  pieces.end_line();
}

}  // namespace

CsvTable::CsvTable(const results::FileSummary& summary, const std::string& path, TableChoice choice)
    : summary_(summary),
      path_(path),
      choice_(std::move(choice)),
      rows_(dimensions_of_rows()),
      filter_(summary_, path_, rows_, choice_.where) {
  for (const results::NamedLength& dimension : rows_)
    for (const std::string& name : coordinates_along(summary_, dimension)) axes_.push_back(name);
  if (choice_.rows == TableRows::motions) motions_ = motion_variables(summary_, path_);
  std::vector<std::string> known = results_in_file();
  known.insert(known.end(), motions_.begin(), motions_.end());
  for (std::string& name : choice_.only) {
    if (std::ranges::find(axes_, name) != axes_.end()) continue;  // axes have columns whatever is chosen
    const std::string typed = std::exchange(name, name_in_file(summary_, name, prefix_of(choice_.rows)));
    if (std::ranges::find(axes_, name) == axes_.end()) require_known(typed, name, known);
  }
  const auto is_left_out = [&](const std::string& name) { return !choice_.only.empty() && !is_named(name); };
  std::erase_if(motions_, is_left_out);
  results_ = results_in_file();
  std::erase_if(results_, is_left_out);
  collect_variables();
}

const Entry* CsvTable::find(std::string_view name) const { return find_variable(summary_, name); }

/// Whether a point has a row for each impact, or for each sample.
bool CsvTable::is_ragged() const { return choice_.rows == TableRows::impacts || choice_.rows == TableRows::samples; }

/// The dimensions of the points, or of special points.
std::vector<results::NamedLength> CsvTable::dimensions_of_rows() const {
  if (choice_.rows != TableRows::special) return dimensions_of_points(summary_, path_);
  const Entry* const kind = find("special_kind");
  if (kind == nullptr)
    throw ChoiceError("--special: " + storage::quoted_name(path_) +
                      " has no special points; `clatter branch` writes files that have them");
  return kind->dimensions;
}

/// All variables with a value or several for each row.
std::vector<std::string> CsvTable::results_in_file() const {
  const auto is_over = [](const Entry& entry, std::string_view last) {
    return !entry.dimensions.empty() && entry.dimensions.back().name == last;
  };
  std::vector<std::string> names;
  for (const Entry& entry : summary_.variables) {
    const bool is_axis = std::ranges::find(axes_, entry.name) != axes_.end() || is_own_coordinate(entry);
    const bool is_logged = is_over(entry, logged_impacts) && entry.dimensions.size() == 1;
    const bool is_over_rows = entry.dimensions.size() >= rows_.size() && entry.dimensions.size() <= rows_.size() + 1 &&
                              std::equal(rows_.begin(), rows_.end(), entry.dimensions.begin(), are_same);
    const bool is_sampled = is_over_rows && is_over(entry, trajectory_samples);
    const bool is_history = is_sampled || (is_over_rows && is_over(entry, "section"));
    const bool is_result = is_over_rows && !is_logged && !(choice_.rows == TableRows::motions && is_history);
    const bool is_wanted = choice_.rows == TableRows::impacts   ? is_logged
                           : choice_.rows == TableRows::samples ? is_sampled
                                                                : is_result;
    if (is_wanted && !is_axis) names.push_back(entry.name);
  }
  if (choice_.rows == TableRows::impacts && find(log_counts) == nullptr)
    refuse_rows("--impacts", "no impact log", "observe.impact_log=true");
  if (choice_.rows == TableRows::samples && names.empty())
    refuse_rows("--samples", "no trajectories", "observe.trajectory=1000");
  return names;
}

void CsvTable::refuse_rows(const std::string& option, const std::string& lack, const std::string& setting) const {
  throw ChoiceError(option + ": " + storage::quoted_name(path_) + " has " + lack + "; " +
                    (holds_branches(summary_) ? "no branch has one" : "run its configuration with --set " + setting));
}

/// Whether a result has a column for each of several components.
bool CsvTable::has_components(const std::string& name) const {
  return !is_ragged() && std::ranges::find(motions_, name) == motions_.end() &&
         find(name)->dimensions.size() > rows_.size();
}

void CsvTable::require_known(const std::string& typed, const std::string& name,
                             const std::vector<std::string>& known) const {
  const ComponentName part(name);
  const std::string option = "--only: " + config::in_quotes(typed);
  const std::vector<std::string_view> names(known.begin(), known.end());
  if (std::ranges::find(known, part.variable) == known.end())
    throw ChoiceError(option + " is no column of " + storage::quoted_name(path_) +
                      config::suggestion(part.variable, names, "; there are "));
  if (part.component && !has_components(part.variable))
    throw ChoiceError(option + " is no component of " + config::in_quotes(ComponentName(typed).variable) +
                      ", which has one value a row");
}

/// Whether --only names a result or a component of it.
bool CsvTable::is_named(const std::string& name) const {
  return std::ranges::any_of(choice_.only,
                             [&](const std::string& only) { return ComponentName(only).variable == name; });
}

/// The axes, the results and the coordinates of their components; of impacts also their counts, of motions their
/// numbers.
void CsvTable::collect_variables() {
  const auto need = [&](const std::string& name) {
    if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
  };
  for (const std::vector<std::string>& some : {axes_, filter_.variables(), motions_})
    for (const std::string& name : some) need(name);
  if (choice_.rows == TableRows::impacts) need(std::string(log_counts));
  if (choice_.rows == TableRows::motions) need("attractor");
  for (const std::string& name : results_) {
    const std::vector<results::NamedLength>& dimensions = find(name)->dimensions;
    if (!is_ragged() && dimensions.size() > rows_.size() && find(dimensions.back().name) != nullptr)
      need(dimensions.back().name);
    need(name);
  }
}

/// The columns of a result: one, or one for each component that is wanted.
std::vector<CsvTable::Column> CsvTable::columns_of(const std::string& name, const results::Dataset& dataset) const {
  const results::Variable& variable = variable_of(dataset, name);
  const std::vector<results::NamedLength>& dimensions = find(name)->dimensions;
  if (is_ragged() || dimensions.size() == rows_.size()) return {{name, &variable, meanings_of(variable)}};
  const results::NamedLength& along = dimensions.back();
  std::vector<std::string> all;
  for (std::size_t part = 0; part < along.length; ++part)
    all.push_back(name + '[' + component_name(dataset, along.name, part) + ']');
  for (const std::string& only : choice_.only)
    if (ComponentName(only).variable == name && only != name && std::ranges::find(all, only) == all.end())
      throw ChoiceError("--only: " + config::in_quotes(only) + " is no component; there are " +
                        component_names(dataset, name, along));
  std::vector<Column> columns;
  for (std::size_t part = 0; part < along.length; ++part) {
    const auto names_it = [&](const std::string& only) { return only == name || only == all[part]; };
    if (choice_.only.empty() || std::ranges::any_of(choice_.only, names_it))
      columns.push_back({all[part], &variable, meanings_of(variable), along.length, part});
  }
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
  for (Column& column : motion_columns(dataset)) columns.push_back(std::move(column));
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

/// The columns of motions: each point has those of the motion that it ends in.
std::vector<CsvTable::Column> CsvTable::motion_columns(const results::Dataset& dataset) const {
  std::vector<Column> columns;
  if (motions_.empty()) return columns;
  const MotionRows rows(summary_, path_, dataset);
  const auto of_motion = std::make_shared<const std::vector<std::size_t>>(rows.motion_of_points()),
             of_share = std::make_shared<const std::vector<std::size_t>>(rows.share_of_points());
  for (const std::string& name : motions_) {
    const results::Variable& variable = variable_of(dataset, name);
    const bool is_share = find(name)->dimensions.size() > 1;
    columns.push_back({name, &variable, meanings_of(variable), 1, 0, std::nullopt, is_share ? of_share : of_motion});
  }
  return columns;
}

/// Throws IoError unless each column has a value for each row: anyone may have made the file.
void CsvTable::require_complete(const std::vector<Column>& columns, std::size_t rows) const {
  for (const Column& column : columns) {
    const std::size_t length = std::visit([](const auto& values) { return values.size(); }, column.variable->values);
    const std::size_t wanted = column.dimension  ? rows_[*column.dimension].length
                               : column.by_point ? points_of(find(column.variable->name)->dimensions)
                                                 : rows * column.width;
    if (length != wanted)
      storage::refuse_reading(path_, "is damaged: " + config::in_quotes(column.variable->name) + " has another length",
                              "run its configuration again");
  }
}

/// The rows of each point.
std::vector<std::size_t> CsvTable::rows_of_points(const results::Dataset& dataset) const {
  const bool is_sampled = choice_.rows == TableRows::samples && !results_.empty();
  std::vector<std::size_t> rows(points_of(rows_), is_sampled ? find(results_[0])->dimensions.back().length : 1);
  if (choice_.rows != TableRows::impacts) return rows;
  const auto* const counts = std::get_if<std::vector<std::int64_t>>(&variable_of(dataset, log_counts).values);
  const bool is_sound =
      counts != nullptr && counts->size() == rows.size() &&
      std::ranges::all_of(*counts, [](std::int64_t count) { return count >= 0 && count < most_impacts; });
  if (!is_sound)
    storage::refuse_reading(path_, "is damaged: 'impact_count' is none of its points", "run its configuration again");
  std::ranges::transform(*counts, rows.begin(), [](std::int64_t count) { return static_cast<std::size_t>(count); });
  return rows;
}

/// Whether `where` chooses each point; of motions only the first that ends in each.
std::vector<bool> CsvTable::chosen(const results::Dataset& dataset) const {
  std::vector<bool> chosen = filter_.chosen(dataset);
  filter_.require_some(chosen, dataset);
  if (choice_.rows == TableRows::motions) MotionRows(summary_, path_, dataset).keep_first(chosen);
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
    for (std::size_t i = 0; is_chosen[point] && i < rows[point]; ++i) append_row(pieces, shown, at, point, row + i);
    row += rows[point];
  }
  pieces.flush();
}

}  // namespace clatter::app
