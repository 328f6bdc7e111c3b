#include "runs/point_of_output.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <set>
#include <string_view>

#include "branches/start/start.hpp"
#include "config/suggestion.hpp"
#include "config/value_grammar.hpp"
#include "outputs/output_summary.hpp"
#include "point/point.hpp"
#include "results/origin.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "sweep/chains.hpp"
#include "tables/csv_table.hpp"
#include "terminal/command_line.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

using Conditions = std::vector<Condition>;

[[noreturn]] void refuse_damaged(const std::string& path) {
  storage::refuse_reading(path, "is damaged: its points aren't those of its configuration",
                          "run its configuration again");
}

template <class Value>
const std::vector<Value>& values_in(const results::Dataset& dataset, const std::string& name, std::size_t count,
                                    const std::string& path) {
  const auto* const values = results::values_of<Value>(dataset, name);
  if (values == nullptr || values->size() != count) refuse_damaged(path);
  return *values;
}

/// "--where R=0.5 (11 values, 0.5 ... 0.7)" for each axis, of those that don't run together, along which points differ.
std::string choices_among(const std::vector<std::size_t>& points, const sweep::Sweep& sweep) {
  std::vector<std::pair<std::string, std::set<double>>> left;
  for (const sweep::Dimension& dimension : sweep.dimensions) left.emplace_back(name_of(dimension), std::set<double>{});
  if (sweep.direction == sweep::Direction::both) left.emplace_back("direction", std::set<double>{});
  for (const std::size_t point : points) {
    each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
      const auto own = std::ranges::find(left, axis.parameter.key(), [](const auto& one) { return one.first; });
      if (own != left.end()) own->second.insert(value);
    });
    if (sweep.direction == sweep::Direction::both) left.back().second.insert(point < size_one_way(sweep) ? 1 : -1);
  }
  std::string text;
  for (const auto& [name, values] : left)
    if (values.size() > 1)
      text += (text.empty() ? "--where " : " and --where ") + name + '=' + config::number_text(*values.begin()) + " (" +
              std::to_string(values.size()) + " values, " + config::number_text(*values.begin()) + " ... " +
              config::number_text(*values.rbegin()) + ')';
  return text;
}

/// The problem of a point as a run starts it: along `follow` after those before it.
point::Problem started_problem(const sweep::Sweep& sweep, std::size_t point) {
  const sweep::Chains chains(sweep);
  std::size_t chain = 0, position = 0;
  while (chains.point(chain, position) != point)
    if (++position == chains.length) position = 0, ++chain;
  std::optional<point::End> end;
  Units units_of_end{};
  point::ThreadScratch scratch;
  for (std::size_t i = 0;; ++i) {
    point::Problem problem = problem_at(sweep, chains.point(chain, i));
    if (sweep.follow) sweep::start_from(problem, end, units_of_end);
    if (i == position) return problem;
    const point::PointResult result = run_point(problem, scratch);
    end = failed(result.status) ? std::nullopt : std::optional(sweep::end_for_next(problem, result.end));
    units_of_end = problem.units;
  }
}

/// The status of a point whose motion has no period, or which failed; empty: it may have one.
std::string_view fault_of(std::uint8_t status) {
  for (const auto& [known, name, meaning] : steady::status_names)
    if (static_cast<std::uint8_t>(known) == status && (lacks_period(known) || failed(known))) return name;
  return {};
}

PointOfOutput point_of_sweep(const std::string& path, const Conditions& where) {
  const results::FileSummary summary = outputs::read_summary(path);
  const CsvTable table(summary, path, {.only = {"status"}, .where = where});
  const sweep::Sweep sweep = outputs::config_of_output(summary, path).sweep;
  const results::Dataset dataset = results::read_variables(path, table.variables());
  const auto& status = values_in<std::uint8_t>(dataset, "status", size(sweep), path);
  const std::vector<std::size_t> points = table.points(dataset);
  if (points.size() > 1)
    throw UsageError(storage::quoted_name(path) + " has " + std::to_string(points.size()) +
                     " such points; choose one, e.g. by " + choices_among(points, sweep));
  const std::size_t point = points[0];
  PointOfOutput out{coordinates_text(sweep, point), sweep.problem, {}, 1};
  each_coordinate(sweep, point, [&](const sweep::Axis& axis, double value) {
    set(out.scene, axis.parameter, value), out.varied.push_back(axis.parameter);
  });
  const std::string place = storage::quoted_name(path) + (out.name.empty() ? "" : " at " + out.name);
  if (const std::string_view fault = fault_of(status[point]); !fault.empty())
    throw UsageError(place + " is " + std::string(fault) +
                     ", and a branch starts from periodic motion; choose "
                     "another point");
  try {
    const point::Problem problem = started_problem(sweep, point);
    const branches::MotionStart motion = branches::settled(problem);
    Start start{motion.state.x, motion.state.v, motion.phase};
    sweep::add_base(start, problem, -1);
    out.scene.start = {start.displacement * factor_of(problem.units, Quantity::length),
                       start.velocity * factor_of(problem.units, Quantity::velocity), start.phase};
    if (has_loose_mass(problem.loose))
      out.scene.loose.place = motion.state.z * factor_of(problem.units, Quantity::length),
      out.scene.loose.velocity = motion.state.w * factor_of(problem.units, Quantity::velocity);
    out.periods = motion.periods;
  } catch (const branches::StartError& error) {
    throw UsageError(place + ": " + error.what());
  }
  return out;
}

/// The points of branches, or of curves in two parameters, with what --where may choose them by.
class BranchPoints {
 public:
  BranchPoints(const std::string& path, const results::FileSummary& summary, const config::Config& config)
      : path_(path), summary_(summary), scene_(config.sweep.problem) {
    if (!config.branch) refuse_damaged(path);
    varied_ = {config.branch->along};
    if (config.branch->across) varied_.push_back(*config.branch->across);
    std::vector<std::string> names{"branch", "x", "v", "period_ratio"};
    if (has_loose_mass(scene_.loose)) names.insert(names.end(), {"z", "w"});
    for (const Parameter parameter : varied_) names.emplace_back(parameter.key());
    dataset_ = results::read_variables(path, names);
    const auto* const branch = results::values_of<std::int32_t>(dataset_, "branch");
    if (branch == nullptr || branch->empty()) refuse_damaged(path);
    count_ = branch->size();
  }

  [[nodiscard]] PointOfOutput chosen(const Conditions& where) const {
    std::vector<std::size_t> points;
    std::vector<double> values;
    for (const Condition& condition : where) values.push_back(value_of(condition));
    for (std::size_t i = 0; i < count_; ++i) {
      bool is_there = true;
      for (std::size_t p = 0; p < where.size(); ++p) is_there = is_there && is_at(i, where[p].name, values[p]);
      if (is_there) points.push_back(i);
    }
    if (points.size() > 1)
      throw UsageError(storage::quoted_name(path_) + " has " + std::to_string(points.size()) +
                       " such points; choose one by --where point=N: " + listed(points));
    if (points.empty()) throw UsageError(storage::quoted_name(path_) + " has no such point; " + offered());
    return at(points[0]);
  }

 private:
  [[nodiscard]] const std::vector<double>& numbers(std::string_view name) const {
    return values_in<double>(dataset_, std::string(name), count_, path_);
  }
  [[nodiscard]] std::int32_t branch(std::size_t i) const {
    return values_in<std::int32_t>(dataset_, "branch", count_, path_)[i];
  }

  /// Of --where, in the unit of the file.
  [[nodiscard]] double value_of(const Condition& condition) const {
    if (condition.comparison != Comparison::equal || !condition.value)
      throw UsageError("--where " + text_of(condition) + ": a start is one point; " + offered());
    const auto* const entry = find_variable(summary_, condition.name);
    return entry != nullptr ? number_of(condition, *entry, path_) : condition.value->value;
  }
  [[nodiscard]] bool is_at(std::size_t i, const std::string& name, double value) const {
    if (name == "point") return value == static_cast<double>(i);
    if (name == "branch") return value == branch(i);
    const auto parameter = std::ranges::find(varied_, name, &Parameter::key);
    if (parameter == varied_.end())
      throw UsageError("--where " + name + '=' + config::number_text(value) + ": " + storage::quoted_name(path_) +
                       " holds branches; " + offered());
    return is_nearest(i, numbers(name), value);
  }
  /// Whether point i is that end of a step of its branch across a value which is nearer to it.
  [[nodiscard]] bool is_nearest(std::size_t i, const std::vector<double>& along, double value) const {
    const double here = along[i] - value;
    if (here == 0) return true;
    const auto nearer_than = [&](std::size_t other, bool is_next) {
      if (branch(other) != branch(i)) return false;
      const double there = along[other] - value;
      if ((there < 0) == (here < 0) || there == 0) return false;
      return std::abs(here) < std::abs(there) || (is_next && std::abs(here) == std::abs(there));
    };
    return (i > 0 && nearer_than(i - 1, false)) || (i + 1 < count_ && nearer_than(i + 1, true));
  }

  /// "nu = 0.85 ... 1.5, branch = 0 ... 3, point = 0 ... 190"
  [[nodiscard]] std::string offered() const {
    std::string text = "expected ";
    for (const Parameter parameter : varied_) {
      const auto [low, high] = std::ranges::minmax(numbers(parameter.key()));
      text +=
          std::string(parameter.key()) + " = " + config::number_text(low) + " ... " + config::number_text(high) + ", ";
    }
    return text + "branch = 0 ... " + std::to_string(branch(count_ - 1)) + " or point = 0 ... " +
           std::to_string(count_ - 1);
  }
  /// "57 (branch 2, nu = 1.198), 93 (branch 4, nu = 1.2)", at most six.
  [[nodiscard]] std::string listed(const std::vector<std::size_t>& points) const {
    constexpr std::size_t most = 6;
    std::string text;
    for (std::size_t i = 0; i < std::min(points.size(), most); ++i)
      text += (i == 0 ? "" : ", ") + std::to_string(points[i]) + " (" + place(points[i]) + ')';
    return points.size() > most ? text + ", ..." : text;
  }
  /// "branch 2, nu = 1.198"
  [[nodiscard]] std::string place(std::size_t i) const {
    std::string text = "branch " + std::to_string(branch(i));
    for (const Parameter parameter : varied_)
      text += ", " + std::string(parameter.key()) + " = " + formatted("%.9g", numbers(parameter.key())[i]);
    return text;
  }

  [[nodiscard]] PointOfOutput at(std::size_t i) const {
    PointOfOutput out{"point " + std::to_string(i) + ", " + place(i), scene_, varied_, 1};
    for (const Parameter parameter : varied_) set(out.scene, parameter, numbers(parameter.key())[i]);
    out.scene.start = {numbers("x")[i], numbers("v")[i], 0.0};
    if (has_loose_mass(scene_.loose))
      out.scene.loose.place = numbers("z")[i], out.scene.loose.velocity = numbers("w")[i];
    const double periods = numbers("period_ratio")[i];
    if (!(periods >= 1 && periods < 1e9)) refuse_damaged(path_);
    out.periods = static_cast<std::int64_t>(periods);
    return out;
  }

  std::string path_;
  const results::FileSummary& summary_;
  GivenScene scene_;
  std::vector<Parameter> varied_;
  results::Dataset dataset_;
  std::size_t count_ = 0;
};

}  // namespace

PointOfOutput point_of_output(const std::string& path, const Conditions& where) try {
  const auto origin = results::origin_of(path);
  if (origin && origin->command == "accuracy")
    storage::refuse_reading(path, "holds what accuracy costs, not motions",
                            "name an output of `clatter run` or `clatter branch`");
  if (!origin || origin->command != "branch") return point_of_sweep(path, where);
  const results::FileSummary summary = outputs::read_summary(path);
  return BranchPoints(path, summary, outputs::config_of_output(summary, path)).chosen(where);
} catch (const ChoiceError& error) {
  throw UsageError(error.what());
}

}  // namespace clatter::app
