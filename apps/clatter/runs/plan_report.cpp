#include "runs/plan_report.hpp"

#include <algorithm>
#include <cmath>
#include <string_view>

#include "terminal/format.hpp"

namespace clatter::app {
namespace {

/// A line of a two-column text; an empty title continues the previous line.
std::string line(std::string_view title, const std::string& text) {
  std::string left(title);
  left.resize(20, ' ');
  return left + text + '\n';
}

std::string range(const plan::Bounds& estimate, const char* format) {
  const std::string least = formatted(format, estimate.least), most = formatted(format, estimate.most);
  return least == most ? least : least + " ... " + most;
}

std::string axis_text(const sweep::Axis& axis, bool is_si) {
  const std::string_view unit = unit_of(axis.parameter.row().quantity, is_si);
  return std::string(axis.parameter.key()) + " (" + std::to_string(axis.values.size()) + " from " +
         formatted("%.10g", axis.values.front()) + " to " + formatted("%.10g", axis.values.back()) +
         (is_si && unit != "1" ? ' ' + std::string(unit) : "") + ')';
}

std::string_view way_text(const sweep::Sweep& sweep) {
  if (sweep.direction == sweep::Direction::up) return "";
  return sweep.direction == sweep::Direction::down ? " downward" : " up and back down";
}

std::string axes_text(const sweep::Sweep& sweep) {
  std::string text;
  for (const sweep::Dimension& dimension : sweep.dimensions) {
    text += text.empty() ? "" : " x ";
    for (std::size_t i = 0; i < dimension.size(); ++i)
      text += (i > 0 ? " with " : "") + axis_text(dimension[i], sweep.problem.is_si);
  }
  if (sweep.follow)
    text += ", following " + std::string(name_of(sweep.dimensions[*sweep.follow])).append(way_text(sweep));
  return text.empty() ? "none" : text;
}

std::string joined(const std::vector<std::string>& names) {
  std::string text;
  for (const std::string& name : names) text += (text.empty() ? "" : ", ") + name;
  return text.empty() ? "nothing" : text;
}

/// "saves 11 %" of the time, or a range.
std::string saving_text(const plan::Bounds& saving) {
  if (saving.most == 0) return {};
  const std::string most = formatted("%.0f", 100 * saving.most) + " %";
  return "; saves " + (saving.least == saving.most ? most : formatted("%.0f", 100 * saving.least) + " ... " + most);
}

/// The scene that a point of a group is computed as, unless it is the user's.
std::string scene_text(const plan::Group& group, const sweep::Sweep& sweep) {
  const point::Problem problem = problem_at(sweep, group.example);
  const std::vector<KeyAndNumber> scene = computed_scene(problem);
  if (scene.empty()) return {};
  constexpr std::size_t in_row = 6;
  std::vector<std::string> row;
  std::string text;
  for (const auto& [key, number] : scene) {
    row.push_back(std::string(key) + " = " + formatted("%.10g", number));
    if (row.size() < in_row && key != scene.back().first) continue;
    text += line(text.empty() ? "  computed as" : "", joined(row));
    row.clear();
  }
  const Units& units = problem.units;
  return text + line("", (units.is_si ? "lengths in m, times in " : "times in ") + formatted("%.10g", units.time) +
                             (units.is_si ? " s" : "") + "; point " + std::to_string(group.example));
}

std::string group_text(const plan::Group& group, const sweep::Sweep& sweep) {
  std::string text = '\n' + line(counted(static_cast<double>(group.points), "point"),
                                 "effects: " + plan::effect_set_name(group.effects));
  text += scene_text(group, sweep);
  for (const plan::Reason& reason : group.reasons)
    text += line("  " + reason.effect, (reason.required ? "yes  " : "no   ") + reason.why + saving_text(reason.saving));
  return text + line("  work",
                     range(group.periods, "%.4g") + " periods, " + range(group.seconds, "%.2g") + " s on one thread");
}

std::string points_text(const plan::Plan& plan, const sweep::Sweep& sweep) {
  std::string text =
      line("points", std::to_string(plan.points) +
                         (plan.shard ? " of " + std::to_string(size(sweep)) + ", shard " + text_of(*plan.shard) : ""));
  if (plan.sampled_points)
    text += line("", "examined " + std::to_string(*plan.sampled_points) + " of " + std::to_string(plan.points) +
                         " points; counts are estimates");
  if (plan.mirror_images > 0)
    text += line("", std::to_string(plan.mirror_images) +
                         " are mirror images of others, (-x0, -v0) half a period later, and follow from them");
  return text;
}

}  // namespace

std::string method_of(const sweep::Sweep& sweep) {
  return std::string(stepping::method_names[static_cast<std::size_t>(sweep.problem.integration.method)]);
}

plan::Bounds seconds_of(const plan::Plan& plan, int threads) {
  plan::Bounds sum;
  for (const plan::Group& group : plan.groups) sum += group.seconds;
  const double together = std::clamp(static_cast<double>(plan.chains), 1.0, static_cast<double>(threads));
  return {sum.least / together, sum.most / together};
}

std::vector<KeyAndNumber> computed_scene(const point::Problem& problem) {
  if (problem.units == Units{}) return {};
  const Oscillator& o = problem.oscillator;
  const Stops& stops = problem.stops;
  std::vector<KeyAndNumber> scene{
      {"h", o.damping}, {"f", o.forcing},           {"nu", o.frequency},         {"phase", problem.start.phase},
      {"load", o.load}, {"stiffness", o.stiffness}, {"stop_lower", stops.lower}, {"stop_upper", stops.upper}};
  struct Keys {
    std::string_view stiffness, damping, R, exponent, reference, below;
  };
  constexpr Keys of_stops[] = {{"stop_stiffness_lower", "stop_damping_lower", "R_lower", "R_exponent_lower",
                                "R_reference_speed_lower", "R_below_lower"},
                               {"stop_stiffness_upper", "stop_damping_upper", "R_upper", "R_exponent_upper",
                                "R_reference_speed_upper", "R_below_upper"}},
                 of_walls[] = {{"loose_wall_stiffness_lower", "loose_wall_damping_lower", "loose_R_lower",
                                "loose_R_exponent_lower", "loose_R_reference_speed_lower", "loose_R_below_lower"},
                               {"loose_wall_stiffness_upper", "loose_wall_damping_upper", "loose_R_upper",
                                "loose_R_exponent_upper", "loose_R_reference_speed_upper", "loose_R_below_upper"}};
  const auto add_restitution = [&](const Keys& keys, const Restitution<double>& law) {
    if (law.table == nullptr) scene.push_back({keys.R, law.R});  // a table is as it was given
    if (law.exponent != 0) scene.insert(scene.end(), {{keys.exponent, law.exponent}, {keys.reference, law.reference}});
    if (law.below != 0) scene.push_back({keys.below, law.below});
  };
  const auto add_stop = [&](const Keys& keys, const Stops& of, Side side) {
    const bool lower = side == Side::lower;
    if (!is_soft(of, side)) return add_restitution(keys, law_of(of, side));
    scene.push_back({keys.stiffness, lower ? of.stiffness_lower : of.stiffness_upper});
    scene.push_back({keys.damping, lower ? of.damping_lower : of.damping_upper});
  };
  for (const Side side : {Side::lower, Side::upper}) add_stop(of_stops[index_of(side)], stops, side);
  for (const Side side : {Side::lower, Side::upper})
    if (const auto& [amplitude, phase] = motion_of(stops, side); amplitude != 0)
      scene.insert(scene.end(), {{side == Side::lower ? "stop_amplitude_lower" : "stop_amplitude_upper", amplitude},
                                 {side == Side::lower ? "stop_phase_lower" : "stop_phase_upper", phase}});
  if (has_friction(problem.friction))
    scene.insert(scene.end(),
                 {{"friction", problem.friction.kinetic}, {"friction_static", problem.friction.static_level}});
  if (const LooseMass& loose = problem.loose; has_loose_mass(loose)) {
    scene.insert(scene.end(),
                 {{"loose_mass", loose.ratio}, {"loose_lower", loose.lower}, {"loose_upper", loose.upper}});
    for (const Side side : {Side::lower, Side::upper}) add_stop(of_walls[index_of(side)], walls_of(loose), side);
    scene.insert(scene.end(), {{"loose_load", loose.load},
                               {"loose_friction", loose.friction},
                               {"loose_friction_static", loose.friction_static},
                               {"loose_x0", loose.place},
                               {"loose_v0", loose.velocity}});
  }
  scene.insert(scene.end(), {{"x0", problem.start.displacement}, {"v0", problem.start.velocity}});
  return scene;
}

std::string plan_text(const plan::Plan& plan, const sweep::Sweep& sweep, int threads, std::optional<double> seconds) {
  std::string text =
      line("axes", axes_text(sweep)) + points_text(plan, sweep) + line("observed", joined(plan.observed));
  const stepping::Integration& integration = sweep.problem.integration;
  if (integration.method != stepping::Method::exact)
    text += line("method", method_of(sweep) + ": every effect is simulated; called for are:");
  else if (integration.all_effects)
    text += line("effects", "all are simulated, for all of max_periods (integrator.effects = all); called for are:");
  for (const plan::Group& group : plan.groups) text += group_text(group, sweep);
  const std::string on = " s on " + counted(threads, "thread");
  text += '\n' +
          line("estimated time", seconds ? formatted("%.2g", *seconds) + on + ", observables and writing included"
                                         : range(seconds_of(plan, threads), "%.2g") + on + ", without the observables");
  const plan::MemoryNeed& need = plan.need;
  text += line("output", bytes_text(need.output) + " before compression" +
                             (need.log > 0 ? ", the impact log by an estimate" : ""));
  text += line("memory", bytes_text(need.memory) +
                             (need.log > 0 ? ", by an estimate of the impact log: " + bytes_text(need.log) : "") +
                             (std::isfinite(plan.available_memory) ? ", of " + bytes_text(plan.available_memory) : ""));
  text += line("disk", bytes_text(need.disk()) + " at most: output" +
                           (need.in_files > 0 ? ", journal, and results that don't go into memory" : " and journal"));
  text += line("merge of shards", bytes_text(need.merging) + " of memory, and the whole output on its disk");
  return text;
}

}  // namespace clatter::app
