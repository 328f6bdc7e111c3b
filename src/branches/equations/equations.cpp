#include "branches/equations/equations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "branches/equations/housing_links.hpp"
#include "branches/equations/links.hpp"

namespace clatter::branches {

using namespace clatter::branches::detail;

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
      per_event_(is_in_housing_ ? of_wall_impact : 2) {}

std::optional<std::size_t> OrbitEquations::grazing() const {
  for (const Condition& condition : conditions_)
    if (condition.kind == Condition::Kind::graze || condition.kind == Condition::Kind::force) return condition.impact;
  return std::nullopt;
}

bool OrbitEquations::grazes_outside() const {
  return std::ranges::find(conditions_, Condition::Kind::graze, &Condition::kind) != conditions_.end();
}

bool OrbitEquations::is_released_at_crest(std::size_t halt) const {
  return std::ranges::any_of(conditions_, [&](const Condition& condition) {
    return condition.kind == Condition::Kind::tangency && condition.impact == halt &&
           condition.side == shape_.impacts[halt].side;
  });
}

Vector OrbitEquations::unknowns_of(const FollowedScene& scene, const Orbit& orbit) const {
  Vector z(unknowns());
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitImpact& impact = orbit.impacts[i];
    const std::size_t phase = phase_of(i);
    z[phase] = impact.phase, z[phase + 1] = impact.coordinate() / speed_unit_;
    if (is_in_housing_) z[phase + 2] = impact.place / speed_unit_, z[phase + 3] = impact.main / speed_unit_;
  }
  for (std::size_t k = 0; k < axes_.size(); ++k)
    z[first_axis() + k] = value_of(scene, axes_[k].parameter) / axes_[k].unit;
  return z;
}

Orbit OrbitEquations::orbit_at(const Vector& z) const {
  Orbit orbit = shape_;
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    OrbitImpact& impact = orbit.impacts[i];
    const std::size_t phase = phase_of(i);
    impact.phase = z[phase], impact.coordinate() = z[phase + 1] * speed_unit_;
    if (is_in_housing_) impact.place = z[phase + 2] * speed_unit_, impact.main = z[phase + 3] * speed_unit_;
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
  if (!(scene.oscillator.frequency > 0) || !(scene.stops.lower < scene.stops.upper)) return std::nullopt;
  if (is_in_housing_ && !(scene.loose.ratio > 0 && scene.loose.lower < scene.loose.upper)) return std::nullopt;
  for (const double number : z)
    if (!std::isfinite(number)) return std::nullopt;
  const SceneNumbers<double> p = numbers_of<double>(scene);
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (!flight_of<double>(orbit, i).may_vanish(p) && !(orbit.impact(i).phase < orbit.impact(i + 1).phase))
      return std::nullopt;
  Linearised out{Vector(equations(), 0.0), Matrix(equations(), unknowns())};
  const auto add_flights = [&]<Effects E>() {
    const Flights<First, E> flights(numbers_along<First>(scene, axes_));
    const std::size_t count = orbit.size();
    for (std::size_t i = 0; i < count; ++i) {
      Flight<First> flight = flight_of<First>(orbit, i);
      flight.from_crest = is_released_at_crest(i);
      if (flight.leaves == EventKind::stick && !(flights.start(flight) < flight.end)) return false;
      const FlightEnd<First> end = flights.fly(flight);
      const bool closes = i + 1 == count;
      const std::size_t row = 2 * i, next = closes ? 0 : 2 * (i + 1);
      const double sign = orbit.ends_mirrored(i) ? -1 : 1;
      out.residual[row] = end.beyond.value;
      out.residual[row + 1] = end.coordinate.value - orbit.impact(i + 1).coordinate();
      for (const auto& [equation, slope] :
           {std::pair(row, &end.beyond.slope), std::pair(row + 1, &end.coordinate.slope)}) {
        out.slope(equation, 2 * i) += (*slope)[by_begin];
        out.slope(equation, 2 * i + 1) += (*slope)[by_before] * speed_unit_;
        out.slope(equation, next) += (*slope)[by_end];
        for (std::size_t k = 0; k < axes_.size(); ++k)
          out.slope(equation, 2 * count + k) += (*slope)[by_first_axis + k] * axes_[k].unit;
      }
      out.slope(row + 1, next + 1) -= sign * speed_unit_;
    }
    return true;
  };
  if (is_in_housing_)
    add_flights_in_housing(scene, orbit, out);
  else if (!with_arcs(scene, add_flights, stiffness_varies_))
    return std::nullopt;
  std::size_t row = first_axis();
  for (const Condition& condition : conditions_) {
    if (condition.kind == Condition::Kind::graze)
      add_graze(orbit, condition.impact, row, out);
    else if (condition.kind == Condition::Kind::force)
      add_force(scene, orbit.impacts[condition.impact], 2 * condition.impact, row, out);
    else if (condition.kind == Condition::Kind::duration)
      add_duration(orbit, condition, row, out);
    else if (condition.kind == Condition::Kind::release)
      add_release(scene, orbit.impacts[condition.impact], 2 * condition.impact, row, out);
    else if (condition.is_of_halt())
      add_halt(scene, orbit.impacts[condition.impact], condition, row, out);
    else if (is_in_housing_)
      add_multiplier_in_housing(scene, orbit, condition, row, out);
    else
      add_multiplier(scene, orbit, condition, row, out);
    ++row;
  }
  return out;
}

void OrbitEquations::add_graze(const Orbit& orbit, std::size_t impact, std::size_t row, Linearised& out) const {
  out.residual[row] = orbit.impacts[impact].before;
  out.slope(row, phase_of(impact) + 1) = speed_unit_;
}

void OrbitEquations::add_force(const FollowedScene& scene, const OrbitImpact& event, std::size_t unknown,
                               std::size_t row, Linearised& out) const {
  const SceneNumbers<First> p = numbers_along<First>(scene, axes_);
  const First phase(event.phase, by_begin), v(event.before, by_before);
  const First relaxation = p.soft_stop(event.side).relaxation();
  const auto [f, lead] = p.force();
  const First a = f * sin(phase + lead) + p.oscillator.load - 2 * p.oscillator.damping * v -
                  p.oscillator.stiffness * (p.position(event.side) - relaxation * v);
  const First rate = v + relaxation * a;  // of the force over kappa
  out.residual[row] = rate.value;
  out.slope(row, unknown) = rate.slope[by_begin];
  out.slope(row, unknown + 1) = rate.slope[by_before] * speed_unit_;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, first_axis() + k) = rate.slope[by_first_axis + k] * axes_[k].unit;
}

void OrbitEquations::add_duration(const Orbit& orbit, const Condition& condition, std::size_t row,
                                  Linearised& out) const {
  const std::size_t i = condition.impact, next = (i + 1) % orbit.size();
  out.residual[row] = orbit.impact(i + 1).phase - orbit.impact(i).phase - condition.duration;
  out.slope(row, phase_of(i)) -= 1;
  out.slope(row, phase_of(next)) += 1;
}

void OrbitEquations::add_halt(const FollowedScene& scene, const OrbitImpact& halt, const Condition& condition,
                              std::size_t row, Linearised& out) const {
  const SceneNumbers<First> p = numbers_along<First>(scene, axes_);
  const First x = p.middle() + First(halt.place, by_before);
  const auto left_to_level = [&] {
    const auto [f, lead] = p.force();
    const double sign = sign_of(condition.side);
    const First level = condition.kind == Condition::Kind::kinetic ? p.friction.kinetic : p.friction.static_level,
                left = level - sign * (p.oscillator.load - p.oscillator.stiffness * x);
    if (condition.kind == Condition::Kind::tangency) return left - abs(f);
    return left - sign * f * sin(First(halt.phase, by_begin) + lead);
  };
  const First zero = condition.kind == Condition::Kind::on_stop ? x - p.position(condition.side) : left_to_level();
  const std::size_t unknown = 2 * condition.impact;
  out.residual[row] = zero.value;
  out.slope(row, unknown) = zero.slope[by_begin];
  out.slope(row, unknown + 1) = zero.slope[by_before] * speed_unit_;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, first_axis() + k) = zero.slope[by_first_axis + k] * axes_[k].unit;
}

void OrbitEquations::add_release(const FollowedScene& scene, const OrbitImpact& impact, std::size_t phase,
                                 std::size_t row, Linearised& out) const {
  const SceneNumbers<First> p = numbers_along<First>(scene, axes_);
  const auto [f, lead] = p.force();
  const First force = f * sin(First(impact.phase, by_begin) + lead) + p.oscillator.load -
                      p.oscillator.stiffness * p.position(impact.side);
  out.residual[row] = force.value;
  out.slope(row, phase) = force.slope[by_begin];
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, first_axis() + k) = force.slope[by_first_axis + k] * axes_[k].unit;
}

void OrbitEquations::add_multiplier(const FollowedScene& scene, const Orbit& all, const Condition& condition,
                                    std::size_t row, Linearised& out) const {
  const Orbit orbit = condition.without ? all.without(*condition.without) : all;
  const std::size_t count = orbit.size(), parameters = 2 * all.size();
  const auto unknown_of = [&](std::size_t impact) {
    return 2 * (impact + (condition.without && *condition.without <= impact));
  };
  std::vector<Link<First>> links;
  const auto add_links = [&]<Effects E>() {
    const Flights<Second, E> flights(numbers_along<Second>(scene, axes_));
    for (std::size_t i = 0; i < count; ++i) {
      const FlightEnd<Second> end = flights.fly(flight_of<Second>(orbit, i));
      links.push_back(
          link_of(end.beyond.slope, end.coordinate.slope, orbit.ends_mirrored(i), orbit.impact(i + 1).event));
    }
  };
  const SceneNumbers<First> p = numbers_along<First>(scene, axes_);
  if (orbit.meets_soft_stop())
    links = links_of_states(scene, orbit, p, stiffness_varies_);
  else
    with_arcs(scene, add_links, stiffness_varies_);
  // g = c (1 + D) - sigma tr(K_n ... K_1), c the product of the links' denominators
  const auto plain = [](const Link<First>& link) {
    Square<double> k;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) k[i][j] = link.numerator[i][j].value;
    return k;
  };
  const double sigma = condition.multiplier;
  const First determinant = determinant_of(p, orbit);
  std::vector<Square<double>> before{{{{1, 0}, {0, 1}}}}, after(count + 1, {{{1, 0}, {0, 1}}});
  std::vector<double> c_before{1}, c_after(count + 1, 1.0);
  for (std::size_t i = 0; i < count; ++i) {
    before.push_back(product(plain(links[i]), before[i]));
    c_before.push_back(c_before[i] * links[i].denominator.value);
  }
  for (std::size_t i = count; i-- > 0;) {
    after[i] = product(after[i + 1], plain(links[i]));
    c_after[i] = c_after[i + 1] * links[i].denominator.value;
  }
  out.residual[row] = c_before[count] * (1 + determinant.value) - sigma * (before[count][0][0] + before[count][1][1]);
  const auto add = [&](std::size_t i, std::size_t variable, std::size_t unknown, double unit) {
    double trace = 0;
    const Square<double> around = product(before[i], after[i + 1]);  // tr(A dK B) = tr(B A dK)
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t s = 0; s < 2; ++s) trace += around[s][r] * links[i].numerator[r][s].slope[variable];
    const double denominator = c_before[i] * c_after[i + 1] * links[i].denominator.slope[variable];
    out.slope(row, unknown) += unit * (denominator * (1 + determinant.value) - sigma * trace);
  };
  for (std::size_t i = 0; i < count; ++i) {
    add(i, by_begin, unknown_of(i), 1.0);
    add(i, by_before, unknown_of(i) + 1, speed_unit_);
    add(i, by_end, unknown_of(i + 1 == count ? 0 : i + 1), 1.0);
    for (std::size_t k = 0; k < axes_.size(); ++k) add(i, by_first_axis + k, parameters + k, axes_[k].unit);
  }
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, parameters + k) += axes_[k].unit * c_before[count] * determinant.slope[by_first_axis + k];
  for (std::size_t i = 0; i < count; ++i) {  // the accelerations at a reversal
    const OrbitImpact& halt = orbit.impacts[i];
    if (halt.event != EventKind::reversal) continue;
    Orbit others = orbit;
    others.impacts.erase(others.impacts.begin() + static_cast<std::ptrdiff_t>(i));
    const First factor = determinant_of(p, others) *
                         reversal_factor(p, halt.side, First(halt.phase, by_begin), First(halt.place, by_before));
    out.slope(row, unknown_of(i)) += c_before[count] * factor.slope[by_begin];
    out.slope(row, unknown_of(i) + 1) += c_before[count] * factor.slope[by_before] * speed_unit_;
  }
  for (std::size_t i = 0; i < count; ++i) {  // longer contacts with a soft stop take more
    if (!presses(orbit.impacts[i].event)) continue;
    const double longer = -2 * p.soft_stop(orbit.impacts[i].side).damping.value / p.oscillator.frequency.value *
                          c_before[count] * determinant.value;
    out.slope(row, unknown_of(i)) -= longer;
    out.slope(row, unknown_of(i + 1 == count ? 0 : i + 1)) += longer;
  }
}

}  // namespace clatter::branches
