#include "answers/ranges.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <numeric>
#include <optional>
#include <utility>
#include <variant>

#include "answers/quantiles.hpp"
#include "config/suggestion.hpp"
#include "config/value_grammar.hpp"
#include "steady/status.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/csv_text.hpp"
#include "tables/result_names.hpp"

namespace clatter::app {
namespace {

constexpr const char* met_word = "yes";

/// A number that is whole, or over this many periods, as text: "2", "3/2"; empty: it is neither, or NaN.
std::string count_text(double number, double periods) {
  if (std::isnan(number)) return {};
  if (number == std::floor(number)) return config::number_text(number);
  const double times = number * periods, whole = std::round(times);
  constexpr double rounding = 1e-9;
  const bool is_whole = periods > 1 && std::abs(times - whole) <= rounding * std::abs(times);
  return is_whole ? config::number_text(whole) + '/' + config::number_text(periods) : "";
}

/// The word for one value of a result: a text, the meaning of a flag, or a count; empty: NaN, or no count.
std::string told_word(const results::Variable& variable, std::size_t index, double periods = 1) {
  if (const auto* const numbers = std::get_if<std::vector<double>>(&variable.values))
    return count_text((*numbers)[index], periods);
  std::string text;
  append_value(text, variable.values, index, meanings_of(variable));
  return storage::printable(text);
}

/// The forcing periods of the motion of each point, as far as they are known.
std::vector<double> periods_of(const results::Dataset& dataset, std::size_t points) {
  const auto* const ratios = results::values_of<double>(dataset, "period_ratio");
  return ratios != nullptr && ratios->size() == points ? *ratios : std::vector<double>(points, 1.0);
}

}  // namespace

Ranges::Ranges(const results::FileSummary& summary, const std::string& path, RangeChoice choice)
    : summary_(summary),
      path_(path),
      choice_(std::move(choice)),
      named_(choice_.result.empty() ? "" : name_in_file(summary, choice_.result)),
      rows_(dimensions_of_points(summary, path)),
      filter_(summary, path, rows_, choice_.where) {
  if (holds_accuracy(summary_))
    throw ChoiceError(storage::quoted_name(path_) +
                      " holds what accuracy costs; ranges are of `clatter run` and branch");
  if (holds_branches(summary_) && find_variable(summary_, "branch") == nullptr)
    storage::refuse_reading(path_, "is damaged: it has no 'branch'", "follow its configuration again");
  along_ = dimension_along();
  const auto need = [&](const std::string& name) {
    if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
  };
  if (!choice_.result.empty()) {
    result_ = &require_result();
    need(result_->name);
    const Entry* const ratio = find_variable(summary_, "period_ratio");
    if (ratio != nullptr && std::ranges::equal(ratio->dimensions, rows_, are_same)) need(ratio->name);
    if (is_of_motions(*result_)) need("attractor");
    if (result_->dimensions.size() > rows_.size() &&
        find_variable(summary_, result_->dimensions.back().name) != nullptr)
      need(result_->dimensions.back().name);
  }
  if (find_variable(summary_, "status") != nullptr) need("status");
  for (const std::string& name : filter_.variables()) need(name);
  const std::vector<std::string> sampled = sampled_axes(summary_);
  for (std::size_t d = 0; d < rows_.size(); ++d)
    for (const std::string& name : coordinates_along(summary_, rows_[d])) {
      need(name);
      if (d == along_ && std::ranges::find(sampled, name) != sampled.end()) is_sample_ = true;
    }
  if (is_sample_ && result_ != nullptr)
    throw ChoiceError("--ranges: the points along " + config::in_quotes(along()) +
                      " are a sample, which has no neighbours; ask for the share of a word: --where " + result_->name +
                      "=...");
}

const results::FileSummary::Entry& Ranges::require_result() const {
  const ComponentName name(named_);
  const Entry* const numbers = find_variable(summary_, "attractor");
  const bool has_motions = numbers != nullptr && std::ranges::equal(numbers->dimensions, rows_, are_same);
  const Entry* const found = find_variable(summary_, name.variable);
  const auto is_over_rows = [&](const Entry& entry) {
    const std::size_t parts = entry.dimensions.size() - std::min(rows_.size(), entry.dimensions.size());
    if (has_motions && is_of_motions(entry)) return true;
    return entry.dimensions.size() >= rows_.size() && parts <= 1 && !is_own_coordinate(entry) &&
           std::equal(rows_.begin(), rows_.end(), entry.dimensions.begin(), are_same);
  };
  if (found != nullptr && is_over_rows(*found)) {
    const bool has_parts = found->dimensions.size() > rows_.size() && !is_of_motions(*found);
    if (has_parts == name.component.has_value()) return *found;
    throw ChoiceError("--ranges: " + config::in_quotes(choice_.result) +
                      (has_parts ? " has several values a point; name one, e.g. " + found->name + "[1]"
                                 : " is no component of " + config::in_quotes(found->name) + ", which has one value"));
  }
  std::vector<std::string_view> names;
  for (const Entry& entry : summary_.variables)
    if (is_over_rows(entry) && entry.type != "float64") names.push_back(entry.name);
  throw ChoiceError("--ranges: " + config::in_quotes(choice_.result) + " is no result of points in " +
                    storage::quoted_name(path_) + config::suggestion(name.variable, names, "; names and counts are "));
}

/// The dimension that --along names, else the longest.
std::size_t Ranges::dimension_along() const {
  std::vector<std::string> known;
  for (std::size_t d = 0; d < rows_.size(); ++d)
    for (const std::string& name : coordinates_along(summary_, rows_[d])) {
      if (name == choice_.along) return d;
      known.push_back(name);
    }
  if (!choice_.along.empty()) {
    const std::vector<std::string_view> names(known.begin(), known.end());
    throw ChoiceError(
        "--along: " + config::in_quotes(choice_.along) + " is no axis of " + storage::quoted_name(path_) +
        (names.empty() ? ", which has none" : config::suggestion(choice_.along, names, "; its axes are ")));
  }
  const auto longest = std::ranges::max_element(rows_, {}, &results::NamedLength::length);
  return static_cast<std::size_t>(longest - rows_.begin());
}

std::size_t Ranges::index_along(std::size_t point, std::size_t dimension) const {
  for (std::size_t d = rows_.size(); d-- > dimension + 1;) point /= rows_[d].length;
  return point % rows_[dimension].length;
}

std::vector<Whereabouts> Ranges::coordinates(std::size_t dimension, std::size_t index,
                                             const results::Dataset& dataset) const {
  std::vector<Whereabouts> found;
  for (const std::string& name : coordinates_along(summary_, rows_[dimension])) {
    const bool is_number_of_branch =
        name == branch_points || (rows_[dimension].name == branch_points && name == "branch");
    if (!is_number_of_branch)
      found.push_back(
          {name, number_at(variable_of(dataset, name).values, index), find_variable(summary_, name)->units});
  }
  return found;
}

/// The values of the result at each point.
std::size_t Ranges::width_of_result() const {
  return result_->dimensions.size() > rows_.size() ? result_->dimensions.back().length : 1;
}

/// Which of them is asked for.
std::size_t Ranges::part_of_result(const results::Dataset& dataset) const {
  const auto named = ComponentName(named_).component;
  if (!named) return 0;
  const results::NamedLength& along = result_->dimensions.back();
  for (std::size_t part = 0; part < width_of_result(); ++part)
    if (component_name(dataset, along.name, part) == *named) return part;
  throw ChoiceError("--ranges: " + config::in_quotes(choice_.result) + " is no component; there are " +
                    component_names(dataset, result_->name, along));
}

std::vector<std::string> Ranges::words_of_result(const results::Dataset& dataset) const {
  const results::Variable& variable = variable_of(dataset, result_->name);
  std::vector<std::string> words(points_of(rows_));
  if (is_of_motions(*result_)) {  // each point has that of the motion that it ends in
    const std::vector<double> numbers = numbers_in(variable_of(dataset, "attractor").values);
    for (std::size_t point = 0; point < words.size(); ++point)
      if (numbers[point] >= 0 && numbers[point] < static_cast<double>(size_of(variable)))
        words[point] = told_word(variable, static_cast<std::size_t>(numbers[point]));
    return words;
  }
  const std::size_t width = width_of_result(), part = part_of_result(dataset);
  const std::vector<double> periods = periods_of(dataset, words.size());
  for (std::size_t point = 0; point < words.size(); ++point)
    words[point] = told_word(variable, point * width + part, periods[point]);
  return words;
}

/// Throws ChoiceError at a result that is neither a name nor a count. Of motion without a period the mean over a window
/// is no count, and neither name the point.
void Ranges::require_counts(const results::Dataset& dataset) const {
  const results::Variable& variable = variable_of(dataset, result_->name);
  const auto* const numbers = std::get_if<std::vector<double>>(&variable.values);
  if (numbers == nullptr || is_of_motions(*result_)) return;
  const std::size_t width = width_of_result(), part = part_of_result(dataset);
  const std::vector<std::string> words = words_of_result(dataset);
  const auto* const status = results::values_of<std::uint8_t>(dataset, "status");
  bool has_count = false;
  std::optional<double> other;
  for (std::size_t point = 0; point < words.size(); ++point) {
    const double number = (*numbers)[point * width + part];
    has_count = has_count || !words[point].empty();
    if (!words[point].empty() || std::isnan(number)) continue;
    const bool has_period = status == nullptr || !lacks_period(static_cast<steady::Status>((*status)[point]));
    if (has_period || !other) other = number;
    if (has_period) has_count = false;
    if (has_period) break;
  }
  if (other && !has_count)
    throw ChoiceError("--ranges: " + config::in_quotes(choice_.result) +
                      " is neither a name nor a count; conditions have ranges, too: --where '" + choice_.result +
                      " < " + config::number_text(*other) + "'");
}

std::vector<std::string> Ranges::words(const results::Dataset& dataset) const {
  for (const std::string& name : names_)
    if (size_of(variable_of(dataset, name)) != points_of(find_variable(summary_, name)->dimensions))
      storage::refuse_reading(path_, "is damaged: " + config::in_quotes(name) + " has another length",
                              "run its configuration again");
  const std::vector<bool> chosen = filter_.chosen(dataset);
  std::vector<std::string> words(chosen.size(), met_word);
  if (result_ != nullptr) words = words_of_result(dataset);
  const bool has_status = find_variable(summary_, "status") != nullptr;
  for (std::size_t point = 0; point < words.size(); ++point) {
    if (words[point].empty() && has_status) words[point] = '(' + told_word(variable_of(dataset, "status"), point) + ')';
    if (!chosen[point]) words[point].clear();
  }
  return words;
}

/// The indexes along the axis by its values, unless these go one way.
std::vector<std::size_t> Ranges::order_along(const results::Dataset& dataset) const {
  std::vector<std::size_t> order(rows_[along_].length);
  std::iota(order.begin(), order.end(), std::size_t{0});
  const std::vector<std::string> axes = coordinates_along(summary_, rows_[along_]);
  if (holds_branches(summary_) || axes.empty()) return order;
  const std::vector<double> values = numbers_in(variable_of(dataset, axes.front()).values);
  if (values.size() == order.size() && !std::ranges::is_sorted(values) &&
      !std::ranges::is_sorted(values, std::greater{}))
    std::ranges::stable_sort(order, {}, [&](std::size_t i) { return values[i]; });
  return order;
}

/// Where a point lies along the other axes, or the branch that it is on.
std::vector<Whereabouts> Ranges::others(std::size_t point, const results::Dataset& dataset) const {
  std::vector<Whereabouts> found;
  for (std::size_t d = 0; d < rows_.size(); ++d)
    if (d != along_)
      for (Whereabouts& at : coordinates(d, index_along(point, d), dataset)) found.push_back(std::move(at));
  if (holds_branches(summary_))
    found.push_back({"branch", number_at(variable_of(dataset, "branch").values, point), "1"});
  return found;
}

/// Whether a branch goes back along its parameter from a point on, as beyond a fold.
bool Ranges::turns(const std::vector<std::size_t>& points, std::size_t i, const results::Dataset& dataset) const {
  if (!holds_branches(summary_) || i < 2) return false;
  const auto at = [&](std::size_t k) {
    const std::vector<Whereabouts> there = coordinates(along_, index_along(points[k], along_), dataset);
    return there.empty() ? 0.0 : there.front().value;
  };
  return (at(i) - at(i - 1)) * (at(i - 1) - at(i - 2)) < 0;
}

/// Adds the ranges of points that lie one after the other.
void Ranges::add_line(const std::vector<std::size_t>& points, const std::vector<std::string>& words,
                      const results::Dataset& dataset, std::vector<RangeLine>& lines) const {
  RangeLine& line = lines.emplace_back();
  line.at = others(points.front(), dataset);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const std::string& word = words[points[i]];
    if (word.empty()) continue;
    const bool goes_on = i > 0 && words[points[i - 1]] == word && !turns(points, i, dataset);
    const std::vector<Whereabouts> here = coordinates(along_, index_along(points[i], along_), dataset);
    if (!goes_on) {
      line.ranges.push_back({word, here, here, points[i], points[i], 0});
      if (i > 0) line.ranges.back().before = points[i - 1];
    }
    Range& range = line.ranges.back();
    range.to = here, range.last = points[i], ++range.points;
    range.after = i + 1 < points.size() ? std::optional(points[i + 1]) : std::nullopt;
  }
}

/// The least and the greatest value of each axis.
Range Ranges::extent(const std::vector<std::size_t>& points, const results::Dataset& dataset) const {
  Range range{met_word, {}, {}, points.front(), points.back(), points.size()};
  for (const std::size_t point : points) {
    const std::vector<Whereabouts> here = coordinates(along_, index_along(point, along_), dataset);
    if (range.from.empty()) range.from = range.to = here;
    for (std::size_t i = 0; i < here.size(); ++i) {
      range.from[i].value = std::min(range.from[i].value, here[i].value);
      range.to[i].value = std::max(range.to[i].value, here[i].value);
    }
  }
  return range;
}

std::vector<RangeLine> Ranges::of(const results::Dataset& dataset) const {
  const std::vector<std::string> of_points = words(dataset);
  std::vector<RangeLine> lines;
  if (rows_.empty() && result_ != nullptr)
    throw ChoiceError("--ranges: " + storage::quoted_name(path_) +
                      " has one point and no axis; sweep a key in [sweep] for ranges along it");
  if (rows_.empty()) return lines;
  if (result_ != nullptr) filter_.require_some(filter_.chosen(dataset), dataset), require_counts(dataset);
  std::size_t stride = 1;
  for (std::size_t d = along_ + 1; d < rows_.size(); ++d) stride *= rows_[d].length;
  const std::vector<std::size_t> order = order_along(dataset);
  for (std::size_t begin = 0; begin < of_points.size(); ++begin) {
    if (index_along(begin, along_) != 0) continue;
    std::vector<std::size_t> points;
    for (const std::size_t index : order) points.push_back(begin + index * stride);
    if (is_sample_) {
      std::erase_if(points, [&](std::size_t point) { return of_points[point].empty(); });
      lines.push_back({others(begin, dataset), {}});
      if (!points.empty()) lines.back().ranges.push_back(extent(points, dataset));
    } else if (holds_branches(summary_)) {
      const results::ValueArray& branch = variable_of(dataset, "branch").values;
      for (auto rest = points.begin(); rest != points.end();) {
        const auto end = std::find_if(rest, points.end(),
                                      [&](std::size_t p) { return number_at(branch, p) != number_at(branch, *rest); });
        add_line({rest, end}, of_points, dataset, lines);
        rest = end;
      }
    } else {
      add_line(points, of_points, dataset, lines);
    }
  }
  return lines;
}

Met Ranges::met(const results::Dataset& dataset) const {
  Met met{0, 0, 0, filter_.without_value(dataset)};
  const std::vector<bool> chosen = filter_.chosen(dataset);
  const auto* const status = results::values_of<std::uint8_t>(dataset, "status");
  const bool of_status = std::ranges::any_of(choice_.where, [](const Condition& one) { return one.name == "status"; });
  for (std::size_t point = 0; point < chosen.size(); ++point) {
    const bool is_left_out = !of_status && status != nullptr && failed(static_cast<steady::Status>((*status)[point]));
    ++(is_left_out ? met.failed : met.of);
    if (chosen[point] && !is_left_out) ++met.points;
  }
  if (met.points == 0 && met.of > 0) met.there = filter_.values_there(dataset);
  return met;
}

}  // namespace clatter::app
