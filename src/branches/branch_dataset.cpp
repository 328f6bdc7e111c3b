#include "branches/branch_dataset.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "branches/measures/measures.hpp"
#include "sweep/dataset_axes.hpp"
#include "sweep/output_variables.hpp"

namespace clatter::branches {
namespace {

constexpr double no_value = std::numeric_limits<double>::quiet_NaN();

std::vector<std::int32_t> numbers_of(const std::vector<std::size_t>& branches, std::size_t width) {
  std::vector<std::int32_t> numbers(width, -1);
  for (std::size_t i = 0; i < branches.size(); ++i) numbers[i] = static_cast<std::int32_t>(branches[i]);
  return numbers;
}

/// Variables over one dimension, column by column.
class Columns {
 public:
  Columns(results::Dataset& dataset, const Units& units, bool in_housing, std::string dimension, std::size_t length,
          std::string prefix)
      : dataset_(dataset),
        units_(units),
        in_housing_(in_housing),
        dimension_(std::move(dimension)),
        prefix_(std::move(prefix)) {
    dataset_.dimensions.push_back({dimension_, length});
  }

  template <class Values>
  void add(const std::string& name, Values values, const std::string& long_name,
           const std::vector<std::string>& more = {}) {
    std::vector<std::string> over{dimension_};
    over.insert(over.end(), more.begin(), more.end());
    dataset_.variables.push_back({prefix_ + name, over, std::move(values), long_name, "1"});
  }

  /// The variables that describe each motion.
  void add_motions(const std::vector<BranchPoint>& points, const BranchSettings& settings, const WordLetters& letters) {
    std::vector<double> value, second, x, v, period, symmetric, re, im;
    std::vector<std::uint8_t> stable;
    std::vector<std::string> word, regime;
    std::vector<double> low, high, v_low, v_high, speed, power;
    std::vector<double> z, w, y_low, y_high, z_low, z_high, wall_speed;  // of a loose mass
    for (const BranchPoint& point : points) {
      const attractors::SectionState state = state_at_phase_zero(point.scene, point.orbit);
      const observables::Extrema::Values range = extrema(point.scene, point.orbit);
      const Stops rigid = rigid_ones(point.scene.stops);
      value.push_back(value_of(point.scene, settings.along));
      if (settings.across) second.push_back(value_of(point.scene, *settings.across));
      x.push_back(state.x), v.push_back(state.v);
      period.push_back(point.orbit.period_ratio()), word.push_back(point.orbit.word(letters));
      regime.push_back(point.orbit.regime(letters));
      symmetric.push_back(is_symmetric(point.scene) ? point.orbit.mirrored : no_value);
      stable.push_back(point.stable);
      const auto numbers = static_cast<std::ptrdiff_t>(multipliers_in(point.scene));
      re.insert(re.end(), point.multiplier_re.begin(), point.multiplier_re.begin() + numbers);
      im.insert(im.end(), point.multiplier_im.begin(), point.multiplier_im.begin() + numbers);
      z.push_back(state.z), w.push_back(state.w);
      wall_speed.push_back(wall_impact_speed(point.orbit));
      y_low.push_back(range.y_min), y_high.push_back(range.y_max);
      z_low.push_back(range.z_min), z_high.push_back(range.z_max);
      low.push_back(std::max(range.x_min, rigid.lower)), high.push_back(std::min(range.x_max, rigid.upper));
      v_low.push_back(range.v_min), v_high.push_back(range.v_max);
      speed.push_back(impact_speed(point.orbit, letters)), power.push_back(impact_power(point.scene, point.orbit));
    }
    add_parameter(settings.along, std::move(value), "parameter along which the motion is followed");
    if (settings.across) add_parameter(*settings.across, std::move(second), "second parameter of the curve");
    add("x", Quantity::length, std::move(x), "displacement at forcing phase 0");
    add("v", Quantity::velocity, std::move(v), "velocity at forcing phase 0");
    add("period_ratio", std::move(period), "period of the motion over the forcing period");
    add("word", std::move(word),
        std::string("impacts of one period in order, L and U") + (letters.sticks ? "; S: stick" : "") +
            (in_housing_ && letters.walls ? "; l, u: walls of the loose mass" : ""));
    dataset_.variables.back().missing_if = "no stop is hit";
    add("regime", std::move(regime), "impacts on one stop over forcing periods");
    add("symmetric", std::move(symmetric), "1: the motion is its own mirror image; NaN: the scene isn't symmetric");
    dataset_.variables.back().missing_if = "the scene isn't symmetric";
    add("stable", std::move(stable), "1: all multipliers lie within the unit circle");
    add("multiplier_re", std::move(re), "real parts of the multipliers of one period", {"multiplier"});
    add("multiplier_im", std::move(im), "imaginary parts of the multipliers of one period", {"multiplier"});
    add("x_min", Quantity::length, std::move(low), "minimum displacement");
    add("x_max", Quantity::length, std::move(high), "maximum displacement");
    add("v_min", Quantity::velocity, std::move(v_low), "minimum velocity");
    add("v_max", Quantity::velocity, std::move(v_high), "maximum velocity");
    if (in_housing_) {
      add("z", Quantity::length, std::move(z), "place of the loose mass in the housing at forcing phase 0");
      add("w", Quantity::velocity, std::move(w), "velocity of the loose mass over the housing at forcing phase 0");
      add("y_min", Quantity::length, std::move(y_low), "minimum displacement of the loose mass");
      add("y_max", Quantity::length, std::move(y_high), "maximum displacement of the loose mass");
      add("z_min", Quantity::length, std::move(z_low), "minimum place of the loose mass in the housing");
      add("z_max", Quantity::length, std::move(z_high), "maximum place of the loose mass in the housing");
    }
    add("impact_speed", Quantity::velocity, std::move(speed), "speed of the fastest impact");
    if (in_housing_ && letters.walls)
      add("wall_impact_speed", Quantity::velocity, std::move(wall_speed),
          "speed of the fastest impact of the loose mass");
    add("impact_power", Quantity::power, std::move(power),
        units_.is_si ? "energy lost in impacts per second" : "energy lost in impacts per tau, per unit mass");
  }

 private:
  /// Numbers of the computed scene.
  void add(const std::string& name, Quantity quantity, std::vector<double> values, const std::string& long_name) {
    if (const double factor = factor_of(units_, quantity); factor != 1)
      for (double& value : values) value *= factor;
    add(name, std::move(values), long_name);
    dataset_.variables.back().units = unit_of(quantity, units_.is_si);
  }
  /// Numbers of the user.
  void add_parameter(Parameter parameter, std::vector<double> values, const std::string& long_name) {
    add(std::string(parameter.key()), std::move(values), long_name);
    dataset_.variables.back().units = unit_of(parameter.row().quantity, units_.is_si);
  }

  results::Dataset& dataset_;
  const Units& units_;
  bool in_housing_;
  std::string dimension_, prefix_;
};

/// Names the key of [observe] that asks a run for a variable of the same name.
void name_observables(results::Dataset& dataset) {
  point::RunSettings settings;
  observables::Observe& observe = settings.observe;
  observe.extrema = observe.impacts = observe.word = observe.period = observe.stability = observe.energy = true;
  observe.loose_extrema = true;
  for (const sweep::OutputVariable& output : sweep::outputs_of(settings))
    for (results::Variable& variable : dataset.variables)
      if (variable.name == output.name && !output.observable.empty())
        sweep::name_observable(output.observable, variable);
}

}  // namespace

std::string births_text(const OfBirths<std::size_t>& births) {
  std::string text;
  for (std::size_t kind = 0; kind < births.size(); ++kind)
    text += (text.empty() ? "" : ", ") + std::to_string(births[kind]) + ' ' + std::string(birth_names[kind]);
  return text;
}

results::Dataset branch_dataset(const Branches& branches, const BranchSettings& settings, const Units& units,
                                bool in_housing) {
  results::Dataset dataset;
  std::vector<std::int32_t> branch;
  std::vector<double> arclength;
  for (const BranchPoint& point : branches.points) {
    branch.push_back(static_cast<std::int32_t>(point.branch));
    arclength.push_back(point.arclength);
  }
  Columns points(dataset, units, in_housing, "point", branches.points.size(), "");
  dataset.dimensions.push_back({"multiplier", in_housing ? 4U : 2U});
  points.add("branch", std::move(branch), settings.across ? "number of the curve" : "number of the branch");
  points.add("arclength", std::move(arclength), "along the branch or curve, over the width of its range");
  points.add_motions(branches.points, settings, branches.letters);

  if (settings.births) dataset.attributes.emplace_back("births_left_out", births_text(branches.left_out));
  std::size_t most = 1;
  std::vector<std::string> kind;
  std::vector<BranchPoint> at;
  std::vector<std::int32_t> meeting;
  std::vector<std::uint8_t> left_out;
  for (const SpecialPoint& special : branches.special) most = std::max(most, special.branches.size());
  for (const SpecialPoint& special : branches.special) {
    kind.emplace_back(name_of(special.kind)), at.push_back(special.at);
    const std::vector<std::int32_t> numbers = numbers_of(special.branches, most);
    meeting.insert(meeting.end(), numbers.begin(), numbers.end());
    left_out.push_back(special.left_out);
  }
  Columns specials(dataset, units, in_housing, "special", at.size(), "special_");
  dataset.dimensions.push_back({"meeting", most});
  specials.add("kind", std::move(kind), "kind of the special point");
  specials.add("branch", std::move(meeting), "numbers of the branches, or the curves, that meet there; -1: no more",
               {"meeting"});
  if (settings.births) specials.add("left_out", std::move(left_out), "1: a birth there isn't followed");
  specials.add_motions(at, settings, branches.letters);
  sweep::add_drawn_names(units.is_si, dataset, in_housing, in_housing);
  name_observables(dataset);
  return dataset;
}

}  // namespace clatter::branches
