#include "sweep/result_dataset.hpp"

#include <cstdint>
#include <string>
#include <type_traits>
#include <utility>
#include <variant>
#include <vector>

#include "sweep/attractor_table.hpp"
#include "sweep/dataset_axes.hpp"
#include "sweep/output_variables.hpp"
#include "sweep/share.hpp"

namespace clatter::sweep {
namespace {

using observables::LogColumn;

/// Makes the dataset of a run.
class Maker {
 public:
  Maker(const Sweep& sweep, const std::optional<results::Shard>& shard, const ResultValues& values)
      : sweep_(sweep),
        shard_(shard),
        values_(values),
        along_(shard ? std::vector<std::string>{"point"} : axis_names(sweep)) {}

  results::Dataset dataset(std::optional<attractors::Numbering> numbering) {
    add_coordinates();
    add_always();
    for (const OutputVariable& output : outputs_of(sweep_.problem))
      if (!output.intermediate || shard_) add(output);
    if (numbering) add_attractors(sweep_, shard_.has_value(), along_, std::move(*numbering), dataset_);
    if (sweep_.problem.observe.impact_log) add_impact_log();
    add_drawn_names(sweep_.problem.is_si, dataset_, has_loose_mass(sweep_), sweep_.problem.observe.loose_impacts);
    name_linked_axes(sweep_, dataset_);
    name_samples(sweep_, dataset_);
    return std::move(dataset_);
  }

 private:
  /// Adds a variable of results, whose values are of type T.
  template <class T>
  results::Variable& add(const std::string& name, std::vector<std::string> dimensions, std::string long_name,
                         std::string units = "1") {
    results::Variable variable{name, std::move(dimensions), std::vector<T>(), std::move(long_name), std::move(units)};
    variable.next = values_.of(name), variable.at_once = values_.at_once;
    return dataset_.variables.emplace_back(std::move(variable));
  }

  void add_coordinate(const std::string& name, results::ValueArray values, std::string long_name) {
    dataset_.variables.push_back({name, {name}, std::move(values), std::move(long_name), "1"});
  }

  void add_coordinates() {
    add_axes(sweep_, dataset_);
    if (shard_) {
      const Share share(sweep_, shard_);
      dataset_.dimensions.push_back({"point", share.points()});
      add_coordinate("point", std::vector<std::int64_t>(), "index of the point in the sweep, row-major over its axes");
      dataset_.variables.back().next = [share, at = std::size_t{0}](std::size_t count) mutable {
        std::vector<std::int64_t> numbers(count);
        for (std::int64_t& number : numbers) number = static_cast<std::int64_t>(share.point_at(at++));
        return numbers;
      };
    }
    for (observables::Coordinate& added : observables::All::coordinates(sweep_.problem.observe)) {
      dataset_.dimensions.push_back({added.name, added.length});
      const auto add = [&]<class T>(T& values) {
        if constexpr (!std::is_same_v<T, std::monostate>)
          add_coordinate(added.name, std::move(values), std::move(added.long_name));
      };
      std::visit(add, added.values);
    }
  }

  void add_always() {
    add<std::uint8_t>("status", along_, "what became of the point").attributes = status_flags();
    add<std::int64_t>("impact_total", along_, "impacts simulated");
    add<double>("simulated_periods", along_, "forcing periods simulated");
  }

  void add(const OutputVariable& output) {
    std::vector<std::string> dimensions = along_;
    for (const observables::Coordinate& along : output.along) dimensions.push_back(along.name);
    const bool is_si = sweep_.problem.is_si;
    const std::string& long_name = is_si && !output.name_in_si.empty() ? output.name_in_si : output.long_name;
    const Quantity quantity = output.intermediate ? Quantity::number : output.quantity;
    const std::string units = unit_of_derivative(quantity, output.per, is_si);
    results::Variable& variable = output.text ? add<std::string>(output.name, std::move(dimensions), long_name, units)
                                              : add<double>(output.name, std::move(dimensions), long_name, units);
    const bool is_on_ground = output.intermediate && sweep_.problem.observe.loose_attractor;  // as it is computed
    const bool is_framed = output.frame != observables::FrameOf::any;
    name_frame(sweep_, is_on_ground && is_framed ? observables::FrameOf::absolute : output.frame, variable);
    const std::size_t of_point = output.width() * sizeof(double);
    if (of_point <= variable.at_once) variable.at_once -= variable.at_once % of_point;  // whole points
    if (!output.observable.empty()) name_observable(output.observable, variable);
    variable.missing_if = output.missing_if.empty() ? "the point failed" : "the point failed, or ";
    variable.missing_if += output.missing_if;
  }

  void add_impact_log() {
    dataset_.dimensions.push_back({"impact", values_.logged});
    results::Variable& count = add<std::int64_t>("impact_count", along_, "impacts in the log of the point");
    count.attributes = {{"sample_dimension", "impact"}};
    name_observable("impact_log", count);
    for (const LogColumn& column : observables::log_columns(is_shaken(sweep_))) {
      results::Variable& variable = add<double>(std::string(column.name), {"impact"}, std::string(column.long_name),
                                                std::string(unit_of(column.quantity, sweep_.problem.is_si)));
      name_frame(sweep_, column.frame, variable);
      variable.missing_if = column.missing_if;
      if (column.name == "impact_tau")
        add<std::int8_t>(
            "impact_stop", {"impact"},
            sweep_.problem.observe.wall_log
                ? "stop or wall that is hit, -1: lower stop, +1: upper stop, -2: lower wall, +2: upper wall"
                : "stop that is hit, -1: lower, +1: upper");
    }
  }

  const Sweep& sweep_;
  std::optional<results::Shard> shard_;
  const ResultValues& values_;
  std::vector<std::string> along_;  ///< dimensions of a variable with one value a point
  results::Dataset dataset_;
};

}  // namespace

results::Dataset result_dataset(const Sweep& sweep, const std::optional<results::Shard>& shard,
                                const ResultValues& values, std::optional<attractors::Numbering> numbering) {
  return Maker(sweep, shard, values).dataset(std::move(numbering));
}

results::Dataset description(const Sweep& sweep) {
  std::optional<attractors::Numbering> numbering;
  if (sweep.problem.observe.attractor)
    numbering = {.number = std::vector<std::int32_t>(size(sweep), attractors::undecided), .motions = {{}}};
  return result_dataset(sweep, {}, {[](std::string_view) { return results::NextValues(); }}, std::move(numbering));
}

}  // namespace clatter::sweep
