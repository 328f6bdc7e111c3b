#include "lanes/seat.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "dynamics/bernstein.hpp"
#include "dynamics/flow.hpp"
#include "lanes/visits.hpp"

namespace clatter {
namespace {

constexpr Effects effects = {.damping = Damping::light, .forcing = Forcing::regular};

/// Of a step, times the larger of 1 and nu: below it more steps are proved, above it fewer of them are free of a stop.
constexpr double usual_step = 2.0;

/// What places are rounded by, over the sizes of the parts that they are sums of.
constexpr double rounding = 0x1p-49;

double step_of(const Scene& scene) { return usual_step / std::max(1.0, scene.oscillator.frequency); }

/// Fills a lane with what its enclosures are uncertain by.
void set_bounds(Lanes& lanes, std::size_t i, const Flow<double, effects>& flow, const Stops& stops, double step) {
  const auto error_of = [&](double free, int derivative) {
    Motion<double> m{};
    m.free_x = free;
    return hermite_error(flow.sixth_bound(m, step, derivative)) * (derivative == 1 ? step : 1.0);
  };
  lanes.bound_forced.lane[i] = error_of(0, 0), lanes.bound.lane[i] = error_of(1, 0) - error_of(0, 0);
  lanes.bound_forced_v.lane[i] = error_of(0, 1), lanes.bound_v.lane[i] = error_of(1, 1) - error_of(0, 1);
  lanes.forced_size.lane[i] = 2 * flow.response.amplitude * (1 + flow.nu);
  double scale = flow.response.amplitude * (1 + flow.nu * flow.nu * step * step);
  for (const double stop : {stops.lower, stops.upper})
    if (std::isfinite(stop)) scale += std::abs(stop) + std::abs(flow.load);
  lanes.rounding.lane[i] = rounding * scale;
}

}  // namespace

bool fits_lanes(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const bool moves = o.forcing != 0 && o.damping >= 0 && o.damping <= 0.9 && forcing_of(o) == Forcing::regular;
  const double amplitude = steady_response(o.damping, o.forcing, o.frequency).amplitude,
               room = stops.upper - stops.lower;
  const bool bounces = std::min(stops.restitution_lower, stops.restitution_upper) >= 1.0 / 16;
  return moves && o.frequency >= 1e-3 && o.frequency <= 1e3 && bounces && amplitude > 1e-100 && amplitude < 1e100 &&
         room > amplitude / 64 && std::min(std::abs(stops.lower), std::abs(stops.upper)) < 1e100;
}

void seat(Lanes& lanes, std::size_t i, const Scene& scene, const Stops& stops) {
  const Flow<double, effects> flow(scene.oscillator);
  const double step = step_of(scene), angle = flow.nu * step, rotation = flow.root * step;
  const Propagator<double> free = flow.propagator(step);
  const auto set = [i](Row& row, double value) { row.lane[i] = value; };
  set(lanes.free_pp, free.a), set(lanes.free_pw, free.b / step);
  set(lanes.free_wp, free.b * step), set(lanes.free_ww, free.c);
  set(lanes.turn_sine, std::sin(angle)), set(lanes.turn_cosine, std::cos(angle));
  set(lanes.in_phase, flow.response.in_phase), set(lanes.quadrature, flow.response.quadrature);
  set(lanes.angle, angle), set(lanes.rotation, rotation), set(lanes.decay, flow.h * step);
  set(lanes.damping, 2 * flow.h * step), set(lanes.skew, flow.h / flow.root), set(lanes.slowness, 1 / rotation);
  set(lanes.inverse_angle, 1 / angle), set(lanes.amplitude, flow.response.amplitude), set(lanes.span, step);
  set(lanes.push, flow.f * flow.nu * step * step * step), set(lanes.stiffness, step * step), set(lanes.rate, 1 / step);
  set(lanes.lower, stops.lower - flow.load), set(lanes.upper, stops.upper - flow.load);
  set(lanes.keep_lower, stops.restitution_lower), set(lanes.keep_upper, stops.restitution_upper);
  set_bounds(lanes, i, flow, stops, step);
  set(lanes.period, flow.period / step);
  set(lanes.start_sine, std::sin(scene.start.phase)), set(lanes.start_cosine, std::cos(scene.start.phase));
  set(lanes.impacts, 0), set(lanes.trace, 0);
  put(lanes, i, scene, {scene.start.displacement, scene.start.velocity, 0});
}

void watch(Lanes& lanes, std::size_t i, bool ends, bool clips) {
  lanes.quiet.lane[i] = 0, lanes.ends.lane[i] = ends ? 1 : 0, lanes.clips.lane[i] = ends && clips ? 1 : 0;
  lanes.y_low.lane[i] = lanes.y_high.lane[i] = lanes.y.lane[i];
  lanes.v_low.lane[i] = lanes.v_high.lane[i] = lanes.v.lane[i];
  for (const std::size_t which : {0u, 1u})
    lanes.reference_y[which].length.lane[i] = lanes.reference_v[which].length.lane[i] = -1;
  for (const std::size_t stop : {0u, 1u}) lanes.count[stop].lane[i] = 0;
  for (std::size_t k = 0; k <= lanes.harmonics; ++k) lanes.jump_real[k].lane[i] = lanes.jump_imaginary[k].lane[i] = 0;
}

void vacate(Lanes& lanes, std::size_t i) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (Row* const row : {&lanes.p, &lanes.w, &lanes.sine, &lanes.cosine, &lanes.y, &lanes.v, &lanes.a})
    row->lane[i] = 0;
  lanes.lower.lane[i] = -infinity, lanes.upper.lane[i] = lanes.left.lane[i] = infinity;
  watch(lanes, i, false, false);
  lanes.y_low.lane[i] = lanes.v_low.lane[i] = -infinity, lanes.y_high.lane[i] = lanes.v_high.lane[i] = infinity;
  lanes.impacts.lane[i] = 0;
}

LanePlace place_of(const Lanes& lanes, std::size_t i, const Scene& scene) {
  const Stops& stops = scene.stops;
  const double y = lanes.y.lane[i];
  const double x = y == lanes.lower.lane[i]   ? stops.lower
                   : y == lanes.upper.lane[i] ? stops.upper
                                              : scene.oscillator.load + y;
  return {x, lanes.v.lane[i] * lanes.rate.lane[i], 1 - lanes.left.lane[i] / lanes.period.lane[i]};
}

void put(Lanes& lanes, std::size_t i, const Scene& scene, const LanePlace& place) {
  const double turn = 2 * pi<double>() * place.turns, phase = scene.start.phase + turn;
  const double sine = place.turns == 0 ? lanes.start_sine.lane[i] : std::sin(phase);
  const double cosine = place.turns == 0 ? lanes.start_cosine.lane[i] : std::cos(phase);
  const double P = lanes.in_phase.lane[i], Q = lanes.quadrature.lane[i], angle = lanes.angle.lane[i];
  const double y = place.x == scene.stops.lower   ? lanes.lower.lane[i]
                   : place.x == scene.stops.upper ? lanes.upper.lane[i]
                                                  : place.x - scene.oscillator.load;
  const double v = place.v / lanes.rate.lane[i], response = P * sine + Q * cosine;
  const double p = y - response, w = v - angle * (P * cosine - Q * sine);
  lanes.sine.lane[i] = sine, lanes.cosine.lane[i] = cosine;
  lanes.p.lane[i] = p, lanes.w.lane[i] = w, lanes.y.lane[i] = y, lanes.v.lane[i] = v;
  lanes.a.lane[i] = -(angle * angle * response + lanes.stiffness.lane[i] * p + lanes.damping.lane[i] * w);
  lanes.left.lane[i] = (1 - place.turns) * lanes.period.lane[i];
  lanes.to_next.lane[i] = lanes.period.lane[i], lanes.longer.lane[i] = 0;
}

Visits visits_of(Arch arch) {
  if (arch == Arch::avx512) return {visit_avx512, observe_avx512};
  if (arch == Arch::avx2) return {visit_avx2, observe_avx2};
  return {visit_sse2, observe_sse2};
}

}  // namespace clatter
