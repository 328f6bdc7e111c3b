#include "point_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <utility>
#include <variant>

#include "config/config_error.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "csv_text.hpp"
#include "steady/status.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"

namespace clatter::app {
namespace {

constexpr std::array<std::pair<std::string_view, Comparison>, 7> signs{{{"<=", Comparison::at_most},
                                                                        {">=", Comparison::at_least},
                                                                        {"!=", Comparison::not_equal},
                                                                        {"==", Comparison::equal},
                                                                        {"=", Comparison::equal},
                                                                        {"<", Comparison::less},
                                                                        {">", Comparison::greater}}};

constexpr std::string_view examples = "expected e.g. nu=1.0, 'impact_speed < 0.4 m/s' or impact_word=LU";

std::string_view sign_of(Comparison comparison) {
  if (comparison == Comparison::equal) return "=";
  return std::ranges::find(signs, comparison, &std::pair<std::string_view, Comparison>::second)->first;
}

/// Whether a number compares as asked; `same` is the distance of numbers that count as equal. NaN never does.
bool holds(double number, Comparison comparison, double asked, double same) {
  const bool is_same = number == asked || std::abs(number - asked) <= same;
  switch (comparison) {
    case Comparison::equal:
      return is_same;
    case Comparison::not_equal:
      return !is_same && !std::isnan(number);
    case Comparison::less:
      return number < asked && !is_same;
    case Comparison::at_most:
      return number < asked || is_same;
    case Comparison::greater:
      return number > asked && !is_same;
    case Comparison::at_least:
      return number > asked || is_same;
  }
  return false;
}

bool is_text(const results::Variable& variable) {
  return std::holds_alternative<std::vector<std::string>>(variable.values);
}

/// The word for each value: the text itself, or the meaning of a flag.
std::vector<std::string> words_of(const results::Variable& variable) {
  if (const auto* const texts = std::get_if<std::vector<std::string>>(&variable.values)) return *texts;
  const std::vector<std::string> meanings = meanings_of(variable);
  const std::vector<double> flags = numbers_in(variable.values);
  std::vector<std::string> words(flags.size());
  for (std::size_t i = 0; i < flags.size(); ++i) append_value(words[i], variable.values, i, meanings);
  return words;
}

/// Of a flag, whose words are known, one of them is meant.
void require_meaning(const Condition& condition, const std::vector<std::string>& meanings) {
  std::vector<std::string_view> known;
  for (const std::string& meaning : meanings)
    if (!meaning.empty()) known.push_back(meaning);
  if (known.empty() || std::ranges::find(known, condition.word) != known.end()) return;
  throw ChoiceError("--where " + text_of(condition) + ": no such " + condition.name +
                    config::suggestion(condition.word, known, "; there are "));
}

}  // namespace

std::string text_of(const Condition& condition) {
  return condition.name + std::string(sign_of(condition.comparison)) + condition.word;
}

Condition condition_of(const std::string& text) {
  const std::size_t at = text.find_first_of("=<>!");
  const std::string option = "--where " + config::in_quotes(text);
  const auto sign = std::ranges::find_if(
      signs, [&](const auto& one) { return at != std::string::npos && text.substr(at).starts_with(one.first); });
  const std::string name(config::without_blanks(std::string_view(text).substr(0, std::min(at, text.size()))));
  if (sign == signs.end() || name.empty()) throw ChoiceError(option + "; " + std::string(examples));
  Condition condition{name,
                      sign->second,
                      {},
                      config::unquoted(config::without_blanks(std::string_view(text).substr(at + sign->first.size())))};
  const bool is_word = condition.word.find_first_of("0123456789") == std::string::npos &&
                       condition.word.find("pi") == std::string::npos && condition.word != "inf" &&
                       condition.word != "-inf";
  if (condition.word.empty()) throw ChoiceError(option + ": nothing to compare with; " + std::string(examples));
  if (is_word) return condition;
  try {
    condition.value = config::parse_reading({condition.word, {.source = option}});
  } catch (const config::ConfigError& error) {
    const bool is_number = std::string_view("0123456789.+-").find(condition.word.front()) != std::string_view::npos;
    if (is_number) throw ChoiceError(std::string(error.what()) + "; " + std::string(examples));
  }
  return condition;
}

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
    if (layout == Layout::components && find_variable(summary_, entry->dimensions.back().name) != nullptr)
      need(entry->dimensions.back().name);
    const Entry* const status = find_variable(summary_, "status");
    if (layout != Layout::axis && status != nullptr && std::ranges::equal(status->dimensions, rows_, are_same))
      need("status");
  }
}

/// The variable of that name; of special points also without what their names begin with.
const PointFilter::Entry* PointFilter::find(const std::string& name) const {
  const bool is_special = rows_.size() == 1 && rows_[0].name == special_points;
  const Entry* const special = is_special ? find_variable(summary_, std::string(special_prefix) + name) : nullptr;
  return special != nullptr ? special : find_variable(summary_, name);
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
  const bool is_over_rows =
      along.size() == rows_.size() + 1 && std::equal(rows_.begin(), rows_.end(), along.begin(), are_same);
  return is_over_rows && entry.type != "string" ? std::optional(Layout::components) : std::nullopt;
}

void PointFilter::refuse(const std::string& name) const {
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
  return asked.layout == Layout::components ? of_components(asked, dataset, all) : all;
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
    const std::vector<std::string> words = words_of(variable);
    require_meaning(condition, meanings_of(variable));
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

std::vector<bool> PointFilter::chosen(const results::Dataset& dataset) const {
  require_complete(dataset);
  std::vector<bool> kept(points_of(rows_), true);
  for (const Compared& asked : asked_)
    asked.layout == Layout::axis ? keep_along_axis(asked, dataset, kept) : keep_results(asked, dataset, kept);
  return kept;
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
