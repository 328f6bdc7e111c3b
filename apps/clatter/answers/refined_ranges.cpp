#include "answers/refined_ranges.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <tuple>
#include <type_traits>
#include <utility>
#include <variant>

#include "answers/per_period.hpp"
#include "lanes/instruction_set.hpp"
#include "outputs/output_summary.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "sweep/run.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {
namespace {

/// What the file of a dataset would say of its variables.
results::FileSummary summary_of(const results::Dataset& dataset) {
  results::FileSummary summary;
  for (const results::Variable& variable : dataset.variables) {
    const bool is_text = std::holds_alternative<std::vector<std::string>>(variable.values),
               is_number = std::holds_alternative<std::vector<double>>(variable.values);
    results::FileSummary::Entry entry{
        variable.name, is_text ? "string" : (is_number ? "float64" : "int64"), variable.units, variable.long_name, {}};
    for (const std::string& name : variable.dimensions)
      entry.dimensions.push_back(*std::ranges::find(dataset.dimensions, name, &results::NamedLength::name));
    summary.variables.push_back(std::move(entry));
  }
  return summary;
}

/// The words of scenes between the points of a sweep.
class Between {
 public:
  Between(const Ranges& ranges, const results::FileSummary& summary, const std::string& path)
      : path_(path), sweep_(outputs::config_of_output(summary, path).sweep), choice_(ranges.choice()) {
    for (const auto& [name, value] : summary.attributes)
      if (name == sweep::instruction_set_attribute)
        if (const auto arch = lanes::instruction_set_of_bits(value)) arch_ = *arch;
    std::erase_if(choice_.where, [&](const Condition& condition) { return is_axis(condition.name); });
    choice_.along.clear();
  }

  /// The values of all axes on the way from one point to another.
  [[nodiscard]] std::vector<std::pair<Parameter, double>> at(std::size_t from, std::size_t to, double way) const {
    std::vector<std::pair<Parameter, double>> values;
    std::vector<double> ends;
    each_coordinate(sweep_, to, [&](const sweep::Axis&, double value) { ends.push_back(value); });
    each_coordinate(sweep_, from, [&](const sweep::Axis& axis, double value) {
      const double end = ends[values.size()];
      values.emplace_back(axis.parameter, value == end ? value : value + way * (end - value));
    });
    return values;
  }

  /// The word of the scene there; the same from both ends, so that a place is computed once.
  [[nodiscard]] const std::string& word(std::size_t from, std::size_t to, double way) {
    const bool in_order = from < to;
    const auto key = std::tuple(std::min(from, to), std::max(from, to), in_order ? way : 1 - way);
    const auto found = known_.find(key);
    return found != known_.end() ? found->second : known_[key] = computed(at(from, to, way));
  }

  /// The words that were found between two points, without those of the points.
  [[nodiscard]] std::string others(std::size_t from, std::size_t to, const std::string& one,
                                   const std::string& other) const {
    std::vector<std::string> words;
    for (const auto& [key, word] : known_) {
      const bool is_between = std::get<0>(key) == from && std::get<1>(key) == to && word != one && word != other;
      if (is_between && std::ranges::find(words, word) == words.end()) words.push_back(word);
    }
    constexpr std::size_t most = 3;
    std::string text;
    for (std::size_t i = 0; i < std::min(most, words.size()); ++i)
      text += (i == 0 ? "" : ", ") + storage::excerpt(words[i], 40);
    return words.size() > most ? text + ", ..." : text;
  }

 private:
  [[nodiscard]] bool is_axis(const std::string& name) const {
    for (const sweep::Dimension& dimension : sweep_.dimensions)
      for (const sweep::Axis& axis : dimension)
        if (axis.parameter.key() == name) return true;
    return name == "direction";
  }

  [[nodiscard]] std::string computed(const std::vector<std::pair<Parameter, double>>& values) const {
    sweep::Sweep one{.problem = sweep_.problem};
    for (const auto& [parameter, value] : values) set(one.problem, parameter, value);
    const results::Dataset dataset = sweep::run(one, {.threads = 1, .arch = arch_}).dataset;
    const results::FileSummary summary = summary_of(dataset);
    return Ranges(summary, path_, choice_).words(dataset).at(0);
  }

  std::string path_;
  sweep::Sweep sweep_;
  RangeChoice choice_;
  lanes::InstructionSet arch_ = lanes::widest_instruction_set();
  std::map<std::tuple<std::size_t, std::size_t, double>, std::string> known_{};
};

/// Moves an end from a point inside towards one outside as far as the word stays.
void move_end(std::vector<Whereabouts>& end, const std::string& word, std::size_t inside, std::size_t outside,
              double least_way, Between& between) {
  if (between.word(inside, outside, 0) != word || between.word(inside, outside, 1) == word) return;
  double in = 0, out = 1;
  while (out - in > least_way) {
    const double middle = in + (out - in) / 2;
    (between.word(inside, outside, middle) == word ? in : out) = middle;
  }
  for (Whereabouts& axis : end)
    for (const auto& [parameter, value] : between.at(inside, outside, in))
      if (parameter.key() == axis.name) axis.value = value;
}

double value_on(const std::vector<Whereabouts>& place, const std::string& axis) {
  const auto found = std::ranges::find(place, axis, &Whereabouts::name);
  return found == place.end() ? 0.0 : found->value;
}

void require_points_of_their_own(const Ranges& ranges, const results::FileSummary& summary, const std::string& path) {
  if (holds_branches(summary))
    throw ChoiceError(
        "--refine: the special points of branches are where a word changes; leave it out, and see "
        "`clatter export --special`");
  if (outputs::config_of_output(summary, path).sweep.follow)
    throw ChoiceError(
        "--refine: along `follow` a motion depends on the points before, so none runs alone between two; "
        "leave it out, or follow the motion by `clatter branch`");
  const Compared compared(summary, path);
  for (const Condition& condition : ranges.choice().where)
    if (!compared.per(condition.name).empty())
      throw ChoiceError("--refine: '" + condition.name +
                        "' is per forcing period here, and not of a point between two; leave it out, or name a power");
  const auto* const result = ranges.result();
  if (result != nullptr && (result->name == "attractor" || result->name == "motion_count"))
    throw ChoiceError("--refine: numbers of motions depend on all points; leave it out, or name e.g. word");
  if (points_of(dimensions_of_points(summary, path)) != size(outputs::config_of_output(summary, path).sweep))
    storage::refuse_reading(path, "is damaged: its points aren't those of its configuration",
                            "run its configuration again");
  if (ranges.is_sample()) throw ChoiceError("--refine: a sample has no ends to move; leave it out");
}

}  // namespace

void refine(std::vector<RangeLine>& lines, const Ranges& ranges, const results::FileSummary& summary,
            const std::string& path) {
  require_points_of_their_own(ranges, summary, path);
  Between between(ranges, summary, path);
  const results::FileSummary::Entry* const axis = find_variable(summary, ranges.along());
  if (axis == nullptr)
    throw ChoiceError("--refine: " + storage::quoted_name(path) +
                      " has no axis along which ends could move; leave it out");
  const std::vector<double> values = numbers_in(results::read_variables(path, {axis->name}).variables.at(0).values);
  const double least = same_on_axis(values, 0.0);
  const auto own = [&](std::size_t point) {
    double found = 0;
    for (const auto& [parameter, value] : between.at(point, point, 0))
      if (parameter.key() == axis->name) found = value;
    return found;
  };
  for (RangeLine& line : lines)
    for (Range& range : line.ranges) {
      const auto move = [&](std::vector<Whereabouts>& end, std::size_t inside,
                            const std::optional<std::size_t>& outside) {
        if (!outside) return;
        const double distance = std::abs(own(*outside) - own(inside));
        move_end(end, range.word, inside, *outside, std::max(least / distance, 1e-15), between);
      };
      move(range.from, range.first, range.before), move(range.to, range.last, range.after);
    }
  if (ranges.result() == nullptr) return;  // points between its ranges are known not to meet the conditions
  for (RangeLine& line : lines)
    for (std::size_t i = 0; i + 1 < line.ranges.size(); ++i) {
      const Range &range = line.ranges[i], &next = line.ranges[i + 1];
      if (range.after != next.first) continue;
      const double apart = std::abs(value_on(next.from, axis->name) - value_on(range.to, axis->name));
      constexpr double in_both_ends = 3;  // each is that of a word to within `least`
      if (apart <= in_both_ends * least) continue;
      const std::string words =
          between.others(std::min(range.last, next.first), std::max(range.last, next.first), range.word, next.word);
      line.gaps.push_back({i, range.to, next.from,
                           words.empty() ? "not refined: run alone, these points differ from those of the file"
                                         : "between two points of the file other words hold: " + words});
    }
}

}  // namespace clatter::app
