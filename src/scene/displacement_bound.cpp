#include "scene/displacement_bound.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "math/number.hpp"
#include "scene/effects.hpp"
#include "scene/response.hpp"

namespace clatter {
inline namespace scene {
namespace {

using Complex = std::complex<double>;

constexpr double rounding = 64 * std::numeric_limits<double>::epsilon();

/// lambda = (1 - h^2)^(1/2) of light damping.
double root_of(const Oscillator& oscillator) { return std::sqrt((1 - oscillator.damping) * (1 + oscillator.damping)); }

bool rotates_decaying(const Oscillator& oscillator) {
  return oscillator.stiffness == 1.0 && oscillator.damping > 0 && oscillator.damping < 1;
}

/// B of the transient Im(B e^{(-h + i lambda) t}), the T of eq. 19.
Complex rotation(const Oscillator& oscillator, const PhasePoint& transient) {
  return {(transient.v + oscillator.damping * transient.x) / root_of(oscillator), transient.x};
}

/// Bound of |R + B e^{(-h + i delta) t}| for all t >= 0 (eq. 19). In each part of the first turn the second term is at
/// most as long as at the beginning of the part; the modulus is convex in that length, so no more than with this length
/// or without the term; later turns repeat the angles with shorter lengths. `slack` bounds the relative error of delta
/// and the error of the angles. Infinite as soon as it exceeds `most`.
double beat_bound(const Complex& R, const Complex& B, double h, double delta, double most) {
  constexpr int parts = 48;
  constexpr double slack = 1e-4;
  const double scale = std::abs(R) + std::abs(B);  // divided out, so that squares neither overflow nor vanish
  const double steady = std::abs(R) / scale, whole = std::abs(B) / scale, part = 2 * std::acos(-1.0) / parts;
  const double decay = std::exp(-h * part / (std::abs(delta) * (1 + slack)));
  const Complex turn = std::polar(1.0, part), begin = std::polar(1.0, std::arg(B) - std::arg(R));
  Complex from = delta > 0 ? begin : std::conj(begin);
  double square = steady * steady, length = whole;
  const double most_square = (most / scale) * (most / scale);
  for (int i = 0; i < parts; ++i) {
    const Complex to = from * turn;
    const bool aligned = from.real() > 0 && from.imag() <= slack && to.imag() >= -slack;
    const double cosine = aligned ? 1.0 : std::max(from.real(), to.real()) + slack;
    square = std::max(square, steady * steady + length * length + 2 * steady * length * cosine);
    if (square > most_square) return std::numeric_limits<double>::infinity();
    from = to, length *= decay;
  }
  return (std::sqrt(square) + rounding) * scale;
}

/// From the load's equilibrium to the nearer stop.
double gap_of(const Oscillator& oscillator, const Stops& stops) {
  const double middle = equilibrium_of(oscillator);
  return std::min(middle - stops.lower, stops.upper - middle);
}

}  // namespace

namespace {

PhasePoint at_phase(const Response<double>& response, double nu, double sine, double cosine) {
  const auto [P, Q, amplitude] = response;
  if (amplitude == 0) return {0, 0};
  return {P * sine + Q * cosine, nu * (P * cosine - Q * sine)};
}

PhasePoint without(const PhasePoint& response, const PhaseState& now) {
  return {now.x - response.x, now.v - response.v};
}

}  // namespace

PhasePoint response_at(const Oscillator& oscillator, double sine, double cosine) {
  return at_phase(steady_response(oscillator), oscillator.frequency, sine, cosine);
}

PhasePoint transient_of(const Oscillator& oscillator, const PhaseState& now) {
  return without(response_at(oscillator, now.sine, now.cosine), now);
}

namespace {

bool has_other_spring(const Oscillator& oscillator) { return oscillator.stiffness > 0 && oscillator.stiffness != 1.0; }

/// The same velocities, and times, in units in which the stiffness is 1.
PhasePoint with_unit_spring(const Oscillator& oscillator, const PhasePoint& transient) {
  return {transient.x, transient.v / natural_frequency(oscillator)};
}
PhaseState with_unit_spring(const Oscillator& oscillator, const PhaseState& now) {
  return {now.x, now.v / natural_frequency(oscillator), now.sine, now.cosine};
}

/// Without a spring free motion goes on by v/(2h) at most; with an unstable one nothing bounds it.
double unsprung_transient_bound(const Oscillator& oscillator, const PhasePoint& transient) {
  if (oscillator.stiffness < 0 || oscillator.load != 0) return std::numeric_limits<double>::infinity();
  return std::abs(transient.x) + std::abs(transient.v) / (2 * oscillator.damping);
}

}  // namespace

double transient_bound(const Oscillator& oscillator, const PhasePoint& transient, double after) {
  if (has_other_spring(oscillator))
    return transient_bound(with_unit_spring(oscillator), with_unit_spring(oscillator, transient),
                           after * natural_frequency(oscillator));
  if (oscillator.stiffness <= 0) return unsprung_transient_bound(oscillator, transient);
  const double h = oscillator.damping, energy = norm(transient.x, transient.v);
  if (h == 0) return energy;
  if (rotates_decaying(oscillator))
    return std::min(energy, std::abs(rotation(oscillator, transient)) * std::exp(-h * after));
  // e^{-slow t} [x + (v + slow x) (1 - e^{-2 lambda t})/(2 lambda)], the last factor being at most t
  const double root = std::sqrt((h - 1) * (h + 1)), slow = 1 / (h + root), decay = std::exp(-slow * after);
  const double longest = std::max(after, 1 / slow);  // the t >= after at which t e^{-slow t} is greatest
  const double creep = std::min(longest * std::exp(-slow * longest), decay / (2 * root));
  return std::min(energy, decay * std::abs(transient.x) + std::abs(transient.v + slow * transient.x) * creep);
}

double fading_time(const Oscillator& oscillator, const PhasePoint& transient, double most) {
  if (has_other_spring(oscillator))
    return fading_time(with_unit_spring(oscillator), with_unit_spring(oscillator, transient), most) /
           natural_frequency(oscillator);
  if (oscillator.stiffness <= 0) return std::numeric_limits<double>::infinity();
  const double h = oscillator.damping;
  if (norm(transient.x, transient.v) <= most) return 0;
  if (h == 0) return std::numeric_limits<double>::infinity();
  if (rotates_decaying(oscillator))
    return std::max(0.0, std::log(std::abs(rotation(oscillator, transient)) / most) / h);
  // for t >= 1/slow the bound is e^{-slow t} (|x| + |v + slow x| min(t, 1/(2 lambda))): solved for the exponent's t
  const double root = std::sqrt((h - 1) * (h + 1)), slow = 1 / (h + root);
  const double begin = std::abs(transient.x), creep = std::abs(transient.v + slow * transient.x);
  double time = 1 / slow;
  for (int i = 0; i < 8; ++i)
    time = std::max(1.0, std::log((begin + creep * std::min(time, 1 / (2 * root))) / most)) / slow;
  return time;
}

double displacement_bound_through_impacts(const Oscillator& oscillator, const PhaseState& now, double duration) {
  const double rate = natural_frequency(oscillator);
  if (has_other_spring(oscillator))
    return displacement_bound_through_impacts(with_unit_spring(oscillator), with_unit_spring(oscillator, now),
                                              duration * rate);
  if (oscillator.stiffness <= 0) {  // eq. 47; the load pushes, too, if no spring balances it
    const double all = std::abs(oscillator.forcing) + (rate > 0 ? 0.0 : std::abs(oscillator.load));
    const double speed = std::abs(now.v) + rate * std::abs(now.x) + (all == 0 ? 0.0 : all * duration);
    const double way = speed == 0 ? 0.0 : speed * duration;
    const double bound = (std::abs(now.x) + way) * (rate > 0 ? std::exp(rate * duration) : 1.0) * (1 + rounding);
    return bound >= 0 && oscillator.damping >= 0 ? bound : std::numeric_limits<double>::infinity();
  }
  const double push = oscillator.forcing == 0 ? 0.0 : std::abs(oscillator.forcing) * duration;
  const double bound = (norm(now.x, now.v) + push) * (1 + rounding);
  return bound >= 0 && oscillator.damping >= 0 ? bound : std::numeric_limits<double>::infinity();
}

namespace {

/// By the responses to all orders of a force and the transient beside them.
double bound_under_orders(const Oscillator& oscillator, const PhaseState& now) {
  const auto& orders = oscillator.shape.orders;
  double responses = 0;
  PhasePoint transient{now.x, now.v};
  orders.each({now.sine, now.cosine}, [&](int j, double value, double slope) {
    const auto order = static_cast<std::size_t>(j);
    if (orders.is_zero(order)) return;
    const double nu = j * oscillator.frequency;
    const auto unit = response_to(oscillator.stiffness - nu * nu, oscillator.damping, oscillator.forcing, nu);
    responses += unit.amplitude * orders.size(order);
    transient.x -= unit.displacement(value, slope), transient.v -= unit.velocity(nu, value, slope);
  });
  return (responses + transient_bound(oscillator, transient)) * (1 + 2 * rounding);
}

}  // namespace

double displacement_bound(const Oscillator& oscillator, const PhaseState& now, double duration, double enough) {
  if (has_other_spring(oscillator))
    return displacement_bound(with_unit_spring(oscillator), with_unit_spring(oscillator, now),
                              duration * natural_frequency(oscillator), enough);
  if (!oscillator.shape.is_sine()) {
    const double bound = displacement_bound_through_impacts(oscillator, now, duration);
    const double other = oscillator.shape.has_orders() ? bound_under_orders(oscillator, now) : bound;
    return other < bound ? other : bound;  // a NaN is no improvement
  }
  const auto response = steady_response(oscillator);
  const PhasePoint transient = without(at_phase(response, oscillator.frequency, now.sine, now.cosine), now);
  double bound = std::numeric_limits<double>::infinity();
  if (!(oscillator.damping >= 0)) return bound;
  const auto improve = [&](double other) {
    if (other * (1 + rounding) < bound) bound = other * (1 + rounding);  // a NaN is no improvement
  };
  const auto improve_by_transient = [&](double most) {
    improve(response.amplitude + most + rounding * response.amplitude);
  };
  if (oscillator.stiffness == 1) improve_by_transient(norm(transient.x, transient.v));  // its energy: the cheapest
  if (bound < enough) return bound;
  improve_by_transient(transient_bound(oscillator, transient));
  if (bound < enough) return bound;
  improve(displacement_bound_through_impacts(oscillator, now, duration));
  if (bound < enough || !rotates_decaying(oscillator) || !(response.amplitude > 0)) return bound;
  const Complex theta(now.cosine, now.sine), R = Complex(response.in_phase, response.quadrature) * theta;
  const double h = oscillator.damping, detuning = (oscillator.frequency - 1) + h * h / (1 + root_of(oscillator));
  const double most = enough > 0 ? enough : std::numeric_limits<double>::infinity();
  if (std::abs(detuning) > 1e-10) improve(beat_bound(R, rotation(oscillator, transient), h, -detuning, most));
  return bound;
}

double friction_bound(const Oscillator& oscillator, const Friction& friction) {
  const double k = oscillator.stiffness, mu = friction.kinetic, h = oscillator.damping;
  if (mu == 0) return 0;
  if (!(k > 0) || !(h > 0)) return std::numeric_limits<double>::infinity();
  const double root = std::sqrt(k - h * h);
  const double swings = rotates(oscillator) ? 1 / std::tanh(pi<double>() * h / (2 * root)) : 1.0;
  return mu / k * swings * (1 + rounding);
}

bool response_meets(const Oscillator& oscillator, const Stops& stops) {
  if (!oscillator.shape.is_sine()) return true;  // it may
  const auto response = steady_response(oscillator);
  return !(response.amplitude < gap_of(oscillator, stops));
}

bool grows_at_resonance(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const double natural = natural_frequency(o);
  const auto resonates = [&](std::size_t order) {
    const double frequency = static_cast<double>(order) * o.frequency;
    return std::abs(frequency - natural) <= 4 * std::numeric_limits<double>::epsilon() * natural;
  };
  bool grows = o.shape.is_sine() && resonates(1);
  for (std::size_t j = 1; o.shape.has_orders() && j <= ForceOrders<double>::most; ++j)
    grows = grows || (!o.shape.orders.is_zero(j) && resonates(j));
  return grows && o.stiffness > 0 && o.damping == 0 && o.forcing != 0 && std::isinf(stops.lower) &&
         std::isinf(stops.upper);
}

namespace {

/// Whether undamped motion without stops grows for ever at resonance though friction brakes it (eq. 78): in each half
/// period the force adds pi |f|/2 to the part of the velocity that swings with it, and friction takes 2 mu at most. A
/// mass that doesn't stick any more, by its displacement wherever it turns back, or by a static level as low, grows.
bool grows_under_friction(const Scene& scene, double x, double v, const SineCosine<double>& phase) {
  const Oscillator& o = scene.oscillator;
  const auto [kinetic, static_level] = scene.friction;
  const double f = std::abs(o.forcing), most = pi<double>() / 4 * f * (1 - rounding), natural = natural_frequency(o);
  if (!grows_at_resonance(scene) || !o.shape.is_sine() || !(kinetic < most)) return false;
  if (static_level < most) return true;
  const double swing = v * phase.sine - natural * (x - equilibrium_of(o)) * phase.cosine;
  return natural * std::copysign(1.0, o.forcing) * swing - 2 * kinetic > (f + static_level) * (1 + rounding);
}

/// Whether the mass moves on for ever, with friction or without: once the spring and the load together push it on
/// harder than the other forces can push it back, the spring, if there is one, only helps.
bool is_pushed_away(const Scene& scene, double x, double v, const SineCosine<double>& phase) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  if (o.stiffness > 0) return grows_under_friction(scene, x, v, phase);
  const double ahead = constant_force(o, x);
  const bool is_open = ahead > 0 ? std::isinf(stops.upper) : std::isinf(stops.lower);
  const double against = (std::abs(o.forcing) + scene.friction.static_level) * (1 + rounding);
  return is_open && v * ahead >= 0 && std::abs(ahead) > against;
}

}  // namespace

bool escapes(const Scene& scene, double x, double v, const SineCosine<double>& phase) {
  const Oscillator& o = scene.oscillator;
  if (grows_at_resonance(scene) && !has_friction(scene.friction)) return true;
  if (has_friction(scene.friction) || !o.shape.is_sine()) return is_pushed_away(scene, x, v, phase);
  const Stops stops = innermost(scene.stops);
  if (!(o.stiffness <= 0) || (std::isfinite(stops.lower) && std::isfinite(stops.upper))) return false;
  const PhasePoint free = transient_of(o, {x - equilibrium_of(o), v, phase.sine, phase.cosine});
  const double h = o.damping, size = steady_response(o).amplitude;
  double departing = 0, nearest = 0;  // amount of what grows; the least of |x| on its way, response apart
  if (o.stiffness < 0) {
    const double root = norm(h, natural_frequency(o)), slow = o.stiffness / (h + root);
    const double fading = -(slow * free.x + free.v) / (2 * root);
    departing = free.x - fading, nearest = departing - std::copysign(std::abs(fading), departing);
  } else {
    departing = o.load != 0 ? o.load : h > 0 ? 0.0 : free.v;
    const double back = free.v * departing < 0 ? free.v : 0.0;  // it turns back only once
    const double way = h > 0 ? back / (2 * h) : o.load != 0 ? -back * back / (2 * o.load) : 0.0;
    nearest = free.x + way;
  }
  if (!(std::abs(departing) > rounding * (std::abs(free.x) + std::abs(free.v) + size))) return false;
  if (departing > 0) return std::isinf(stops.upper) && nearest - size > stops.lower - equilibrium_of(o);
  return departing < 0 && std::isinf(stops.lower) && nearest + size < stops.upper - equilibrium_of(o);
}

bool sticks_for_good(const Scene& scene, double x) {
  const Stops& stops = scene.stops;
  const bool on_rigid_stop =
      (x == stops.lower && !is_soft(stops, Side::lower)) || (x == stops.upper && !is_soft(stops, Side::upper));
  if (!has_friction(scene.friction) || on_rigid_stop) return false;
  double force = constant_force(scene.oscillator, x);
  if (soft_stop_beyond(stops, x) == Side::lower) force -= stops.stiffness_lower * (x - stops.lower);
  if (soft_stop_beyond(stops, x) == Side::upper) force -= stops.stiffness_upper * (x - stops.upper);
  return holds_throughout(scene.friction.static_level, force, scene.oscillator.forcing, scene.oscillator.shape);
}

bool never_moves(const Scene& scene) {
  return scene.start.velocity == 0 && sticks_for_good(scene, scene.start.displacement);
}

bool out_of_reach(const Oscillator& oscillator, const PhaseState& now, const Stops& stops) {
  if (response_meets(oscillator, stops)) return false;  // cheap to check first
  const double gap = gap_of(oscillator, stops);
  return displacement_bound(oscillator, now, std::numeric_limits<double>::infinity(), gap) < gap;
}

}  // namespace scene
}  // namespace clatter
