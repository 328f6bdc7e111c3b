#include "branches/equations/equations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "branches/equations/housing_links.hpp"
#include "branches/equations/links.hpp"

namespace clatter::branches {

using namespace clatter::branches::detail;

namespace {

using Linearised = OrbitEquations::Linearised;

/// Whether a scene has a positive frequency and stops, or walls, in the right order, and its events follow each other.
bool is_possible(const FollowedScene& scene, const Orbit& orbit) {
  if (!(scene.oscillator.frequency > 0) || !(scene.stops.lower < scene.stops.upper)) return false;
  if (has_loose_mass(scene.loose) && !(scene.loose.lower < scene.loose.upper)) return false;
  const SceneNumbers<double> p = numbers_of<double>(scene);
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (!flight_of<double>(orbit, i).may_vanish(p) && !(orbit.event(i).phase < orbit.event(i + 1).phase)) return false;
  return true;
}

/// Adds the two equations of flight i: at its end it is at the place of the next event, with the coordinate of that.
void add_flight(const OrbitEquations& of, const Orbit& orbit, std::size_t i, const FlightEnd<First>& end,
                Linearised& out) {
  const std::size_t row = 2 * i, next = i + 1 == orbit.size() ? 0 : 2 * (i + 1);
  out.residual[row] = end.beyond.value;
  out.residual[row + 1] = end.coordinate.value - orbit.event(i + 1).coordinate();
  for (const auto& [equation, slope] : {std::pair(row, &end.beyond.slope), std::pair(row + 1, &end.coordinate.slope)}) {
    out.slope(equation, 2 * i) += (*slope)[by_begin];
    out.slope(equation, 2 * i + 1) += (*slope)[by_before] * of.speed_unit();
    out.slope(equation, next) += (*slope)[by_end];
    for (std::size_t k = 0; k < of.axes().size(); ++k)
      out.slope(equation, of.first_axis() + k) += (*slope)[by_first_axis + k] * of.axes()[k].unit;
  }
  out.slope(row + 1, next + 1) -= (orbit.ends_mirrored(i) ? -1 : 1) * of.speed_unit();
}
/// False if a flight is none.
bool add_flights(const OrbitEquations& of, const FollowedScene& scene, const Orbit& orbit, Linearised& out) {
  const auto fly_all = [&]<Effects E>() {
    const Flights<First, E> flights(numbers_along<First>(scene, of.axes()));
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      Flight<First> flight = flight_of<First>(orbit, i);
      flight.from_crest = of.is_released_at_crest(i);
      if (flight.leaves == Event::Kind::stick && !(flights.start(flight) < flight.end)) return false;
      add_flight(of, orbit, i, flights.fly(flight), out);
    }
    return true;
  };
  return with_arcs(scene, fly_all, of.stiffness_varies());
}

/// The rate of a soft stop's force, over its stiffness, at an event on it.
First rate_of_force(const SceneNumbers<First>& p, const OrbitEvent& event) {
  const First phase(event.phase, by_begin), v(event.before, by_before);
  const First relaxation = p.soft_stop(event.side).relaxation();
  const First a = p.force_at(phase).value + p.oscillator.load - 2 * p.oscillator.damping * v -
                  p.oscillator.stiffness * (p.position(event.side) - relaxation * v) -
                  sign_of(event.heading()) * p.friction.kinetic;
  return v + relaxation * a;
}
/// The force on a mass at rest on a stop.
First force_on_stop(const SceneNumbers<First>& p, const OrbitEvent& event) {
  return p.force_at(First(event.phase, by_begin)).value + p.oscillator.load -
         p.oscillator.stiffness * p.position(event.side);
}
/// Of a halt the distance from a stop, or what the force lacks of a level of friction.
First left_at_halt(const SceneNumbers<First>& p, const OrbitEvent& halt, const Condition& condition) {
  const First x = p.middle() + First(halt.place, by_before);
  const double sign = sign_of(condition.side);
  if (condition.kind == Condition::Kind::on_stop) return x - p.position(condition.side) - sign * condition.amount;
  const First level = condition.kind == Condition::Kind::kinetic ? p.friction.kinetic : p.friction.static_level,
              left = level - sign * p.standing_force(x, halt.held_by());
  if (condition.kind != Condition::Kind::tangency) return left - sign * p.force_at(First(halt.phase, by_begin)).value;
  if (!p.oscillator.shape.has_orders()) return left - abs(p.force().amplitude);
  const PushOfOrders<First> push(p.oscillator.forcing, p.oscillator.shape.orders, condition.side);
  return left - push.crest_height(halt.phase, left.value);
}
/// The number that a condition on one event makes 0.
First left_of(const SceneNumbers<First>& p, const OrbitEvent& event, const Condition& condition) {
  if (condition.kind == Condition::Kind::force) return rate_of_force(p, event);
  if (condition.kind == Condition::Kind::release) return force_on_stop(p, event);
  return left_at_halt(p, event, condition);
}

void add_condition_on_event(const OrbitEquations& of, const FollowedScene& scene, const Orbit& orbit,
                            const Condition& condition, std::size_t row, Linearised& out) {
  const First left = left_of(numbers_along<First>(scene, of.axes()), orbit.events[condition.event], condition);
  const std::size_t phase = of.phase_of(condition.event);
  out.residual[row] = left.value;
  out.slope(row, phase) = left.slope[by_begin];
  out.slope(row, phase + 1) = left.slope[by_before] * of.speed_unit();
  for (std::size_t k = 0; k < of.axes().size(); ++k)
    out.slope(row, of.first_axis() + k) = left.slope[by_first_axis + k] * of.axes()[k].unit;
}
void add_graze(const OrbitEquations& of, const Orbit& orbit, std::size_t event, std::size_t row, Linearised& out) {
  out.residual[row] = orbit.events[event].before;
  out.slope(row, of.phase_of(event) + 1) = of.speed_unit();
}
void add_duration(const OrbitEquations& of, const Orbit& orbit, const Condition& condition, std::size_t row,
                  Linearised& out) {
  const std::size_t i = condition.event, next = (i + 1) % orbit.size();
  out.residual[row] = orbit.event(i + 1).phase - orbit.event(i).phase - condition.amount;
  out.slope(row, of.phase_of(i)) -= 1;
  out.slope(row, of.phase_of(next)) += 1;
}

}  // namespace

OrbitEquations::OrbitEquations(const FollowedScene& scene, const Orbit& shape, std::vector<Axis> axes,
                               double speed_unit, std::vector<Condition> conditions)
    : scene_(scene),
      shape_(shape),
      axes_(std::move(axes)),
      speed_unit_(speed_unit),
      conditions_(std::move(conditions)),
      stiffness_varies_(
          std::ranges::any_of(axes_, [&](const Axis& axis) { return varies_stiffness(scene, axis.parameter); })),
      is_in_housing_(has_loose_mass(scene.loose)),
      per_event_(is_in_housing_ ? of_event : 2) {}

std::optional<std::size_t> OrbitEquations::grazing() const {
  for (const Condition& condition : conditions_)
    if (condition.kind == Condition::Kind::graze || condition.kind == Condition::Kind::force ||
        (condition.kind == Condition::Kind::on_stop && condition.amount == 0))
      return condition.event;
  return std::nullopt;
}

bool OrbitEquations::grazes_outside() const {
  return std::ranges::find(conditions_, Condition::Kind::graze, &Condition::kind) != conditions_.end();
}

bool OrbitEquations::is_released_at_crest(std::size_t halt) const {
  return std::ranges::any_of(conditions_, [&](const Condition& condition) {
    return condition.kind == Condition::Kind::tangency && condition.event == halt &&
           condition.side == shape_.events[halt].side;
  });
}

Vector OrbitEquations::unknowns_of(const FollowedScene& scene, const Orbit& orbit) const {
  Vector z(unknowns());
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitEvent& event = orbit.events[i];
    const std::size_t phase = phase_of(i);
    z[phase] = event.phase, z[phase + 1] = event.coordinate() / speed_unit_;
    if (is_in_housing_) z[phase + 2] = event.other.place / speed_unit_, z[phase + 3] = event.other.before / speed_unit_;
  }
  for (std::size_t k = 0; k < axes_.size(); ++k)
    z[first_axis() + k] = value_of(scene, axes_[k].parameter) / axes_[k].unit;
  return z;
}

Orbit OrbitEquations::orbit_at(const Vector& z) const {
  Orbit orbit = shape_;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    OrbitEvent& event = orbit.events[i];
    const std::size_t phase = phase_of(i);
    event.phase = z[phase], event.coordinate() = z[phase + 1] * speed_unit_;
    if (is_in_housing_) event.other = {z[phase + 2] * speed_unit_, z[phase + 3] * speed_unit_};
  }
  return orbit;
}

FollowedScene OrbitEquations::scene_at(const Vector& z) const {
  FollowedScene scene = scene_;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    scene = changed(scene, axes_[k].parameter, z[first_axis() + k] * axes_[k].unit);
  return scene;
}

std::optional<OrbitEquations::Linearised> OrbitEquations::at(const Vector& z) const {
  const FollowedScene scene = scene_at(z);
  const Orbit orbit = orbit_at(z);
  const bool is_finite = std::ranges::all_of(z, [](double number) { return std::isfinite(number); });
  if (!is_finite || !is_possible(scene, orbit) || (is_in_housing_ && !(scene.loose.ratio > 0))) return std::nullopt;
  Linearised out{Vector(equations(), 0.0), Matrix(equations(), unknowns())};
  if (is_in_housing_)
    add_flights_in_housing(scene, orbit, out);
  else if (!add_flights(*this, scene, orbit, out))
    return std::nullopt;
  std::size_t row = first_axis();
  for (const Condition& condition : conditions_)
    if (condition.kind == Condition::Kind::unit_product)
      add_unit_product(z, row++, out);
    else
      add_condition(scene, orbit, condition, row++, out);
  return out;
}

void OrbitEquations::add_condition(const FollowedScene& scene, const Orbit& orbit, const Condition& condition,
                                   std::size_t row, Linearised& out) const {
  using Kind = Condition::Kind;
  if (condition.kind == Kind::graze) return add_graze(*this, orbit, condition.event, row, out);
  if (condition.kind == Kind::duration) return add_duration(*this, orbit, condition, row, out);
  if (condition.kind == Kind::force || condition.kind == Kind::release || condition.is_of_halt())
    return add_condition_on_event(*this, scene, orbit, condition, row, out);
  if (is_in_housing_) return add_multiplier_in_housing(scene, orbit, condition, row, out);
  add_multiplier(scene, orbit, condition, row, out);
}

}  // namespace clatter::branches
