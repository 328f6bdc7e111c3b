// Writes the hard cases as certificates in 30 digits, one a line; tests/hard/README.md describes them.

#include <algorithm>
#include <cmath>
#include <exception>
#include <iostream>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "accuracy/run_record.hpp"
#include "hard/exact_run.hpp"

namespace clatter::hard {
namespace {

using Json = nlohmann::ordered_json;
using Kind = ExactEvent::Kind;

constexpr std::size_t most_events = 10000;
constexpr int digits = 30;

const char* name_of(Side side) { return side == Side::upper ? "upper" : "lower"; }
const char* name_of(Kind kind) {
  static const char* const names[] = {"impact", "rest", "chatter", "touch", "renewal", "separation"};
  return names[static_cast<int>(kind)];
}

/// A number in 30 digits with an error of a unit of the last one: that of rounding is half of it.
Json claimed(const FiftyDigits& value) {
  if (value == 0) return {"0", 1e-30};
  const auto exponent = static_cast<int>(floor(log10(abs(value)))) - digits + 1;
  return {value.str(digits), std::stod("1e" + std::to_string(exponent))};
}

Json json_of(const Stops& stops, Side side) {
  const bool upper = side == Side::upper;
  Json stop{{"position", upper ? stops.upper : stops.lower}};
  if (!is_soft(stops, side)) {
    stop["R"] = (upper ? stops.restitution_upper : stops.restitution_lower).R;
    return stop;
  }
  stop["stiffness"] = upper ? stops.stiffness_upper : stops.stiffness_lower;
  stop["damping"] = upper ? stops.damping_upper : stops.damping_lower;
  return stop;
}

Json json_of(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  Json json{{"h", o.damping},    {"k", o.stiffness}, {"f", o.forcing},
            {"nu", o.frequency}, {"load", o.load},   {"phase", scene.start.phase}};
  if (std::isfinite(scene.stops.lower)) json["lower"] = json_of(scene.stops, Side::lower);
  if (std::isfinite(scene.stops.upper)) json["upper"] = json_of(scene.stops, Side::upper);
  return json;
}

Json json_of(const ExactEvent& event) {
  const bool lasts = event.kind == Kind::rest || event.kind == Kind::chatter;
  return {{"event", name_of(event.kind)},
          {"stop", name_of(event.side)},
          {"time", claimed(event.time)},
          {lasts ? "until" : "v", claimed(lasts ? event.until : event.velocity)}};
}

Json certificate_of(const Case& one, const ExactRun& run) {
  const Start& start = one.scene.start;
  Json json{{"format", "clatter-certificate-1"},
            {"name", one.row + ", " + one.what},
            {"scene", json_of(one.scene)},
            {"claim", "transient"},
            {"start", {{"time", 0.0}, {"x", start.displacement}, {"v", start.velocity}}}};
  json["events"] = Json::array();
  for (const ExactEvent& event : run.events) json["events"].push_back(json_of(event));
  if (run.x_min) json["x_min"] = claimed(*run.x_min);
  if (run.x_max) json["x_max"] = claimed(*run.x_max);
  json["end"] = {{"time", one.duration}, {"x", claimed(run.x)}, {"v", claimed(run.v)}};
  return json;
}

/// Writes the cases of some rows, of all if none is named, but for those with too many events or with dry friction.
void write(const std::vector<std::string>& rows) {
  for (const Case& one : cases()) {
    if (!rows.empty() && std::ranges::find(rows, one.row) == rows.end()) continue;
    if (has_friction(one.scene.friction)) continue;
    const auto in_double = accuracy::with_rests_joined(accuracy::record_of(one.scene, one.duration).events);
    if (in_double.size() > most_events) continue;
    const ExactRun run = in_double.empty() ? exact_flight(one) : exact_run(one);
    std::cout << certificate_of(one, run).dump() << '\n' << std::flush;
  }
}

}  // namespace
}  // namespace clatter::hard

int main(int count, char** words) try {
  clatter::hard::write({words + 1, words + count});
  return std::cout.flush() ? 0 : 74;
} catch (const std::exception& error) {
  std::cerr << "hard_scenes: " << error.what() << '\n';
  return 70;
}
