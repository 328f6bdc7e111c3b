#include "scene_fields.hpp"

#include <algorithm>
#include <string>
#include <vector>

namespace verify {
namespace {

/// Knots of a restitution by speed, each [speed, R].
std::vector<Certificate::LawNumbers::Knot> knots_of(const Field& field) {
  std::vector<Certificate::LawNumbers::Knot> knots;
  for (const Field& item : field.items()) {
    const auto pair = item.items();
    if (pair.size() != 2) item.refuse("has " + std::to_string(pair.size()) + " items", "write [speed, R]");
    knots.push_back({pair[0].number_from(0, Field::infinity), pair[1].number_from(0, 1)});
    if (knots.size() > 1 && !(knots[knots.size() - 2].speed < knots.back().speed))
      pair[0].refuse("is no faster than the knot before", "give each speed once, in rising order");
  }
  if (knots.empty()) field.refuse("is empty", "write [[speed, R], ...]");
  return knots;
}

/// Restitution that depends on the speed of an impact.
Certificate::LawNumbers law_of(const Field& field) {
  Certificate::LawNumbers law;
  const auto R = field.find("R"), table = field.find("table"), exponent = field.find("exponent");
  if (R.has_value() == table.has_value())
    field.refuse(R ? "has R and table" : "has neither R nor table", "give one of them");
  if (R) law.R = R->number_from(0, 1);
  if (exponent) {
    if (table) exponent->refuse("is given beside a table", "leave one of them out");
    law.exponent = exponent->number_from(0, 1, false);
    if (*law.exponent == Number(1.0)) exponent->refuse("is 1", "it must be below 1");
    law.reference_speed = field.get("reference_speed").number_from(0, Field::infinity, false);
  }
  if (table) law.table = knots_of(*table);
  if (const auto unit = table ? field.find("unit") : std::nullopt)
    law.unit = unit->number_from(0, Field::infinity, false);
  if (const auto below = field.find("below")) law.below = below->number_from(0, Field::infinity);
  if (!table && !exponent && law.below == Number())
    field.refuse("doesn't depend on the speed", "give R alone in its place");
  return law;
}

std::optional<Certificate::StopNumbers> stop_of(const Field& scene, const char* name) {
  const auto field = scene.find(name);
  if (!field) return std::nullopt;
  Certificate::StopNumbers stop;
  stop.position = field->get("position").number();
  const auto R = field->find("R"), law = field->find("restitution"), stiffness = field->find("stiffness");
  if (R && law) field->refuse("has R and restitution", "give one of them");
  const bool is_rigid = R || law;
  if (is_rigid == stiffness.has_value())
    field->refuse(is_rigid ? std::string("has ") + (R ? "R" : "restitution") + " and stiffness"
                           : "has neither R, restitution nor stiffness",
                  "give one of them");
  stop.soft = stiffness.has_value();
  if (R) stop.R = R->number_from(0, 1);
  if (law) stop.law = law_of(*law);
  if (stiffness) stop.stiffness = stiffness->number_from(0, Field::infinity, false);
  if (stiffness) stop.damping = field->get("damping").number_from(0, Field::infinity);
  return stop;
}

/// The levels of dry friction of a scene, or of its loose mass.
template <class Numbers>
void read_friction(const Field& field, Numbers& numbers) {
  if (const auto friction = field.find("friction")) numbers.friction = friction->number_from(0, Field::infinity);
  numbers.friction_static = numbers.friction;
  const auto level = field.find("friction_static");
  if (!level) return;
  numbers.friction_static = level->number_from(0, Field::infinity);
  if (numbers.friction_static < numbers.friction)
    level->refuse("is below friction", "give the same or more, or leave it out");
}

/// The restitution of a wall, given by a field that may be of both.
void read_restitution(const Field& field, Certificate::LooseNumbers& loose, Side side) {
  const auto law = field.find("restitution");
  if (law && field.find("R")) field.refuse("has R and restitution", "give one of them");
  if (law)
    loose.laws[index_of(side)] = law_of(*law);
  else
    loose.R[index_of(side)] = field.get("R").number_from(0, 1);
}

/// A loose mass and the walls of its housing.
Certificate::LooseNumbers loose_of(const Field& field) {
  Certificate::LooseNumbers loose{
      field.get("mass").number_from(0, Field::infinity, false), {}, field.get("load").number(), {}};
  const bool of_both = field.find("R") || field.find("restitution");
  for (const Side side : {Side::lower, Side::upper}) {
    const auto wall = field.find(name_of(side));
    if (of_both) read_restitution(field, loose, side);
    if (!wall) continue;
    loose.walls[index_of(side)] = wall->get("position").number();
    for (const char* const name : {"R", "restitution"})
      if (const auto own = wall->find(name); own && of_both)
        own->refuse("is given beside that of both walls", "leave one of them out");
    if (!of_both) read_restitution(*wall, loose, side);
  }
  const auto& [lower, upper] = loose.walls;
  if (!lower && !upper) field.refuse("has no walls", "give lower, upper or both");
  read_friction(field, loose);
  if (lower && upper && !(*lower < *upper)) field.refuse("has its lower wall above the upper one", "exchange them");
  return loose;
}

}  // namespace

std::vector<Certificate::OrderNumbers> orders_of(const Field& field) {
  constexpr long most_order = 100;
  std::vector<Certificate::OrderNumbers> orders;
  for (const Field& item : field.items()) {
    const int number = static_cast<int>(item.get("order").count(1, most_order));
    const auto sine = item.find("sin"), cosine = item.find("cos");
    if (sine && number == 1) sine->refuse("of order 1 is f", "give f, and leave it out");
    if (!sine && !cosine) item.refuse("has neither sin nor cos", "give one of them, or both");
    if (std::ranges::find(orders, number, &Certificate::OrderNumbers::order) != orders.end())
      item.refuse("is of an order that was given", "give each order once");
    orders.push_back({number, sine ? sine->number() : Number(), cosine ? cosine->number() : Number()});
  }
  return orders;
}

Certificate::SceneNumbers scene_of(const Field& field) {
  Certificate::SceneNumbers scene{
      field.get("h").number_from(0, Field::infinity),         field.get("k").number(),    field.get("f").number(),
      field.get("nu").number_from(0, Field::infinity, false), field.get("load").number(), field.get("phase").number(),
      {stop_of(field, "lower"), stop_of(field, "upper")}};
  read_friction(field, scene);
  if (const auto orders = field.find("orders")) scene.orders = orders_of(*orders);
  if (scene.stops[0] && scene.stops[1] && !(scene.stops[0]->position < scene.stops[1]->position))
    field.refuse("has its lower stop above the upper one", "exchange them");
  if (const auto loose = field.find("loose")) scene.loose = loose_of(*loose);
  return scene;
}

}  // namespace verify
