#include "tables/json_output.hpp"

#include <cstdint>
#include <nlohmann/json.hpp>

#include "accuracy/accuracy_dataset.hpp"
#include "branches/measures/measures.hpp"
#include "runs/plan_report.hpp"
#include "sweep/binomial_share.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

using Json = nlohmann::ordered_json;

std::string text_of(const Json& json, int indent) {
  return json.dump(indent, ' ', true, Json::error_handler_t::replace) + '\n';
}

constexpr int in_lines = 2, in_one_line = -1;

/// A whole number, that is computed in double since it may be beyond any integer.
Json whole_number(double number) {
  return number < 0x1p63 ? Json(static_cast<std::int64_t>(number)) : Json(number);  // infinity becomes null
}

Json pair_of(const plan::Bounds& estimate) { return {estimate.least, estimate.most}; }

template <class T, class Value>
Json or_null(const std::optional<T>& optional, const Value& value) {
  return optional ? Json(value(*optional)) : Json();
}

/// The scene that the example of a group is computed as, and its units; null if these are the user's.
Json computed_as(const point::Problem& problem) {
  Json json;
  for (const auto& [key, number] : computed_scene(problem)) json[key] = number;
  if (!json.is_null()) json["unit_of_time"] = problem.units.time;
  return json;
}

Json group_json(const plan::Group& group, const sweep::Sweep& sweep) {
  Json effects = Json::array();
  for (const plan::Reason& reason : group.reasons)
    effects.push_back({{"effect", reason.effect},
                       {"required", reason.required},
                       {"why", reason.why},
                       {"saves", pair_of(reason.saving)}});
  return {{"points", group.points},
          {"example", group.example},
          {"computed_as", computed_as(problem_at(sweep, group.example))},
          {"effect_set", plan::effect_set_name(group.effects)},
          {"periods", pair_of(group.periods)},
          {"seconds", pair_of(group.seconds)},
          {"effects", effects}};
}

Json dimension_json(const sweep::Dimension& dimension) {
  Json axes = Json::array();
  for (const sweep::Axis& axis : dimension)
    axes.push_back({{"key", axis.parameter.key()},
                    {"length", axis.values.size()},
                    {"first", axis.values.front()},
                    {"last", axis.values.back()}});
  return axes;
}

Json entry_json(const results::FileSummary::Entry& entry) {
  Json names = Json::array(), shape = Json::array();
  for (const results::NamedLength& dimension : entry.dimensions)
    names.push_back(dimension.name), shape.push_back(dimension.length);
  Json json{{"name", entry.name}, {"type", entry.type},   {"dimensions", names},
            {"shape", shape},     {"units", entry.units}, {"long_name", entry.long_name}};
  if (!entry.frame.empty()) json["frame"] = entry.frame;
  return json;
}

Json numbers_json(const std::vector<Whereabouts>& named) {
  Json json = Json::object();
  for (const auto& [name, value, units] : named) json[name] = value;
  return json;
}

}  // namespace

std::string summary_json(const results::FileSummary& summary, const std::vector<Quantiles>& quantiles,
                         const ToldMotions& motions) {
  Json attributes = Json::object(), variables = Json::array(), status = Json::object();
  for (const auto& [name, text] : summary.attributes) attributes[name] = text;
  for (const results::FileSummary::Entry& entry : summary.variables) variables.push_back(entry_json(entry));
  for (const auto& [meaning, count] : summary.status_counts) status[meaning] = count;
  Json json{{"attributes", attributes}, {"variables", variables}, {"status", status}};
  for (const Quantiles& of_result : quantiles) {
    Json values = Json::object();
    for (std::size_t i = 0; i < told_shares.size(); ++i) values[formatted("%g", told_shares[i])] = of_result.values[i];
    Json& own = json["quantiles"][of_result.result];
    own = {{"points", of_result.points}, {"units", of_result.units}, {"at", values}};
    if (!of_result.per.empty()) own["per"] = "forcing period";
  }
  for (const ToldMotion& motion : motions.motions)
    json["motions"].push_back({{"word", motion.word},
                               {"period_ratio", motion.period},
                               {"points", motion.points},
                               {"share", static_cast<double>(motion.points) / static_cast<double>(motions.points)},
                               {"impact_speed", motion.speed}});
  return text_of(json, in_lines);
}

std::string ranges_json(const Ranges& ranges, const std::vector<RangeLine>& lines, const std::optional<Met>& met) {
  Json json{{"result", ranges.result() != nullptr ? entry_json(*ranges.result()) : Json()}, {"where", Json::array()}};
  for (const Condition& condition : ranges.choice().where) json["where"].push_back(text_of(condition));
  if (met) {
    json["points"] = met->points, json["of"] = met->of;
    json["failed"] = met->failed, json["without_value"] = met->without_value;
    if (met->of > 0) {
      const sweep::BinomialShare share = sweep::binomial_share(met->points, met->of);
      json["share"] = share.share;
      json["interval"] = ranges.is_sample() ? Json{share.low, share.high} : Json();
    }
  }
  json["lines"] = Json::array();
  for (const RangeLine& line : lines) {
    Json of_line = Json::array();
    for (const Range& range : line.ranges)
      of_line.push_back({{"word", ranges.result() != nullptr ? Json(range.word) : Json()},
                         {"from", numbers_json(range.from)},
                         {"to", numbers_json(range.to)},
                         {"points", range.points}});
    json["lines"].push_back({{"at", numbers_json(line.at)}, {"ranges", of_line}});
    for (const Gap& gap : line.gaps)
      json["lines"].back()["gaps"].push_back(
          {{"after", gap.after}, {"from", numbers_json(gap.from)}, {"to", numbers_json(gap.to)}, {"why", gap.why}});
  }
  return text_of(json, in_lines);
}

std::string extremes_json(const Extremes& extremes, const std::vector<Extreme>& points) {
  Json list = Json::array();
  for (const Extreme& point : points) {
    Json json{{"value", point.value}, {"at", numbers_json(point.axes)}, {"component", numbers_json(point.component)}};
    for (const auto& [name, word] : point.words) json[name] = word;
    list.push_back(json);
  }
  return text_of(
      {{"result", entry_json(extremes.result())}, {"extreme", extremes.is_largest() ? "max" : "min"}, {"points", list}},
      in_lines);
}

std::string reading_json(const config::Reading& reading) {
  return text_of({{"value", reading.value},
                  {"units", si_unit(reading.quantity)},
                  {"unit", reading.unit.empty() ? Json() : Json(reading.unit)}},
                 in_one_line);
}

std::string plan_json(const plan::Plan& plan, const sweep::Sweep& sweep, int threads, std::optional<double> seconds) {
  Json dimensions = Json::array(), groups = Json::array();
  for (const sweep::Dimension& dimension : sweep.dimensions) dimensions.push_back(dimension_json(dimension));
  for (const plan::Group& group : plan.groups) groups.push_back(group_json(group, sweep));
  const auto itself = [](const auto& value) { return value; };
  return text_of({{"schema", "clatter-plan/1"},
                  {"shard", or_null(plan.shard, [](const results::Shard& shard) { return results::text_of(shard); })},
                  {"points", plan.points},
                  {"sampled_points", or_null(plan.sampled_points, itself)},
                  {"mirror_images", plan.mirror_images},
                  {"dimensions", dimensions},
                  {"follow", or_null(sweep.follow, [&](std::size_t d) { return name_of(sweep.dimensions[d]); })},
                  {"direction", sweep::direction_names[static_cast<std::size_t>(sweep.direction)]},
                  {"observed", plan.observed},
                  {"method", method_of(sweep)},
                  {"all_effects", sweep.problem.integration.all_effects},
                  {"groups", groups},
                  {"threads", threads},
                  {"seconds", pair_of(seconds_of(plan, threads))},
                  {"foretold_seconds", or_null(seconds, itself)},
                  {"output_bytes", whole_number(plan.need.output)},
                  {"memory_bytes", whole_number(plan.need.memory)},
                  {"disk_bytes", whole_number(plan.need.disk())},
                  {"merge_memory_bytes", whole_number(plan.need.merging)},
                  {"estimated_log_bytes", whole_number(plan.need.log)},
                  {"machine_bytes", whole_number(plan.available_memory)},
                  {"warnings", plan.warnings}},
                 in_lines);
}

std::string accuracy_json(const accuracy::PointAccuracy& of_point, const sweep::Sweep& sweep, std::size_t point) {
  std::string lines;
  for (const accuracy::WorkPrecision& row : of_point.rows) {
    Json json{{"method", accuracy::method_names[static_cast<std::size_t>(row.trial.method)]},
              {"setting", row.trial.setting},
              {"arch", name_of(row.trial.arch)}};
    for (const auto& [name, long_name, value] : accuracy::row_variables()) json[name] = row.*value;
    json["status"] = static_cast<int>(row.status), json["point"] = point;
    each_coordinate(sweep, point,
                    [&](const sweep::Axis& axis, double value) { json[std::string(axis.parameter.key())] = value; });
    for (const auto& [name, long_name, value] : accuracy::point_variables()) json[name] = of_point.*value;
    lines += text_of(json, in_one_line);
  }
  return lines;
}

std::string special_json(const branches::SpecialPoint& special, const std::vector<Parameter>& parameters,
                         const Units& units, const branches::WordLetters& letters) {
  const branches::BranchPoint& at = special.at;
  const attractors::SectionState state = branches::state_at_phase_zero(at.scene, at.orbit);
  const double velocity = factor_of(units, Quantity::velocity);
  Json json{{"kind", name_of(special.kind)}};
  for (const Parameter parameter : parameters) json[std::string(parameter.key())] = value_of(at.scene, parameter);
  json["impact_speed"] = velocity * branches::impact_speed(at.orbit, letters);
  json["x"] = state.x, json["v"] = velocity * state.v;
  if (has_loose_mass(at.scene.loose)) json["z"] = state.z, json["w"] = velocity * state.w;
  json["period_ratio"] = at.orbit.period_ratio(), json["word"] = at.orbit.word(letters);
  json["stable"] = at.stable;
  json["multipliers"] = Json::array();
  for (std::size_t i = 0; i < branches::multipliers_in(at.scene); ++i)
    json["multipliers"].push_back({at.multiplier_re[i], at.multiplier_im[i]});
  json["branches"] = special.branches, json["left_out"] = special.left_out;
  return text_of(json, in_one_line);
}

}  // namespace clatter::app
