#include "certificates/certificate_text.hpp"

#include <cmath>
#include <nlohmann/json.hpp>
#include <string>

namespace clatter::certificates {
namespace {

using Json = nlohmann::ordered_json;
using Kind = motion::Event::Kind;

const char* name_of(Side side) { return side == Side::upper ? "upper" : "lower"; }

/// JSON has no infinite numbers.
Json json_of(double value) { return std::isfinite(value) ? Json(value) : Json(value > 0 ? "inf" : "-inf"); }
Json json_of(const Claimed& claimed) { return Json::array({claimed.value, claimed.error}); }

/// A number, or what tells how it depends on the speed: as the program's law, with the speeds of a table and their
/// unit.
void add_restitution(Json& json, const Restitution<double>& law) {
  if (law.is_constant()) {
    json["R"] = law.R;
    return;
  }
  Json& told = json["restitution"] = Json::object();
  if (law.table) {
    for (const SpeedTable::Knot& knot : law.table->knots) told["table"].push_back(Json::array({knot.speed, knot.R}));
    if (law.unit != 1) told["unit"] = law.unit;
  } else {
    told["R"] = law.R;
    if (law.exponent > 0) told["exponent"] = law.exponent, told["reference_speed"] = law.reference;
  }
  if (law.below > 0) told["below"] = law.below;
}

Json json_of(const Stops& stops, Side side) {
  const bool upper = side == Side::upper;
  Json stop{{"position", upper ? stops.upper : stops.lower}};
  if (is_soft(stops, side)) {
    stop["stiffness"] = upper ? stops.stiffness_upper : stops.stiffness_lower;
    stop["damping"] = upper ? stops.damping_upper : stops.damping_lower;
  } else {
    add_restitution(stop, law_of(stops, side));
  }
  return stop;
}

/// Dry friction, if there is any.
void add_friction(Json& json, double kinetic, double static_level) {
  if (kinetic == 0 && static_level == 0) return;
  json["friction"] = kinetic;
  if (static_level != kinetic) json["friction_static"] = static_level;
}

Json json_of(const LooseMass& loose) {
  const bool are_alike = loose.restitution_lower == loose.restitution_upper;
  Json json{{"mass", loose.ratio}, {"load", loose.load}};
  if (are_alike) add_restitution(json, loose.restitution_lower);
  const auto add_wall = [&](const char* name, double position, const Restitution<double>& law) {
    if (!std::isfinite(position)) return;
    json[name] = {{"position", position}};
    if (!are_alike) add_restitution(json[name], law);
  };
  add_friction(json, loose.friction, loose.friction_static);
  add_wall("lower", loose.lower, loose.restitution_lower), add_wall("upper", loose.upper, loose.restitution_upper);
  return json;
}

/// The sines and cosines of a force that has further orders than a sine, [order - 1].
using Orders = std::array<ForceOrder<double>, ForceOrders<double>::most>;
void add_orders(Json& json, const Orders& sizes) {
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    Json order{{"order", i + 1}};
    if (i > 0 && sizes[i].in_phase != 0) order["sin"] = sizes[i].in_phase;
    if (sizes[i].quadrature != 0) order["cos"] = sizes[i].quadrature;
    if (order.size() > 1) json["orders"].push_back(order);
  }
}

Json json_of(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  Json json{{"h", o.damping},    {"k", o.stiffness}, {"f", o.forcing},
            {"nu", o.frequency}, {"load", o.load},   {"phase", scene.start.phase}};
  if (o.shape.has_orders()) {
    Orders sizes = o.shape.orders.of;
    for (auto& [sine, cosine] : sizes) sine *= o.forcing, cosine *= o.forcing;
    json["f"] = sizes[0].in_phase, add_orders(json, sizes);
  }
  add_friction(json, scene.friction.kinetic, scene.friction.static_level);
  if (has_loose_mass(scene.loose)) json["loose"] = json_of(scene.loose);
  if (std::isfinite(scene.stops.lower)) json["lower"] = json_of(scene.stops, Side::lower);
  if (std::isfinite(scene.stops.upper)) json["upper"] = json_of(scene.stops, Side::upper);
  return json;
}

/// Of a loose mass an event is one on a wall, on which a rest is a press. Beside stops the wall is named as such.
Json json_of(const ClaimedEvent& event, bool tells_walls) {
  if (event.side == Side::none) {
    const bool stays = event.kind == Kind::stick;
    const auto kind = !event.of_wall ? motion::Event::word(event.kind) : stays ? "hold" : "turn";
    Json turn{{"event", kind}, {"time", json_of(event.time)}};
    if (stays) turn["until"] = json_of(event.then);
    turn[event.of_wall ? "z" : "x"] = json_of(event.place);
    return turn;
  }
  if (event.grazes) return {{"event", "graze"}, {"stop", name_of(event.side)}, {"time", json_of(event.time)}};
  const bool lasts = event.kind == Kind::rest || event.kind == Kind::chatter;
  return {{"event", motion::Event::word(event.of_wall && event.kind == Kind::rest ? Kind::press : event.kind)},
          {event.of_wall && tells_walls ? "wall" : "stop", name_of(event.side)},
          {"time", json_of(event.time)},
          {lasts           ? "until"
           : event.of_wall ? "w"
                           : "v",
           json_of(event.then)}};
}

Json start_of(const Certificate& certificate) {
  const Scene& scene = certificate.scene;
  Json start{{"time", certificate.time}};
  if (certificate.released != Side::none) {
    start["released"] = name_of(certificate.released);
    return start;
  }
  const auto tell = [&](const char* name, double value, double error) {
    start[name] = certificate.period ? json_of(Claimed{value, error}) : Json(value);
  };
  tell("x", scene.start.displacement, certificate.x_error), tell("v", scene.start.velocity, certificate.v_error);
  if (!has_loose_mass(scene.loose)) return start;
  if (certificate.pressed != Side::none)
    start["pressed"] = name_of(certificate.pressed);
  else
    tell("z", scene.loose.place, certificate.x_error), tell("w", scene.loose.velocity, certificate.v_error);
  return start;
}

Json json_of(const ClaimedEnd& end, bool has_loose_mass) {
  Json json{{"time", end.time}, {"x", json_of(end.x)}, {"v", json_of(end.v)}};
  if (has_loose_mass) json["z"] = json_of(end.z), json["w"] = json_of(end.w);
  return json;
}

/// The machine of a point, in SI.
Json json_of(const GivenScene& machine) {
  const auto& [h, force, frequency, load, stiffness, shape, paces] = machine.oscillator;
  Json json{{"mass", machine.mass}, {"stiffness", stiffness}};
  if (std::isfinite(machine.quality))
    json["quality"] = machine.quality;
  else if (machine.damping_ratio != 0)
    json["damping_ratio"] = machine.damping_ratio;
  else
    json["damping"] = machine.damper;
  json["force"] = force, json["frequency"] = frequency, json["load"] = load;
  for (std::size_t i = 0; shape.has_orders() && i < machine.orders.size(); ++i) {
    const auto& [amplitude, phase] = machine.orders[i];
    const std::string order = std::to_string(i + 2);
    if (amplitude != 0) json["force_" + order] = amplitude, json["phase_" + order] = phase;
  }
  return json;
}

Json json_of(const SceneSlopes& slopes) {
  Json json = Json::object();
  const auto add = [](Json& to, const char* name, double slope) {
    if (slope != 0) to[name] = slope;
  };
  add(json, "h", slopes.h), add(json, "k", slopes.k), add(json, "f", slopes.f), add(json, "nu", slopes.nu);
  add(json, "load", slopes.load), add(json, "phase", slopes.phase), add_orders(json, slopes.orders);
  for (const Side side : {Side::lower, Side::upper}) {
    const SceneSlopes::Stop& of = side == Side::upper ? slopes.upper : slopes.lower;
    Json stop = Json::object();
    add(stop, "position", of.position), add(stop, "R", of.R);
    add(stop, "stiffness", of.stiffness), add(stop, "damping", of.damping);
    if (!stop.empty()) json[name_of(side)] = stop;
  }
  return json;
}

void add_period(Json& json, const ClaimedPeriod& period) {
  if (period.word) json["word"] = *period.word;
  if (period.symmetric) json["symmetric"] = *period.symmetric;
  if (!period.multipliers) return;
  for (const ClaimedMultiplier& multiplier : *period.multipliers)
    json["multipliers"].push_back(Json::array({multiplier.re, multiplier.im, multiplier.error}));
}

}  // namespace

std::string certificate_text(const Certificate& certificate, const CertifiedPlace& place) {
  const auto& special = certificate.special;
  Json json{{"format", "clatter-certificate-1"}, {special ? "special" : "point", place.number}};
  if (place.branch) json["branch"] = *place.branch;
  json["at"] = Json::object();
  for (const auto& [name, value] : place.at) json["at"][name] = json_of(value);
  if (place.direction) json["at"]["direction"] = *place.direction;
  if (place.machine) json["machine"] = json_of(*place.machine);
  json["scene"] = json_of(certificate.scene);
  json["claim"] = special ? "special" : certificate.period ? "periodic" : "transient";
  if (special) {
    json["kind"] = special->kind, json["parameter"] = json_of(special->parameter);
    json["slopes"] = json_of(special->slopes);
  }
  if (certificate.period) json["periods"] = certificate.period->periods;
  json["start"] = start_of(certificate);
  json["events"] = Json::array();
  const bool is_loose = has_loose_mass(certificate.scene.loose), tells_walls = has_events_of_its_own(certificate.scene);
  for (const ClaimedEvent& event : certificate.events) json["events"].push_back(json_of(event, tells_walls));
  if (!special) json["x_min"] = json_of(certificate.x_min), json["x_max"] = json_of(certificate.x_max);
  if (certificate.period) add_period(json, *certificate.period);
  if (certificate.end) json["end"] = json_of(*certificate.end, is_loose);
  return json.dump() + '\n';
}

std::string list_begin() { return Json{{"format", "clatter-certificates-1"}, {"certificates", "begin"}}.dump() + '\n'; }
std::string list_end(std::size_t count) {
  return Json{{"format", "clatter-certificates-1"}, {"certificates", count}}.dump() + '\n';
}

}  // namespace clatter::certificates
