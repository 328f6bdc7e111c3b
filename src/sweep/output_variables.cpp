#include "sweep/output_variables.hpp"

#include <string>

#include "sweep/attractor_table.hpp"

namespace clatter::sweep {

std::vector<OutputVariable> outputs_of(const point::RunSettings& settings) {
  std::vector<OutputVariable> outputs;
  if (settings.time.mode == steady::Mode::steady)
    outputs.push_back(observables::missing_if(
        "no period is known",
        observables::scalar("settling_estimate", "forcing periods until within the tolerance of the steady motion",
                            &point::PointResult::settling_estimate)));
  for (OutputVariable& output : observables::All::columns<point::PointResult>(settings.observe))
    outputs.push_back(std::move(output));
  return outputs;
}

std::vector<results::Attribute> flag_attributes(std::span<const std::pair<std::uint8_t, std::string_view>> meanings) {
  std::vector<std::uint8_t> values;
  std::string text;
  for (const auto& [value, meaning] : meanings) {
    values.push_back(value);
    (text += text.empty() ? "" : " ") += meaning;
  }
  return {{"flag_values", values}, {"flag_meanings", text}};
}

std::vector<results::Attribute> status_flags() {
  std::vector<std::pair<std::uint8_t, std::string_view>> meanings;
  for (const auto& [status, name, meaning] : steady::status_names)
    meanings.emplace_back(static_cast<std::uint8_t>(status), name);
  return flag_attributes(meanings);
}

double most_values(const Sweep& sweep, const std::optional<results::Shard>& shard) {
  double of_point = 5;  // status, impact_total, simulated_periods, index in the sweep, impact_count
  for (const OutputVariable& output : outputs_of(sweep.problem)) of_point += static_cast<double>(output.width());
  double coordinates = sweep.direction == Direction::both ? 2 : 0;
  for (const observables::Coordinate& coordinate : observables::All::coordinates(sweep.problem.observe))
    coordinates += static_cast<double>(coordinate.length);
  for (const Dimension& dimension : sweep.dimensions)
    coordinates += static_cast<double>(dimension.size() * length(dimension));
  if (sweep.problem.observe.attractor) of_point += attractor_values;
  return of_point * static_cast<double>(Share(sweep, shard).points()) + coordinates;
}

double logged_values(const Sweep& sweep) {
  return 1 + static_cast<double>(observables::log_columns(is_shaken(sweep)).size());  // the stop, too
}

}  // namespace clatter::sweep
