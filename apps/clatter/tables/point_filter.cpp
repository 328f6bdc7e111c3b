#include "tables/point_filter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <type_traits>
#include <utility>
#include <variant>

#include "config/config_error.hpp"
#include "config/suggestion.hpp"
#include "steady/status.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/csv_text.hpp"
#include "tables/result_names.hpp"
#include "tables/variable_words.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
double number_of(const Condition& condition, const results::FileSummary::Entry& entry, const std::string& path) try {
  if (!condition.value)
    throw ChoiceError("--where " + text_of(condition) + ": " + config::in_quotes(condition.name) +
                      " is a number; expected one" + (entry.units == "1" ? "" : ", in " + entry.units));
  return config::in_unit_of_file(*condition.value, entry.units, {.source = "--where " + condition.name},
                                 config::in_quotes(condition.name) + " in " + storage::quoted_name(path));
} catch (const config::ConfigError& error) {
  throw ChoiceError(error.what());
}

bool has_harder_stop(std::string_view result) {
  if (result.starts_with(special_prefix)) result.remove_prefix(special_prefix.size());
  return result == "impact_speed" || result == "contact_force_max";
}

PointFilter::PointFilter(const results::FileSummary& summary, std::string path, std::vector<results::NamedLength> rows,
                         std::vector<Condition> conditions)
    : summary_(summary), path_(std::move(path)), rows_(std::move(rows)) {
  const auto need = [&](const std::string& name) {
    if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
  };
  for (Condition& condition : conditions) {
    asked_.push_back(compared(std::move(condition)));
    const auto& [asked, entry, layout] = asked_.back();
    need(entry->name);
    if (layout == Layout::ended) need("attractor");
    if (layout == Layout::components && find_variable(summary_, entry->dimensions.back().name) != nullptr)
      need(entry->dimensions.back().name);
    const Entry* const status = find_variable(summary_, "status");
    if (layout != Layout::axis && status != nullptr && std::ranges::equal(status->dimensions, rows_, are_same))
      need("status");
  }
  refuse_contradictions();
}

/// Throws ChoiceError at two conditions that no value meets.
void PointFilter::refuse_contradictions() const {
  const auto are_of_one = [](const Compared& one, const Compared& other) {
    return one.entry == other.entry &&
           ComponentName(one.condition.name).component == ComponentName(other.condition.name).component &&
           !(one.layout == Layout::components && one.entry->dimensions.back().name == "meeting");
  };
  const auto contradict = [&](const Compared& one, const Compared& other) {
    const Condition &first = one.condition, &second = other.condition;
    if (first.value && second.value && one.entry->type != "string")
      return exclude(first.comparison, number_of(first, *one.entry, path_), second.comparison,
                     number_of(second, *one.entry, path_));
    const bool is_first = first.comparison == Comparison::equal, is_second = second.comparison == Comparison::equal;
    return (is_first || is_second) && (is_first && is_second) == (first.word != second.word);
  };
  for (std::size_t i = 0; i < asked_.size(); ++i)
    for (std::size_t k = i + 1; k < asked_.size(); ++k)
      if (are_of_one(asked_[i], asked_[k]) && contradict(asked_[i], asked_[k]))
        throw ChoiceError("--where " + text_of(asked_[k].condition) + " beside --where " +
                          text_of(asked_[i].condition) + ": no value meets both; leave one of them out");
}

/// The variable of that name; of special points also without what their names begin with.
const PointFilter::Entry* PointFilter::find(const std::string& name) const {
  const bool is_special = rows_.size() == 1 && rows_[0].name == special_points;
  return find_variable(summary_, name_in_file(summary_, name, is_special ? special_prefix : std::string_view{}));
}

std::optional<PointFilter::Layout> PointFilter::layout_of(const Entry& entry) const {
  const auto& along = entry.dimensions;
  if (std::ranges::equal(along, rows_, are_same) && (rows_.size() != 1 || entry.type == "string"))
    return Layout::result;
  for (const results::NamedLength& row : rows_)
    if (along.size() == 1 && are_same(along[0], row)) {
      const std::vector<std::string> axes = coordinates_along(summary_, row);
      const bool is_axis = entry.type != "string" && std::ranges::find(axes, entry.name) != axes.end();
      return is_axis ? Layout::axis : Layout::result;
    }
  const Entry* const numbers = find_variable(summary_, "attractor");
  if (is_of_motions(entry) && numbers != nullptr && std::ranges::equal(numbers->dimensions, rows_, are_same))
    return Layout::ended;
  const bool is_over_rows =
      along.size() == rows_.size() + 1 && std::equal(rows_.begin(), rows_.end(), along.begin(), are_same);
  return is_over_rows && entry.type != "string" ? std::optional(Layout::components) : std::nullopt;
}

void PointFilter::refuse(const std::string& name) const {
  const ComponentName part(name);
  const Entry* const whole = find(part.variable);
  if (whole != nullptr && part.component && layout_of(*whole))
    throw ChoiceError("--where: " + config::in_quotes(name) + " is no component of " +
                      config::in_quotes(part.variable) + ", which has one value a point");
  if (find_variable(summary_, std::string(special_prefix) + part.variable) != nullptr)
    throw ChoiceError("--where: " + config::in_quotes(name) + " is of special points; " +
                      "`clatter export --special` chooses among them");
  std::vector<std::string> axes;
  for (const results::NamedLength& row : rows_)
    for (const std::string& axis : coordinates_along(summary_, row)) axes.push_back(axis);
  std::vector<std::string_view> known(axes.begin(), axes.end());
  for (const Entry& entry : summary_.variables)
    if (layout_of(entry)) known.push_back(entry.name);
  const std::string_view near = config::nearest(name, known);
  const std::vector<std::string_view> names(axes.begin(), axes.end());
  throw ChoiceError("--where: " + config::in_quotes(name) + " is neither an axis nor a result of " +
                    storage::quoted_name(path_) +
                    (near.empty() ? (axes.empty() ? ", which has no axis; `clatter info` lists its results"
                                                  : "; its axes are " + config::joined(names))
                                  : "; did you mean '" + std::string(near) + "'?"));
}

PointFilter::Compared PointFilter::compared(Condition condition) const {
  const ComponentName name(condition.name);
  const Entry* const entry = find(name.variable);
  const std::optional<Layout> layout = entry != nullptr ? layout_of(*entry) : std::nullopt;
  if (!layout || (name.component && *layout != Layout::components)) refuse(condition.name);
  if ((entry->type == "string") && condition.comparison != Comparison::equal &&
      condition.comparison != Comparison::not_equal)
    throw ChoiceError("--where " + text_of(condition) + ": words are equal or not; write e.g. " + condition.name + '=' +
                      condition.word);
  return {std::move(condition), entry, *layout};
}

/// Throws IoError unless every variable has a value for each of its places: anyone may have made the file.
void PointFilter::require_complete(const results::Dataset& dataset) const {
  for (const std::string& name : names_) {
    const std::size_t size =
        std::visit([](const auto& values) { return values.size(); }, variable_of(dataset, name).values);
    if (size != points_of(find_variable(summary_, name)->dimensions))
      storage::refuse_reading(path_, "is damaged: " + config::in_quotes(name) + " has another length",
                              "run its configuration again");
  }
}

void PointFilter::keep_along_axis(const Compared& asked, const results::Dataset& dataset,
                                  std::vector<bool>& kept) const {
  const results::Variable& axis = variable_of(dataset, asked.entry->name);
  const double wanted = number_of(asked.condition, *asked.entry, path_);
  const std::vector<double> values = numbers_in(axis.values);
  const double same = same_on_axis(values, wanted);
  std::vector<bool> here(values.size());
  for (std::size_t i = 0; i < values.size(); ++i) here[i] = holds(values[i], asked.condition.comparison, wanted, same);
  if (asked.condition.comparison == Comparison::equal && std::ranges::find(here, true) == here.end())
    refuse_value(asked.entry->name, wanted, values);
  const auto dimension = static_cast<std::size_t>(
      std::ranges::find(rows_, asked.entry->dimensions[0].name, &results::NamedLength::name) - rows_.begin());
  std::vector<std::size_t> at(rows_.size(), 0);
  for (std::size_t point = 0; point < kept.size(); ++point, advance(at, rows_))
    kept[point] = kept[point] && here[at[dimension]];
}

/// The values of motions for each point; of a point that ends in none an empty one, NaN of numbers.
template <class Value>
std::vector<Value> PointFilter::by_point(const Compared& asked, std::vector<Value> values,
                                         const results::Dataset& dataset) const {
  if (asked.layout != Layout::ended) return values;
  const std::vector<double> numbers = numbers_in(variable_of(dataset, "attractor").values);
  std::vector<Value> of_points(numbers.size());
  for (std::size_t point = 0; point < numbers.size(); ++point) {
    const bool is_known = numbers[point] >= 0 && numbers[point] < static_cast<double>(values.size());
    if (is_known)
      of_points[point] = values[static_cast<std::size_t>(numbers[point])];
    else if constexpr (std::is_same_v<Value, double>)
      of_points[point] = std::nan("");
  }
  return of_points;
}

/// The numbers of each point: of components the named one, or that which stands for all.
std::vector<double> PointFilter::of_components(const Compared& asked, const results::Dataset& dataset,
                                               const std::vector<double>& all) const {
  const results::NamedLength& along = asked.entry->dimensions.back();
  const auto named = ComponentName(asked.condition.name).component;
  const std::string option = "--where " + text_of(asked.condition) + ": ", &name = asked.entry->name;
  if (!named && !has_harder_stop(name))
    throw ChoiceError(option + "which component? There are " + component_names(dataset, name, along));
  std::vector<double> numbers(points_of(rows_), std::nan(""));
  bool is_known = !named;
  for (std::size_t part = 0; part < along.length; ++part) {
    if (named && component_name(dataset, along.name, part) != *named) continue;
    is_known = true;
    for (std::size_t point = 0; point < numbers.size(); ++point)
      numbers[point] = std::fmax(numbers[point], all[point * along.length + part]);
  }
  if (!is_known) throw ChoiceError(option + "there are " + component_names(dataset, name, along));
  return numbers;
}

std::vector<double> PointFilter::numbers_of(const Compared& asked, const results::Dataset& dataset) const {
  std::vector<double> all = numbers_in(variable_of(dataset, asked.entry->name).values);
  return asked.layout == Layout::components ? of_components(asked, dataset, all) : by_point(asked, all, dataset);
}

std::vector<bool> PointFilter::failed_points(const results::Dataset& dataset) const {
  std::vector<bool> is_failed(points_of(rows_), false);
  if (std::ranges::find(names_, "status") == names_.end()) return is_failed;
  const auto* const status = results::values_of<std::uint8_t>(dataset, "status");
  for (std::size_t point = 0; status != nullptr && point < is_failed.size(); ++point)
    is_failed[point] = failed(static_cast<steady::Status>((*status)[point]));
  return is_failed;
}

void PointFilter::keep_results(const Compared& asked, const results::Dataset& dataset, std::vector<bool>& kept) const {
  const results::Variable& variable = variable_of(dataset, asked.entry->name);
  const Condition& condition = asked.condition;
  const Entry* const entry = asked.entry;
  const Layout layout = asked.layout;
  const bool by_word = is_text(variable) || (!condition.value && !meanings_of(variable).empty());
  const std::vector<bool> is_failed = failed_points(dataset);
  const auto keep = [&](const auto& meets) {
    for (std::size_t point = 0; point < kept.size(); ++point)
      kept[point] = kept[point] && (entry->name == "status" || !is_failed[point]) && meets(point);
  };
  if (by_word) {
    const std::vector<std::string> words = by_point(asked, words_of(variable), dataset);
    require_known_word(condition, variable);
    const bool is_equal = condition.comparison == Comparison::equal;
    keep([&](std::size_t point) { return (words[point] == condition.word) == is_equal; });
  } else if (layout == Layout::components &&
             entry->dimensions.back().name == "meeting") {  // any of the branches that meet in a special point
    const std::vector<double> all = numbers_in(variable.values);
    const double wanted = number_of(condition, *entry, path_);
    const std::size_t width = entry->dimensions.back().length;
    keep([&](std::size_t point) {
      const auto begin = all.begin() + static_cast<std::ptrdiff_t>(point * width);
      return std::any_of(begin, begin + static_cast<std::ptrdiff_t>(width),
                         [&](double number) { return number >= 0 && holds(number, condition.comparison, wanted, 0); });
    });
  } else {
    const double wanted = number_of(condition, *entry, path_);
    const std::vector<double> numbers = numbers_of(asked, dataset);
    keep([&](std::size_t point) { return holds(numbers[point], condition.comparison, wanted, 0); });
  }
}

/// Whether each point meets one condition.
std::vector<bool> PointFilter::met(const Compared& asked, const results::Dataset& dataset) const {
  std::vector<bool> kept(points_of(rows_), true);
  asked.layout == Layout::axis ? keep_along_axis(asked, dataset, kept) : keep_results(asked, dataset, kept);
  return kept;
}

std::vector<bool> PointFilter::chosen(const results::Dataset& dataset) const {
  require_complete(dataset);
  std::vector<bool> kept(points_of(rows_), true);
  for (const Compared& asked : asked_) {
    const std::vector<bool> here = met(asked, dataset);
    for (std::size_t point = 0; point < kept.size(); ++point) kept[point] = kept[point] && here[point];
  }
  return kept;
}

/// "impact_speed is 0.2 ... 0.4 m/s", "word is one of LU, LLUU": the values of points that haven't failed.
std::string PointFilter::values_of(const Compared& asked, const results::Dataset& dataset) const {
  const results::Variable& variable = variable_of(dataset, asked.entry->name);
  const std::string& name = asked.condition.name;
  const std::vector<bool> is_failed = failed_points(dataset);
  const auto counts = [&](std::size_t point) {
    return asked.layout == Layout::axis || asked.entry->name == "status" || !is_failed[point];
  };
  if (is_text(variable) || (!asked.condition.value && !meanings_of(variable).empty())) {
    std::vector<std::string> words = by_point(asked, words_of(variable), dataset);
    for (std::size_t point = 0; point < words.size(); ++point)
      if (!counts(point)) words[point].clear();
    const bool is_free = is_text(variable) && variable.name != "special_kind";  // else it is one of those known
    return name + words_there(is_free ? asked.condition.word : "", words);
  }
  const bool is_of_branches = asked.layout == Layout::components && asked.entry->dimensions.back().name == "meeting";
  const std::vector<double> numbers =
      asked.layout == Layout::axis || is_of_branches ? numbers_in(variable.values) : numbers_of(asked, dataset);
  std::vector<double> there;
  for (std::size_t i = 0; i < numbers.size(); ++i)
    if (!std::isnan(numbers[i]) && (is_of_branches ? numbers[i] >= 0 : counts(i))) there.push_back(numbers[i]);
  if (there.empty()) return name + " has no value at any point";
  const auto [low, high] = std::ranges::minmax(there);
  const std::string unit = unit_text(asked.entry->units);
  return name + " is " + formatted("%.6g", low) + (low == high ? "" : " ... " + formatted("%.6g", high)) +
         (unit.empty() ? "" : ' ' + unit);
}

std::string PointFilter::values_there(const results::Dataset& dataset) const {
  std::string unmet, counts;
  for (const Compared& asked : asked_) {
    const std::vector<bool> here = met(asked, dataset);
    const auto count = std::ranges::count(here, true);
    if (count == 0) unmet += (unmet.empty() ? "" : ", ") + values_of(asked, dataset);
    counts += (counts.empty() ? "" : ", ") + text_of(asked.condition) + " by " + std::to_string(count);
  }
  return unmet.empty() ? "alone each is met: " + counts : unmet;
}

void PointFilter::require_some(const std::vector<bool>& chosen, const results::Dataset& dataset) const {
  if (asked_.empty() || std::ranges::find(chosen, true) != chosen.end()) return;
  std::string text;
  for (const Compared& asked : asked_) text += (text.empty() ? "--where " : " --where ") + text_of(asked.condition);
  throw ChoiceError(text + ": no point of " + storage::quoted_name(path_) +
                    (asked_.size() == 1 ? " meets it; " : " meets them all; ") + values_there(dataset));
}

std::size_t PointFilter::without_value(const results::Dataset& dataset) const {
  std::vector<bool> lacks(points_of(rows_), false);
  for (const Compared& asked : asked_) {
    if (asked.layout == Layout::axis || asked.entry->type != "float64") continue;
    const std::vector<double> numbers = numbers_of(asked, dataset);
    for (std::size_t point = 0; point < lacks.size(); ++point)
      lacks[point] = lacks[point] || std::isnan(numbers[point]);
  }
  const std::vector<bool> is_failed = failed_points(dataset);
  std::size_t count = 0;
  for (std::size_t point = 0; point < lacks.size(); ++point) count += lacks[point] && !is_failed[point] ? 1 : 0;
  return count;
}

}  // namespace clatter::app
