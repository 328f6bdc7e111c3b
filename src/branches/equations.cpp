#include "branches/equations.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "math/dual.hpp"

namespace clatter::branches {
namespace {

using sweep::Parameter;

/// Derivatives by phase and velocity at the beginning of a flight, by the phase at its end, and by two parameters.
constexpr std::size_t by_begin = 0, by_before = 1, by_end = 2, by_first_axis = 3, most_variables = 5;
using First = Dual<double, most_variables>;
using Second = Dual<First, 3>;  // of the first three, each with its derivatives by all of them

/// Makes a parameter a variable.
template <class Number>
void vary(Parameters<Number>& p, Parameter parameter, std::size_t variable) {
  const auto seed = [variable](Number& number, double slope) {
    if constexpr (std::is_same_v<Number, Second>)
      number.value.slope[variable] = slope;
    else
      number.slope[variable] = slope;
  };
  switch (parameter) {
    case Parameter::h:
      return seed(p.h, 1);
    case Parameter::f:
      return seed(p.f, 1);
    case Parameter::nu:
      return seed(p.nu, 1);
    case Parameter::load:
      return seed(p.load, 1);
    case Parameter::stiffness:
      return seed(p.k, 1);
    case Parameter::stop_amplitude:
      return seed(p.stop_amplitude, 1);
    case Parameter::base_amplitude:
      return seed(p.base_amplitude, 1);
    case Parameter::stop_lower:
      return seed(p.lower, 1);
    case Parameter::stop_upper:
      return seed(p.upper, 1);
    case Parameter::R_lower:
      return seed(p.R_lower, 1);
    case Parameter::R_upper:
      return seed(p.R_upper, 1);
    case Parameter::R:
      return seed(p.R_lower, 1), seed(p.R_upper, 1);
    case Parameter::stop_stiffness_lower:
      return seed(p.kappa_lower, 1);
    case Parameter::stop_stiffness_upper:
      return seed(p.kappa_upper, 1);
    case Parameter::stop_stiffness:
      return seed(p.kappa_lower, 1), seed(p.kappa_upper, 1);
    case Parameter::stop_damping_lower:
      return seed(p.zeta_lower, 1);
    case Parameter::stop_damping_upper:
      return seed(p.zeta_upper, 1);
    case Parameter::stop_damping:
      return seed(p.zeta_lower, 1), seed(p.zeta_upper, 1);
    default:
      return seed(p.lower, -1), seed(p.upper, 1);  // xs
  }
}

/// The variable that a flight's first three derivatives belong to.
Second variable(double value, std::size_t index) {
  Second number(First(value, index), index);
  return number;
}

template <class Number>
Flight<Number> flight_of(const Orbit& orbit, std::size_t i) {
  const OrbitImpact from = orbit.impact(i), to = orbit.impact(i + 1);
  if constexpr (std::is_same_v<Number, Second>)
    return {from.side, variable(from.phase, by_begin), variable(from.before, by_before),
            to.side,   variable(to.phase, by_end),     from.event,
            to.event};
  else if constexpr (std::is_same_v<Number, double>)
    return {from.side, from.phase, from.before, to.side, to.phase, from.event, to.event};
  else
    return {from.side, Number(from.phase, by_begin), Number(from.before, by_before),
            to.side,   Number(to.phase, by_end),     from.event,
            to.event};
}

template <class Number>
Parameters<Number> parameters_of(const ShakenScene& scene, const std::vector<OrbitEquations::Axis>& axes) {
  Parameters<Number> p(scene);
  for (std::size_t k = 0; k < axes.size(); ++k) vary(p, axes[k].parameter, by_first_axis + k);
  return p;
}

/// Whether a parameter is one of those that vary.
bool varies(const std::vector<OrbitEquations::Axis>& axes, Parameter parameter) {
  return std::ranges::find(axes, parameter, &OrbitEquations::Axis::parameter) != axes.end();
}

template <class Number>
using Square = std::array<std::array<Number, 2>, 2>;

template <class A, class B>
auto product(const Square<A>& a, const Square<B>& b) {
  Square<decltype(a[0][0] * b[0][0])> c;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) c[i][j] = a[i][0] * b[0][j] + a[i][1] * b[1][j];
  return c;
}

/// One flight's derivative of the next impact by the last, times the denominator.
template <class Number>
struct Link {
  Square<Number> numerator;
  Number denominator;
};

/// From derivatives of gap and velocity by the beginning's phase and velocity and by the end's phase. The mirrored
/// orbit's last flight ends in the mirror image of its first impact.
template <class Number>
Link<Number> link_of(const std::array<Number, 3>& x, const std::array<Number, 3>& v, bool mirrored) {
  Link<Number> link{{{{-x[0], -x[1]}, {x[2] * v[0] - v[2] * x[0], x[2] * v[1] - v[2] * x[1]}}}, x[2]};
  if (mirrored) link.numerator[1] = {-link.numerator[1][0], -link.numerator[1][1]};
  return link;
}

bool last_is_mirrored(const Orbit& orbit, std::size_t i) { return orbit.mirrored && i + 1 == orbit.size(); }

template <class Number>
std::vector<Link<double>> links_of(const ShakenScene& scene, const Orbit& orbit) {
  return with_arcs(scene, [&]<Effects E>() {
    const Flights<Number, E> flights{Parameters<Number>(scene)};
    std::vector<Link<double>> links;
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const FlightEnd<Number> end = flights.fly(flight_of<Number>(orbit, i));
      links.push_back(link_of(end.beyond.slope, end.velocity.slope, last_is_mirrored(orbit, i)));
    }
    return links;
  });
}

/// The derivative of a flight's end by the state before the event that it begins with (eqs. 7, 27 and 53), times the
/// speed before a rigid impact.
template <class Number, Effects E>
Link<Number> link_of_states(const Flights<Number, E>& flights, const Flight<Number>& flight, bool mirrored) {
  const Parameters<Number>& p = flights.parameters();
  Link<Number> link{{{{Number(1), Number(0)}, {Number(0), Number(1)}}}, Number(1)};
  if (flight.leaves == Event::impact) {
    const Number &R = p.restitution(flight.from), &v = flight.before;
    const Number force = flights.force_at(p.position(flight.from), flight.begin);
    link.numerator = {{{-R * v, Number(0)}, {R * (force - 2 * p.h * v) + force + 2 * p.h * R * v, -R * v}}};
    link.denominator = v;
  } else if (flight.leaves == Event::touch) {
    link.numerator[1][0] = -2 * p.soft_stop(flight.from).damping;
  }
  const Number time = (flight.end - flight.begin) / p.nu;
  flights.with_constants(presses(flight.leaves) ? flight.from : Side::none, [&](const auto& constants) {
    const motion::Propagator<Number> free = constants.propagator(time);
    const Number sign = mirrored ? -1 : 1;
    const Square<Number> flown{{{sign * free.a, sign * free.b}, {-sign * constants.spring(free.b), sign * free.c}}};
    link.numerator = product(flown, link.numerator);
  });
  return link;
}

template <class Number>
std::vector<Link<Number>> links_of_states(const ShakenScene& scene, const Orbit& orbit, const Parameters<Number>& p,
                                          bool stiffness_varies) {
  std::vector<Link<Number>> links;
  with_arcs(
      scene,
      [&]<Effects E>() {
        const Flights<Number, E> flights(p);
        for (std::size_t i = 0; i < orbit.size(); ++i)
          links.push_back(link_of_states(flights, flight_of<Number>(orbit, i), last_is_mirrored(orbit, i)));
      },
      stiffness_varies);
  return links;
}

/// R^(2n) e^(-2 h T) of the impacts of an orbit as it is kept, less by e^(-2 h_s t) in a contact with a soft stop.
template <class Number>
Number determinant_of(const Parameters<Number>& p, const Orbit& orbit) {
  using std::exp;
  Number determinant = exp(Number(-2) * p.h * (Number(orbit.advance()) / p.nu));
  const auto press = [&](Side side, double advance) {
    determinant *= exp(Number(-2) * p.soft_stop(side).damping * (Number(advance) / p.nu));
  };
  if (orbit.pressed != Side::none) press(orbit.pressed, orbit.advance());
  for (std::size_t i = 0; i < orbit.size(); ++i) {
    const OrbitImpact& impact = orbit.impacts[i];
    if (impact.event == Event::impact) determinant *= p.restitution(impact.side) * p.restitution(impact.side);
    if (presses(impact.event)) press(impact.side, orbit.impact(i + 1).phase - impact.phase);
  }
  return determinant;
}

ImpactMap map_of(const std::vector<Link<double>>& links, double determinant) {
  ImpactMap map{.determinant = determinant};
  Square<double> matrix{{{1, 0}, {0, 1}}};
  for (const Link<double>& link : links)
    matrix = product(link.numerator, matrix), map.denominator *= link.denominator;
  for (std::size_t i = 0; i < 2; ++i)
    for (std::size_t j = 0; j < 2; ++j) map.numerator[i][j] = matrix[i][j];
  return map;
}

}  // namespace

OrbitEquations::OrbitEquations(const ShakenScene& scene, const Orbit& shape, std::vector<Axis> axes, double speed_unit,
                               std::vector<Condition> conditions)
    : scene_(scene),
      shape_(shape),
      axes_(std::move(axes)),
      speed_unit_(speed_unit),
      conditions_(std::move(conditions)) {}

std::optional<std::size_t> OrbitEquations::grazing() const {
  for (const Condition& condition : conditions_)
    if (condition.kind == Condition::Kind::graze || condition.kind == Condition::Kind::force) return condition.impact;
  return std::nullopt;
}

Vector OrbitEquations::unknowns_of(const ShakenScene& scene, const Orbit& orbit) const {
  Vector z(unknowns());
  for (std::size_t i = 0; i < orbit.size(); ++i)
    z[2 * i] = orbit.impacts[i].phase, z[2 * i + 1] = orbit.impacts[i].before / speed_unit_;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    z[2 * orbit.size() + k] = value_of(scene, axes_[k].parameter) / axes_[k].unit;
  return z;
}

Orbit OrbitEquations::orbit_at(const Vector& z) const {
  Orbit orbit = shape_;
  for (std::size_t i = 0; i < orbit.size(); ++i)
    orbit.impacts[i].phase = z[2 * i], orbit.impacts[i].before = z[2 * i + 1] * speed_unit_;
  return orbit;
}

ShakenScene OrbitEquations::scene_at(const Vector& z) const {
  ShakenScene scene = scene_;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    scene = changed(scene, axes_[k].parameter, z[2 * shape_.size() + k] * axes_[k].unit);
  return scene;
}

std::optional<OrbitEquations::Linearised> OrbitEquations::at(const Vector& z) const {
  const ShakenScene scene = scene_at(z);
  const Orbit orbit = orbit_at(z);
  if (!(scene.oscillator.frequency > 0) || !(scene.stops.lower < scene.stops.upper)) return std::nullopt;
  for (const double number : z)
    if (!std::isfinite(number)) return std::nullopt;
  for (std::size_t i = 0; i < orbit.size(); ++i)
    if (!flight_of<double>(orbit, i).may_vanish() && !(orbit.impact(i).phase < orbit.impact(i + 1).phase))
      return std::nullopt;
  Linearised out{Vector(equations(), 0.0), Matrix(equations(), unknowns())};
  const auto add_flights = [&]<Effects E>() {
    const Flights<First, E> flights(parameters_of<First>(scene, axes_));
    const std::size_t count = orbit.size();
    for (std::size_t i = 0; i < count; ++i) {
      const FlightEnd<First> end = flights.fly(flight_of<First>(orbit, i));
      const bool closes = i + 1 == count;
      const std::size_t row = 2 * i, next = closes ? 0 : 2 * (i + 1);
      const double sign = last_is_mirrored(orbit, i) ? -1 : 1;
      out.residual[row] = end.beyond.value;
      out.residual[row + 1] = end.velocity.value - orbit.impact(i + 1).before;
      for (const auto& [equation, slope] :
           {std::pair(row, &end.beyond.slope), std::pair(row + 1, &end.velocity.slope)}) {
        out.slope(equation, 2 * i) += (*slope)[by_begin];
        out.slope(equation, 2 * i + 1) += (*slope)[by_before] * speed_unit_;
        out.slope(equation, next) += (*slope)[by_end];
        for (std::size_t k = 0; k < axes_.size(); ++k)
          out.slope(equation, 2 * count + k) += (*slope)[by_first_axis + k] * axes_[k].unit;
      }
      out.slope(row + 1, next + 1) -= sign * speed_unit_;
    }
  };
  with_arcs(scene, add_flights, varies(axes_, Parameter::stiffness));
  std::size_t row = 2 * orbit.size();
  for (const Condition& condition : conditions_) {
    if (condition.kind == Condition::Kind::graze)
      add_graze(orbit, condition.impact, row, out);
    else if (condition.kind == Condition::Kind::force)
      add_force(scene, orbit.impacts[condition.impact], 2 * condition.impact, row, out);
    else if (condition.kind == Condition::Kind::duration)
      add_duration(orbit, condition, row, out);
    else if (condition.kind == Condition::Kind::release)
      add_release(scene, orbit.impacts[condition.impact], 2 * condition.impact, row, out);
    else
      add_multiplier(scene, orbit, condition, row, out);
    ++row;
  }
  return out;
}

void OrbitEquations::add_graze(const Orbit& orbit, std::size_t impact, std::size_t row, Linearised& out) const {
  out.residual[row] = orbit.impacts[impact].before;
  out.slope(row, 2 * impact + 1) = speed_unit_;
}

void OrbitEquations::add_force(const ShakenScene& scene, const OrbitImpact& event, std::size_t unknown,
                               std::size_t row, Linearised& out) const {
  const Parameters<First> p = parameters_of<First>(scene, axes_);
  const First phase(event.phase, by_begin), v(event.before, by_before);
  const First relaxation = p.soft_stop(event.side).relaxation();
  const auto [f, lead] = p.force();
  const First a = f * sin(phase + lead) + p.load - 2 * p.h * v - p.k * (p.position(event.side) - relaxation * v);
  const First rate = v + relaxation * a;  // of the force over kappa
  out.residual[row] = rate.value;
  out.slope(row, unknown) = rate.slope[by_begin];
  out.slope(row, unknown + 1) = rate.slope[by_before] * speed_unit_;
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, 2 * shape_.size() + k) = rate.slope[by_first_axis + k] * axes_[k].unit;
}

void OrbitEquations::add_duration(const Orbit& orbit, const Condition& condition, std::size_t row,
                                  Linearised& out) const {
  const std::size_t i = condition.impact, next = (i + 1) % orbit.size();
  out.residual[row] = orbit.impact(i + 1).phase - orbit.impact(i).phase - condition.duration;
  out.slope(row, 2 * i) -= 1;
  out.slope(row, 2 * next) += 1;
}

void OrbitEquations::add_release(const ShakenScene& scene, const OrbitImpact& impact, std::size_t phase,
                                 std::size_t row, Linearised& out) const {
  const Parameters<First> p = parameters_of<First>(scene, axes_);
  const auto [f, lead] = p.force();
  const First force = f * sin(First(impact.phase, by_begin) + lead) + p.load - p.k * p.position(impact.side);
  out.residual[row] = force.value;
  out.slope(row, phase) = force.slope[by_begin];
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, 2 * shape_.size() + k) = force.slope[by_first_axis + k] * axes_[k].unit;
}

void OrbitEquations::add_multiplier(const ShakenScene& scene, const Orbit& all, const Condition& condition,
                                    std::size_t row, Linearised& out) const {
  const Orbit orbit = condition.without ? all.without(*condition.without) : all;
  const std::size_t count = orbit.size(), parameters = 2 * all.size();
  const auto unknown_of = [&](std::size_t impact) {
    return 2 * (impact + (condition.without && *condition.without <= impact));
  };
  std::vector<Link<First>> links;
  const auto add_links = [&]<Effects E>() {
    const Flights<Second, E> flights(parameters_of<Second>(scene, axes_));
    for (std::size_t i = 0; i < count; ++i) {
      const FlightEnd<Second> end = flights.fly(flight_of<Second>(orbit, i));
      links.push_back(link_of(end.beyond.slope, end.velocity.slope, last_is_mirrored(orbit, i)));
    }
  };
  const Parameters<First> p = parameters_of<First>(scene, axes_);
  const bool stiffness_varies = varies(axes_, Parameter::stiffness);
  if (orbit.meets_soft_stop())
    links = links_of_states(scene, orbit, p, stiffness_varies);
  else
    with_arcs(scene, add_links, stiffness_varies);
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
  for (std::size_t i = 0; i < count; ++i) {  // longer contacts with a soft stop take more
    if (!presses(orbit.impacts[i].event)) continue;
    const double longer =
        -2 * p.soft_stop(orbit.impacts[i].side).damping.value / p.nu.value * c_before[count] * determinant.value;
    out.slope(row, unknown_of(i)) -= longer;
    out.slope(row, unknown_of(i + 1 == count ? 0 : i + 1)) += longer;
  }
}

ImpactMap impact_map(const ShakenScene& scene, const Orbit& orbit) {
  const Parameters<double> p(scene);
  if (orbit.size() == 0) {  // free motion around the response
    ImpactMap map{.determinant = determinant_of(p, orbit)};
    with_arcs(scene, [&]<Effects E>() {
      const Flights<double, E> flights{p};
      flights.with_constants(orbit.pressed, [&](const auto& constants) {
        const motion::Propagator<double> free = constants.propagator(orbit.advance() / constants.nu);
        const double sign = orbit.mirrored ? -1 : 1;
        map.numerator[0][0] = sign * free.a, map.numerator[0][1] = sign * free.b;
        map.numerator[1][0] = -sign * constants.spring(free.b), map.numerator[1][1] = sign * free.c;
      });
    });
    return map;
  }
  if (orbit.meets_soft_stop()) return map_of(links_of_states(scene, orbit, p, false), determinant_of(p, orbit));
  return event_map(scene, orbit);
}

ImpactMap event_map(const ShakenScene& scene, const Orbit& orbit) {
  return map_of(links_of<Dual<double, 3>>(scene, orbit), determinant_of(Parameters<double>(scene), orbit));
}

std::vector<std::array<double, 2>> spread(const ShakenScene& scene, const Orbit& orbit, std::array<double, 2> change) {
  std::vector<std::array<double, 2>> changes{change};
  for (const Link<double>& link : links_of<Dual<double, 3>>(scene, orbit)) {
    const auto& k = link.numerator;
    const auto& [a, b] = changes.back();
    changes.push_back({(k[0][0] * a + k[0][1] * b) / link.denominator, (k[1][0] * a + k[1][1] * b) / link.denominator});
  }
  changes.pop_back();
  return changes;
}

}  // namespace clatter::branches
