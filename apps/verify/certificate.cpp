#include "certificate.hpp"

#include <utility>

#include "field.hpp"
#include "scene_fields.hpp"

namespace verify {
namespace {

/// Walls are named as such beside stops; else they stand in the place of these.
ClaimedEvent event_of(const Field& field, const Certificate::SceneNumbers& scene) {
  ClaimedEvent event;
  const Field kind = field.get("event");
  const std::string name = kind.text();
  bool known = false;
  for (const Kind one : {Kind::impact, Kind::touch, Kind::separation, Kind::renewal, Kind::graze, Kind::chatter,
                         Kind::rest, Kind::reversal, Kind::stick, Kind::press, Kind::turn, Kind::hold})
    if (name == name_of(one)) event.kind = one, known = true;
  if (!known)
    kind.refuse("is " + shown(name),
                "write impact, touch, separation, renewal, graze, chatter, rest, reversal, stick, press, turn or hold");
  event.time = field.get("time").claimed();
  if (is_of_friction(event.kind)) {
    event.of_wall = event.kind == Kind::turn || event.kind == Kind::hold;
    event.x = field.get(event.of_wall ? "z" : "x").claimed();
    if (lasts(event.kind)) event.until = field.get("until").claimed();
    return event;
  }
  const auto wall = scene.loose && scene.has_stops() ? field.find("wall") : std::nullopt;
  event.of_wall = wall || (scene.loose && !scene.has_stops());
  event.side = wall ? wall->side() : field.get("stop").side();
  if (event.kind == Kind::chatter || holds(event.kind))
    event.until = field.get("until").claimed();
  else if (event.kind != Kind::graze)
    event.v = field.get(event.of_wall ? "w" : "v").claimed();
  return event;
}

/// An event of a loose mass must be one on a wall that there is.
void require_wall(const Field& field, const Certificate::SceneNumbers& scene, const ClaimedEvent& event) {
  if (is_of_friction(event.kind)) {
    if (scene.loose && scene.loose->friction_static != Number()) return;
    field.refuse("is an event of dry friction in a housing", "the scene has none; give scene.loose its friction");
  }
  if (event.kind != Kind::impact && event.kind != Kind::chatter && event.kind != Kind::press)
    field.refuse(std::string("is a ") + name_of(event.kind) + " beside a loose mass",
                 "write impact, chatter or press of a wall, turn or hold");
  if (!scene.loose->walls[index_of(event.side)]) field.refuse("is an event of a wall", "the housing has none there");
}

/// One of the main mass must be one of a stop that there is, of its kind.
void require_stop(const Field& field, const Certificate& certificate, const ClaimedEvent& event) {
  const auto& scene = certificate.scene;
  if (event.kind == Kind::press)
    field.refuse("is a press", scene.loose ? "give its wall" : "the scene has no loose mass; give it");
  if (is_of_friction(event.kind)) {
    if (!scene.friction_static.ball().is_zero()) return;
    field.refuse("is an event of dry friction", "the scene has none; give its friction");
  }
  const auto& stop = scene.stops[index_of(event.side)];
  const bool of_rigid = event.kind == Kind::impact || event.kind == Kind::chatter || event.kind == Kind::rest;
  if (event.kind == Kind::graze && !certificate.special)
    field.refuse("is a graze", "only special points have one; give its time and velocity as an impact or touch");
  if (stop && event.kind == Kind::graze) return;
  if (!stop || stop->soft == of_rigid)
    field.refuse(std::string("is an event of a ") + (of_rigid ? "rigid" : "soft") + " stop",
                 "the scene has none there");
}

void require_events(const Field& field, const Certificate& certificate) {
  const auto& events = certificate.events;
  const auto fields = field.items();
  for (std::size_t i = 0; i < events.size(); ++i)
    if (events[i].of_wall)
      require_wall(fields[i], certificate.scene, events[i]);
    else
      require_stop(fields[i], certificate, events[i]);
  if (certificate.released && (!certificate.scene.stops[index_of(*certificate.released)] ||
                               certificate.scene.stops[index_of(*certificate.released)]->soft))
    field.refuse("start with a release by a stop", "the scene has no rigid stop there");
}

/// The letters of a word, L, U, L* and U*, and whether it ends with the mark that others follow. Where walls are told
/// from stops, small ones are of these.
Word word_of(const Field& field, bool tells_walls) {
  static const std::string cut = "\u2026";
  const std::string text = field.text();
  Word word{text, {}, false};
  if (text.empty() || text == "-" || text == "(L)" || text == "(U)" || text == "(S)") return word;
  if (tells_walls && (text == "(l)" || text == "(u)")) return word;
  std::string letters = text;
  if (letters.ends_with(cut)) letters.resize(letters.size() - cut.size()), word.is_cut = true;
  bool is_word = !letters.empty();
  for (const char letter : letters) {
    if (letter == 'L' || letter == 'U' || (tells_walls && (letter == 'l' || letter == 'u')))
      word.letters.emplace_back(1, letter);
    else if (letter == '*' && !word.letters.empty() && word.letters.back().size() == 1)
      word.letters.back() += letter;
    else
      is_word = false;
  }
  if (!is_word)
    field.refuse(
        "is " + shown(text),
        "write L, U, L* and U* in the order of the impacts, (L) or (U) for a mass that stays on a stop, (S) for one "
        "that friction holds for good, or -");
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
  certificate.periods = root.get("periods").count(1, 1'000'000);
  if (const auto word = root.find("word"))
    certificate.word = word_of(*word, certificate.scene.loose && certificate.scene.has_stops());
  if (const auto symmetric = root.find("symmetric")) certificate.symmetric = symmetric->flag();
  if (!certificate.scene.has_force()) root.get("claim").refuse("periodic motion without a force", "claim a transient");
  const auto multipliers = root.find("multipliers");
  if (!multipliers) return;
  const auto list = multipliers->items();
  if (certificate.scene.loose && list.size() != 4)
    multipliers->refuse("has not four items", "write [re, im, error] for each");
  if (!certificate.scene.loose && list.size() != 2)
    multipliers->refuse("has not two items", "write [[re, im, error], [re, im, error]]");
  certificate.multipliers.emplace();
  for (const Field& item : list) {
    const auto parts = item.items();
    if (parts.size() != 3) item.refuse("has not three items", "write [re, im, error]");
    certificate.multipliers->push_back(
        {parts[0].number(), parts[1].number(), parts[2].number_from(0, Field::infinity)});
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
    const bool soft = scene.stops[index_of(side)]->soft;
    slopes.stops[index_of(side)] = {slope(*stop, "position"), soft, soft ? Number() : slope(*stop, "R"),
                                    soft ? slope(*stop, "stiffness") : Number(),
                                    soft ? slope(*stop, "damping") : Number()};
  }
  slopes.orders = scene.orders;
  for (Certificate::OrderNumbers& order : slopes.orders) order.sine = order.cosine = Number();
  if (const auto orders = field.find("orders"))
    for (const Certificate::OrderNumbers& given : orders_of(*orders)) {
      const auto of = std::ranges::find(slopes.orders, given.order, &Certificate::OrderNumbers::order);
      if (of == slopes.orders.end())
        orders->refuse("has the order " + std::to_string(given.order) + ", which the scene hasn't",
                       "give the scene that, with 0");
      *of = given, moves = moves || given.sine != Number() || given.cosine != Number();
    }
  if (!moves) field.refuse("leaves the scene as it is", "give the slope of a number that the parameter changes");
  return slopes;
}

Certificate::Special special_of(const Field& root, const Certificate::SceneNumbers& scene) {
  return {special_kind_of(root.get("kind")), root.get("parameter").claimed(), slopes_of(root.get("slopes"), scene)};
}

/// The place of a loose mass at the start: z and z', or the wall that presses it.
template <class Read>
void read_loose_start(const Field& start, const Read& read, Certificate& certificate) {
  const auto pressed = start.find("pressed");
  if (!pressed) {
    certificate.start_z = read("z"), certificate.start_w = read("w");
    return;
  }
  certificate.pressed = pressed->side();
  if (!certificate.scene.loose->walls[index_of(*certificate.pressed)])
    pressed->refuse("is a wall that isn't there", "give the housing that wall, or z and w in place of pressed");
}

void read_start(const Field& start, Certificate& certificate) {
  certificate.start_time = start.get("time").number();
  const auto read = [&](const char* name) {
    const Field field = start.get(name);
    return certificate.periodic ? field.claimed() : Claimed{field.number(), Number()};
  };
  if (const auto released = start.find("released")) {
    if (certificate.scene.loose) released->refuse("is given beside a loose mass", "give x and v");
    certificate.released = released->side();
    if (!certificate.scene.has_force()) released->refuse("needs a force", "give x and v");
    return;
  }
  certificate.start_x = read("x"), certificate.start_v = read("v");
  if (certificate.scene.loose) read_loose_start(start, read, certificate);
}

void read_end(const Field& end, Certificate& certificate) {
  certificate.end = {end.get("time").number(), end.get("x").claimed(), end.get("v").claimed(), {}, {}};
  if (certificate.scene.loose) certificate.end->z = end.get("z").claimed(), certificate.end->w = end.get("w").claimed();
  if (!(certificate.end->time > certificate.start_time)) end.refuse("is not after the start", "give a later time");
}

/// What the members for people say, and their names.
void read_for_people(const Field& root, Certificate& certificate) {
  std::string& place = certificate.place;
  for (const char* const member : {"name", "point", "special", "branch", "at", "machine"}) {
    const auto found = root.find_for_people(member);
    if (!found) continue;
    certificate.for_people.emplace_back(member);
    if (*member == 'b' || *member == 'm') continue;
    const std::string text = found->dump();  // without control characters
    if (!place.empty()) place += ' ';
    if (*member == 'p' || *member == 's') place.append(member).append(" ");
    place += *member == 'n' && text.size() > 1 ? text.substr(1, text.size() - 2) : text;
  }
  if (!certificate.special) return;
  if (certificate.values_of_parameter().empty()) certificate.for_people.emplace_back("parameter");
  if (certificate.special->slopes.phase != Number()) certificate.for_people.emplace_back("slopes.phase");
}

}  // namespace

const char* name_of(SpecialKind kind) {
  static constexpr const char* names[] = {
      "fold", "flip", "symmetry breaking", "graze", "maximum impact_speed", "maximum impact_power"};
  return names[static_cast<std::size_t>(kind)];
}

std::optional<ListLine> read_list_line(const std::string& line) {
  constexpr const char* format = "clatter-certificates-1";
  if (line.size() > 200 || line.find(format) == std::string::npos) return std::nullopt;
  const Json json = json_of(line);
  ReadValues read;
  const Field root(json, "", read);
  if (!json.is_object() || !json.contains("format") || root.get("format").text() != format) return std::nullopt;
  const Field certificates = root.get("certificates");
  ListLine found{json["certificates"] == "begin", 0};
  if (!found.begins) found.certificates = static_cast<std::size_t>(certificates.count(0, 1'000'000'000'000));
  root.require_all_read();
  return found;
}

Certificate read_certificate(const std::string& line) {
  const Json json = json_of(line);
  if (!json.is_object()) throw FormatError("the line is no JSON object; write {...}");
  ReadValues read;
  const Field root(json, "", read);
  const Field format = root.get("format");
  if (format.text() != "clatter-certificate-1") format.refuse("is another one", "write \"clatter-certificate-1\"");
  Certificate certificate;
  certificate.scene = scene_of(root.get("scene"));
  const Field claim = root.get("claim");
  const std::string kind = claim.text();
  if (kind != "periodic" && kind != "transient" && kind != "special")
    claim.refuse("is " + shown(kind), "write transient, periodic or special");
  certificate.periodic = kind != "transient";
  if (kind == "special" && certificate.scene.loose)
    claim.refuse("is special beside a loose mass", "claim transient or periodic motion");
  if (kind == "special")
    for (const auto& stop : certificate.scene.stops)
      if (stop && stop->law)
        claim.refuse("is special with a restitution that depends on the speed", "claim transient or periodic motion");
  if (kind == "special") certificate.special = special_of(root, certificate.scene);
  if (certificate.periodic) read_periodic(root, certificate);
  read_start(root.get("start"), certificate);
  const Field events = root.get("events");
  for (const Field& event : events.items()) certificate.events.push_back(event_of(event, certificate.scene));
  require_events(events, certificate);
  if (const auto x = root.find("x_min")) certificate.x_min = x->claimed();
  if (const auto x = root.find("x_max")) certificate.x_max = x->claimed();
  if (!certificate.periodic) read_end(root.get("end"), certificate);
  read_for_people(root, certificate);
  root.require_all_read();
  return certificate;
}

}  // namespace verify
