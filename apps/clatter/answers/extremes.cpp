#include "answers/extremes.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <map>
#include <string_view>
#include <variant>

#include "config/suggestion.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/csv_text.hpp"
#include "tables/file_points.hpp"
#include "tables/result_names.hpp"

namespace clatter::app {
namespace {

using Entry = results::FileSummary::Entry;

/// What tells the motion of a point, if the file has it.
constexpr std::array<std::string_view, 8> telling{"special_kind", "status", "stable",       "special_stable",
                                                  "impact_word",  "word",   "special_word", "motion_word"};

bool is_in(const std::vector<results::NamedLength>& dimensions, const results::NamedLength& one) {
  return std::ranges::any_of(dimensions, [&](const results::NamedLength& other) { return are_same(one, other); });
}

/// The indexes along some dimensions of one of their combinations, row-major.
std::vector<std::size_t> indexes_of(std::size_t index, const std::vector<results::NamedLength>& dimensions) {
  std::vector<std::size_t> indexes(dimensions.size());
  for (std::size_t d = dimensions.size(); d-- > 0; index /= dimensions[d].length)
    indexes[d] = index % dimensions[d].length;
  return indexes;
}

/// The word for one value of a variable: that of a flag, "stable" or "unstable", or the text itself.
std::string word_at(const results::Variable& variable, std::size_t index) {
  if (variable.name.ends_with("stable")) return number_at(variable.values, index) != 0 ? "stable" : "unstable";
  if (const auto* const texts = std::get_if<std::vector<std::string>>(&variable.values))
    return storage::printable((*texts)[index]);
  std::string text;
  append_value(text, variable.values, index, meanings_of(variable));
  return text;
}

}  // namespace

Extremes::Extremes(const results::FileSummary& summary, const std::string& path, const std::string& name, bool largest,
                   Choice choice)
    : summary_(summary),
      path_(path),
      named_(name_in_file(summary, name)),
      is_largest_(largest),
      choice_(std::move(choice)),
      of_points_(dimensions_of_points(summary, path)),
      result_(&require_result(ComponentName(named_).variable)) {
  for (const results::NamedLength& dimension : result_->dimensions) {
    const bool is_of_points = is_in(of_points_, dimension) || dimension.name == special_points;
    (is_of_points ? places_ : parts_).push_back(dimension);
  }
  if (places_.empty() && !of_points_.empty()) places_.swap(parts_);  // of motions: each of them counts as a point
  filter_.emplace(summary_, path_, places_, choice_.where);
  collect_variables();
  if (!choice_.for_axis.empty() && std::ranges::find(axes_, choice_.for_axis) == axes_.end()) {
    const std::vector<std::string_view> axes(axes_.begin(), axes_.end());
    throw ChoiceError(
        "--for: " + config::in_quotes(choice_.for_axis) + " is no axis of " + storage::quoted_name(path_) +
        (axes.empty() ? ", which has none" : config::suggestion(choice_.for_axis, axes, "; its axes are ")));
  }
  if (!choice_.for_axis.empty() && holds_branches(summary_) && choice_.for_axis != "branch")
    throw ChoiceError("--for: along a branch each point has another value of " + config::in_quotes(choice_.for_axis) +
                      "; write --for branch");
  if (choice_.periodic && std::ranges::find(words_, "status") == words_.end())
    throw ChoiceError("--periodic: " + storage::quoted_name(path_) + " has no status beside " +
                      config::in_quotes(result_->name) + "; leave it out");
}

/// The variable of that name, if it holds numbers of points.
const Entry& Extremes::require_result(const std::string& name) const {
  if (holds_accuracy(summary_))
    throw ChoiceError(storage::quoted_name(path_) +
                      " holds what accuracy costs, by method; --max and --min are for `clatter run` and branch");
  const std::string option = is_largest_ ? "--max: " : "--min: ", file = storage::quoted_name(path_);
  const auto is_axis = [&](const Entry& entry) {
    return is_own_coordinate(entry) ||
           (!holds_branches(summary_) && entry.dimensions.size() == 1 && is_in(of_points_, entry.dimensions[0]) &&
            std::ranges::count(coordinates_along(summary_, entry.dimensions[0]), entry.name) > 0);
  };
  const auto is_logged = [](const Entry& entry) {
    return !entry.dimensions.empty() && entry.dimensions[0].name == logged_impacts;
  };
  const auto is_text = [](const Entry& entry) { return entry.type == "string" || entry.name == "status"; };
  const Entry* const found = find_variable(summary_, name);
  std::vector<std::string_view> results;
  for (const Entry& entry : summary_.variables)
    if (!is_axis(entry) && !is_logged(entry) && !is_text(entry)) results.push_back(entry.name);
  if (found == nullptr)
    throw ChoiceError(option + config::in_quotes(name) + " is no result in " + file +
                      config::suggestion(name, results, "; there are "));
  if (is_logged(*found))
    throw ChoiceError(option + config::in_quotes(name) +
                      " has a value for each impact, not for each point; `clatter export --impacts` prints them");
  if (is_axis(*found) || is_text(*found))
    throw ChoiceError(option + config::in_quotes(name) + " in " + file +
                      (is_text(*found) ? " holds words" : " is an axis") +
                      "; numbers are in: " + config::joined(results));
  return *found;
}

/// The result, the axes of its points, the coordinates of its components, and what tells their motion.
void Extremes::collect_variables() {
  names_.push_back(result_->name);
  for (const results::NamedLength& dimension : places_)
    for (const std::string& name : coordinates_along(summary_, dimension)) axes_.push_back(name);
  for (const std::string_view name : telling) {
    const Entry* const entry = find_variable(summary_, name);
    if (entry != nullptr && entry->name != result_->name && std::ranges::equal(entry->dimensions, places_, are_same))
      words_.emplace_back(name);
  }
  for (const results::NamedLength& dimension : parts_)
    if (find_variable(summary_, dimension.name) != nullptr) names_.push_back(dimension.name);
  for (const std::vector<std::string>& more : {axes_, words_, filter_->variables()})
    for (const std::string& name : more)
      if (std::ranges::find(names_, name) == names_.end()) names_.push_back(name);
}

/// Throws IoError unless every variable has a value for each of its places: anyone may have made the file.
void Extremes::require_complete(const results::Dataset& dataset) const {
  for (const std::string& name : names_)
    if (size_of(variable_of(dataset, name)) != points_of(find_variable(summary_, name)->dimensions))
      storage::refuse_reading(path_, "is damaged: " + config::in_quotes(name) + " has another length",
                              "run its configuration again");
}

/// Which components count: the one that is named, else all.
std::vector<bool> Extremes::wanted_parts(const results::Dataset& dataset) const {
  const auto named = ComponentName(named_).component;
  std::vector<bool> wanted(points_of(parts_), !named);
  if (!named) return wanted;
  const std::string own = parts_.empty() ? "" : parts_.back().name;
  for (std::size_t part = 0; !own.empty() && parts_.size() == 1 && part < wanted.size(); ++part)
    wanted[part] = component_name(dataset, own, part) == *named;
  if (std::ranges::find(wanted, true) == wanted.end())
    throw ChoiceError((is_largest_ ? "--max: " : "--min: ") + config::in_quotes(named_) + " is no component of " +
                      config::in_quotes(result_->name) +
                      (parts_.size() != 1 || wanted.empty()
                           ? ", which has one value for each point"
                           : "; there are " + component_names(dataset, result_->name, parts_.back())));
  return wanted;
}

bool Extremes::counts(steady::Status status) const {
  if (choice_.periodic) return status == steady::Status::periodic || status == steady::Status::grazing;
  return !failed(status);
}

/// The best component of each point that has a value and hasn't failed, in the order of the file.
std::vector<Extremes::Candidate> Extremes::candidates(const results::Dataset& dataset) const {
  const results::Variable& variable = variable_of(dataset, result_->name);
  const std::vector<bool> wanted = wanted_parts(dataset);
  const std::vector<std::uint8_t>* const status = results::values_of<std::uint8_t>(dataset, "status");
  const std::vector<bool> is_chosen = filter_->chosen(dataset);
  filter_->require_some(is_chosen, dataset);
  std::vector<Candidate> found;
  for (std::size_t point = 0; point < points_of(places_); ++point) {
    const bool is_counted =
        is_chosen[point] && (status == nullptr || counts(static_cast<steady::Status>((*status)[point])));
    if (!is_counted) continue;
    Candidate best{point, wanted.size(), std::nan("")};
    for (std::size_t part = 0; part < wanted.size(); ++part) {
      const double value = number_at(variable.values, point * wanted.size() + part);
      const bool is_better = std::isnan(best.value) || (is_largest_ ? value > best.value : value < best.value);
      if (wanted[part] && !std::isnan(value) && is_better) best.part = part, best.value = value;
    }
    if (best.part < wanted.size()) found.push_back(best);
  }
  return found;
}

Extreme Extremes::described(const Candidate& candidate, const results::Dataset& dataset) const {
  Extreme extreme{candidate.value, {}, {}, {}};
  const std::vector<std::size_t> at = indexes_of(candidate.point, places_), part = indexes_of(candidate.part, parts_);
  for (const std::string& name : axes_) {
    const Entry& axis = *find_variable(summary_, name);
    const auto place = std::ranges::find(places_, axis.dimensions[0].name, &results::NamedLength::name);
    const std::size_t index = at[static_cast<std::size_t>(place - places_.begin())];
    extreme.axes.push_back({name, number_at(variable_of(dataset, name).values, index), axis.units});
  }
  for (std::size_t d = 0; d < parts_.size(); ++d) {
    const bool has_coordinate = find_variable(summary_, parts_[d].name) != nullptr;
    extreme.component.push_back({parts_[d].name,
                                 has_coordinate ? number_at(variable_of(dataset, parts_[d].name).values, part[d])
                                                : static_cast<double>(part[d]),
                                 "1"});
  }
  for (const std::string& name : words_)
    if (std::string word = word_at(variable_of(dataset, name), candidate.point); !word.empty())
      extreme.words.emplace_back(name, std::move(word));
  return extreme;
}

/// The best first; for each value of an axis the best one, in the order of the values.
std::vector<Extremes::Candidate> Extremes::best_of(std::vector<Candidate> found,
                                                   const results::Dataset& dataset) const {
  const auto is_better = [this](const Candidate& one, const Candidate& other) {
    if (one.value == other.value) return one.point < other.point;
    return is_largest_ ? one.value > other.value : one.value < other.value;
  };
  if (choice_.for_axis.empty()) {
    const std::size_t count = std::min(most_extremes, found.size());
    std::ranges::partial_sort(found, found.begin() + static_cast<std::ptrdiff_t>(count), is_better);
    found.resize(count);
    return found;
  }
  const results::NamedLength& own = find_variable(summary_, choice_.for_axis)->dimensions[0];
  const auto dimension =
      static_cast<std::size_t>(std::ranges::find(places_, own.name, &results::NamedLength::name) - places_.begin());
  const auto place = [&](std::size_t point) {
    if (!holds_branches(summary_)) return indexes_of(point, places_)[dimension];
    return static_cast<std::size_t>(number_at(variable_of(dataset, choice_.for_axis).values, point));
  };
  std::map<std::size_t, Candidate> best;
  for (const Candidate& candidate : found) {
    const auto [there, is_first] = best.try_emplace(place(candidate.point), candidate);
    if (!is_first && is_better(candidate, there->second)) there->second = candidate;
  }
  std::vector<Candidate> of_each;
  for (const auto& [at, one] : best) of_each.push_back(one);
  return of_each;
}

std::vector<Extreme> Extremes::of(const results::Dataset& dataset) const {
  require_complete(dataset);
  std::vector<Extreme> extremes;
  for (const Candidate& candidate : best_of(candidates(dataset), dataset))
    extremes.push_back(described(candidate, dataset));
  return extremes;
}

}  // namespace clatter::app
