#include "certificate.hpp"

#include <cmath>
#include <limits>
#include <nlohmann/json.hpp>
#include <utility>

namespace verify {
namespace {

using Json = nlohmann::json;

/// The beginning of a text of a file, without control characters.
std::string shown(const std::string& text) {
  const std::string escaped = Json(text.substr(0, 40)).dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string quoted(escaped);
  quoted.front() = quoted.back() = '\'';
  return quoted;
}

/// A value of a certificate and its place in it.
class Field {
 public:
  Field(const Json& json, std::string path) : json_(json), path_(std::move(path)) {}

  [[noreturn]] void refuse(const std::string& found, const std::string& way_out) const {
    throw FormatError(path_ + ": " + found + "; " + way_out);
  }
  [[nodiscard]] std::optional<Field> find(const std::string& name) const {
    require_object();
    const auto member = json_.find(name);
    if (member == json_.end()) return std::nullopt;
    return Field(*member, path_.empty() ? name : path_ + "." + name);
  }
  [[nodiscard]] Field get(const std::string& name) const {
    if (const auto member = find(name)) return *member;
    Field(json_, path_.empty() ? name : path_ + "." + name).refuse("is missing", "add it");
  }
  void require_object() const {
    if (!json_.is_object()) refuse("is no object", "write {...}");
  }
  [[nodiscard]] std::vector<Field> items() const {
    if (!json_.is_array()) refuse("is no array", "write [...]");
    std::vector<Field> list;
    for (std::size_t i = 0; i < json_.size(); ++i) list.emplace_back(json_[i], path_ + "[" + std::to_string(i) + "]");
    return list;
  }
  [[nodiscard]] std::string text() const {
    if (!json_.is_string()) refuse("is no text", "write it in quotes");
    return json_.get<std::string>();
  }
  [[nodiscard]] bool flag() const {
    if (!json_.is_boolean()) refuse("is neither true nor false", "write one of them");
    return json_.get<bool>();
  }
  [[nodiscard]] Number number() const {
    if (json_.is_number()) {
      const double value = json_.get<double>();
      if (!std::isfinite(value)) refuse("is beyond double", "write a decimal number in quotes");
      return Number(value);
    }
    if (!json_.is_string()) refuse("is no number", "write a number, or a decimal number in quotes");
    const std::string text = json_.get<std::string>();
    Ball ball;
    if (text.find_first_not_of("0123456789+-.eE") != std::string::npos || text.size() > 400 || !Ball::read(text, ball))
      refuse(shown(text) + " is no decimal number", "write e.g. \"0.1\"");
    if (!(abs(ball) < Ball(1e300)) || !(abs(ball) > Ball(1e-300) || ball.is_zero()))
      refuse(shown(text) + " is beyond 1e-300 to 1e300", "change the units");
    return Number(text);
  }
  [[nodiscard]] Number number_from(double least, double most, bool with_least = true) const {
    const Number value = number();
    const Ball ball = value.ball();
    if (ball < Ball(least) || (!with_least && !(ball > Ball(least))) || ball > Ball(most))
      refuse("is " + value.text(), std::string("it must be ") + (with_least ? "at least " : "above ") +
                                       Number(least).text() +
                                       (std::isfinite(most) ? " and at most " + Number(most).text() : ""));
    return value;
  }
  [[nodiscard]] Claimed claimed() const {
    const auto pair = items();
    if (pair.size() != 2) refuse("has " + std::to_string(pair.size()) + " items", "write [value, error]");
    return {pair[0].number(), pair[1].number_from(0, infinity)};
  }
  [[nodiscard]] long count(long most) const {
    if (!json_.is_number_integer()) refuse("is no whole number", "write 1 or more");
    const auto value = json_.get<std::int64_t>();
    if (value < 1 || value > most) refuse("is out of range", "write 1 to " + std::to_string(most));
    return static_cast<long>(value);
  }
  [[nodiscard]] Side side() const {
    const std::string name = text();
    if (name != "lower" && name != "upper") refuse("is " + shown(name), "write lower or upper");
    return name == "upper" ? Side::upper : Side::lower;
  }
  [[nodiscard]] std::string dump() const { return json_.dump(-1, ' ', false, Json::error_handler_t::replace); }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

 private:
  const Json& json_;
  std::string path_;
};

std::optional<Certificate::StopNumbers> stop_of(const Field& scene, const char* name) {
  const auto field = scene.find(name);
  if (!field) return std::nullopt;
  Certificate::StopNumbers stop;
  stop.position = field->get("position").number();
  const auto R = field->find("R"), stiffness = field->find("stiffness");
  if (R.has_value() == stiffness.has_value())
    field->refuse(R ? "has R and stiffness" : "has neither R nor stiffness", "give one of them");
  stop.soft = stiffness.has_value();
  if (R) stop.R = R->number_from(0, 1);
  if (stiffness) stop.stiffness = stiffness->number_from(0, Field::infinity, false);
  if (stiffness) stop.damping = field->get("damping").number_from(0, Field::infinity);
  return stop;
}

Certificate::SceneNumbers scene_of(const Field& field) {
  Certificate::SceneNumbers scene{
      field.get("h").number_from(0, Field::infinity),         field.get("k").number(),    field.get("f").number(),
      field.get("nu").number_from(0, Field::infinity, false), field.get("load").number(), field.get("phase").number(),
      {stop_of(field, "lower"), stop_of(field, "upper")}};
  if (const auto friction = field.find("friction")) scene.friction = friction->number_from(0, Field::infinity);
  scene.friction_static = scene.friction;
  if (const auto level = field.find("friction_static")) {
    scene.friction_static = level->number_from(0, Field::infinity);
    if (scene.friction_static.ball() < scene.friction.ball())
      level->refuse("is below friction", "give the same or more, or leave it out");
  }
  if (scene.stops[0] && scene.stops[1] && !(scene.stops[0]->position.ball() < scene.stops[1]->position.ball()))
    field.refuse("has its lower stop above the upper one", "exchange them");
  return scene;
}

ClaimedEvent event_of(const Field& field) {
  ClaimedEvent event;
  const Field kind = field.get("event");
  const std::string name = kind.text();
  bool known = false;
  for (const Kind one : {Kind::impact, Kind::touch, Kind::separation, Kind::renewal, Kind::graze, Kind::chatter,
                         Kind::rest, Kind::reversal, Kind::stick})
    if (name == name_of(one)) event.kind = one, known = true;
  if (!known)
    kind.refuse("is " + shown(name),
                "write impact, touch, separation, renewal, graze, chatter, rest, reversal or stick");
  event.time = field.get("time").claimed();
  if (is_of_friction(event.kind)) {
    event.x = field.get("x").claimed();
    if (event.kind == Kind::stick) event.until = field.get("until").claimed();
    return event;
  }
  event.side = field.get("stop").side();
  if (event.kind == Kind::chatter || event.kind == Kind::rest)
    event.until = field.get("until").claimed();
  else if (event.kind != Kind::graze)
    event.v = field.get("v").claimed();
  return event;
}

/// Each event must be one of a stop that there is, of its kind.
void require_stops(const Field& field, const Certificate& certificate) {
  const auto& events = certificate.events;
  for (std::size_t i = 0; i < events.size(); ++i) {
    if (is_of_friction(events[i].kind)) {
      if (!certificate.scene.friction_static.ball().is_zero()) continue;
      field.items()[i].refuse("is an event of dry friction", "the scene has none; give its friction");
    }
    const auto& stop = certificate.scene.stops[index_of(events[i].side)];
    const bool of_rigid =
        events[i].kind == Kind::impact || events[i].kind == Kind::chatter || events[i].kind == Kind::rest;
    if (events[i].kind == Kind::graze && !certificate.special)
      field.items()[i].refuse("is a graze",
                              "only special points have one; give its time and velocity as an impact or touch");
    if (stop && events[i].kind == Kind::graze) continue;
    if (!stop || stop->soft == of_rigid)
      field.items()[i].refuse(std::string("is an event of a ") + (of_rigid ? "rigid" : "soft") + " stop",
                              "the scene has none there");
  }
  if (certificate.released && (!certificate.scene.stops[index_of(*certificate.released)] ||
                               certificate.scene.stops[index_of(*certificate.released)]->soft))
    field.refuse("start with a release by a stop", "the scene has no rigid stop there");
}

std::string word_of(const Field& field) {
  const std::string word = field.text();
  const bool has_no_impacts = word == "-" || word == "(L)" || word == "(U)";
  if (!has_no_impacts && word.find_first_not_of("LU*\u2026") != std::string::npos)
    field.refuse("is " + shown(word),
                 "write L, U, L* and U* in the order of the impacts, (L) or (U) for a mass that stays on a stop, or -");
  return word;
}

/// A special point is known by its motion: what else periodic motion may claim is no part of it.
void require_claims_of_special(const Field& root) {
  for (const char* const name : {"word", "multipliers", "x_min", "x_max"})
    if (const auto other = root.find(name)) other->refuse("is no claim of a special point", "leave it out");
  if (const auto symmetric = root.find("symmetric"); symmetric && !symmetric->flag())
    symmetric->refuse("is false", "leave it out; true says that half a period is mirrored");
}

void read_periodic(const Field& root, Certificate& certificate) {
  if (certificate.special) require_claims_of_special(root);
  certificate.periods = root.get("periods").count(1'000'000);
  if (const auto word = root.find("word")) certificate.word = word_of(*word);
  if (const auto symmetric = root.find("symmetric")) certificate.symmetric = symmetric->flag();
  if (certificate.scene.f.ball().is_zero())
    root.get("claim").refuse("periodic motion without a force", "claim a transient");
  const auto multipliers = root.find("multipliers");
  if (!multipliers) return;
  const auto pair = multipliers->items();
  if (pair.size() != 2) multipliers->refuse("has not two items", "write [[re, im, error], [re, im, error]]");
  certificate.multipliers.emplace();
  for (std::size_t i = 0; i < 2; ++i) {
    const auto parts = pair[i].items();
    if (parts.size() != 3) pair[i].refuse("has not three items", "write [re, im, error]");
    (*certificate.multipliers)[i] = {parts[0].number(), parts[1].number(), parts[2].number_from(0, Field::infinity)};
  }
}

SpecialKind special_kind_of(const Field& field) {
  const std::string name = field.text();
  for (int i = 0; i <= static_cast<int>(SpecialKind::impact_power); ++i)
    if (name == name_of(static_cast<SpecialKind>(i))) return static_cast<SpecialKind>(i);
  field.refuse("is " + shown(name),
               "write fold, flip, symmetry breaking, graze, maximum impact_speed or maximum impact_power");
}

/// How the numbers of a scene change with the parameter; those left out don't.
Certificate::SceneNumbers slopes_of(const Field& field, const Certificate::SceneNumbers& scene) {
  bool moves = false;
  const auto slope = [&](const Field& of, const char* name) {
    const auto member = of.find(name);
    const Number number = member ? member->number() : Number();
    moves = moves || !number.ball().is_zero();
    return number;
  };
  Certificate::SceneNumbers slopes{slope(field, "h"),
                                   slope(field, "k"),
                                   slope(field, "f"),
                                   slope(field, "nu"),
                                   slope(field, "load"),
                                   slope(field, "phase"),
                                   {}};
  for (const Side side : {Side::lower, Side::upper}) {
    const auto stop = field.find(name_of(side));
    if (!stop) continue;
    if (!scene.stops[index_of(side)]) stop->refuse("is of no stop", "leave it out");
    slopes.stops[index_of(side)] = {slope(*stop, "position"), false, slope(*stop, "R"), slope(*stop, "stiffness"),
                                    slope(*stop, "damping")};
  }
  if (!moves) field.refuse("leaves the scene as it is", "give the slope of a number that the parameter changes");
  return slopes;
}

Certificate::Special special_of(const Field& root, const Certificate::SceneNumbers& scene) {
  return {special_kind_of(root.get("kind")), root.get("parameter").claimed(), slopes_of(root.get("slopes"), scene)};
}

void read_start(const Field& start, Certificate& certificate) {
  certificate.start_time = start.get("time").number();
  if (const auto released = start.find("released")) {
    certificate.released = released->side();
    if (certificate.scene.f.ball().is_zero()) released->refuse("needs a force", "give x and v");
  } else {
    const auto read = [&](const char* name) {
      const Field field = start.get(name);
      return certificate.periodic ? field.claimed() : Claimed{field.number(), Number()};
    };
    certificate.start_x = read("x"), certificate.start_v = read("v");
  }
}

std::string place_of(const Field& root) {
  std::string place;
  for (const char* const member : {"name", "point", "special", "at"}) {
    const auto found = root.find(member);
    if (!found) continue;
    const std::string text = found->dump();  // without control characters
    if (!place.empty()) place += ' ';
    if (*member == 'p' || *member == 's') place.append(member).append(" ");
    place += *member == 'n' && text.size() > 1 ? text.substr(1, text.size() - 2) : text;
  }
  return place;
}

}  // namespace

const char* name_of(SpecialKind kind) {
  static constexpr const char* names[] = {
      "fold", "flip", "symmetry breaking", "graze", "maximum impact_speed", "maximum impact_power"};
  return names[static_cast<std::size_t>(kind)];
}

Certificate read_certificate(const std::string& line) {
  Json json;
  try {
    json = Json::parse(line, [](int depth, Json::parse_event_t, const Json&) {
      if (depth > 8) throw FormatError("the line nests more than eight objects; write one as the guide shows");
      return true;
    });
  } catch (const Json::exception& error) {
    throw FormatError(std::string("is no JSON (") + error.what() + "); write one object a line");
  }
  const Field root(json, "");
  if (!json.is_object()) throw FormatError("the line is no JSON object; write {...}");
  const Field format = root.get("format");
  if (format.text() != "clatter-certificate-1") format.refuse("is another one", "write \"clatter-certificate-1\"");
  Certificate certificate;
  certificate.place = place_of(root);
  certificate.scene = scene_of(root.get("scene"));
  const Field claim = root.get("claim");
  const std::string kind = claim.text();
  if (kind != "periodic" && kind != "transient" && kind != "special")
    claim.refuse("is " + shown(kind), "write transient, periodic or special");
  certificate.periodic = kind != "transient";
  if (kind == "special") certificate.special = special_of(root, certificate.scene);
  if (certificate.periodic) read_periodic(root, certificate);
  read_start(root.get("start"), certificate);
  const Field events = root.get("events");
  for (const Field& event : events.items()) certificate.events.push_back(event_of(event));
  require_stops(events, certificate);
  if (const auto x = root.find("x_min")) certificate.x_min = x->claimed();
  if (const auto x = root.find("x_max")) certificate.x_max = x->claimed();
  if (!certificate.periodic) {
    const Field end = root.get("end");
    certificate.end = {end.get("time").number(), end.get("x").claimed(), end.get("v").claimed()};
    if (!(certificate.end->time.ball() > certificate.start_time.ball()))
      end.refuse("is not after the start", "give a later time");
  }
  return certificate;
}

}  // namespace verify
