#include "lanes/lane_view.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lanes/step_functions.hpp"
#include "math/bernstein.hpp"
#include "motion/arc_constants.hpp"

namespace clatter::lanes {
namespace {

constexpr Effects effects = {.damping = Damping::light, .forcing = Forcing::regular};

/// Length of a step times max(1, nu): shorter steps are more to prove, longer ones are free of contact less often.
constexpr double usual_step = 2.0;

/// Bound of the rounding of displacements, relative to the sizes of their summands.
constexpr double rounding = 0x1p-49;

double step_of(const Scene& scene) { return usual_step / std::max(1.0, scene.oscillator.frequency); }

/// Sets the error bounds of a lane's enclosures.
void set_bounds(BlockState& lanes, std::size_t i, const motion::ArcConstants<double, effects>& constants,
                const Stops& stops, double step) {
  const auto error_of = [&](double free, int derivative) {
    motion::Motion<double> m{};
    m.free_x = free;
    return hermite_error(constants.sixth_bound(m, step, derivative)) * (derivative == 1 ? step : 1.0);
  };
  lanes.bound_forced.lane[i] = error_of(0, 0), lanes.bound.lane[i] = error_of(1, 0) - error_of(0, 0);
  lanes.bound_forced_v.lane[i] = error_of(0, 1), lanes.bound_v.lane[i] = error_of(1, 1) - error_of(0, 1);
  lanes.forced_size.lane[i] = 2 * constants.response.amplitude * (1 + constants.nu);
  double scale = constants.response.amplitude * (1 + constants.nu * constants.nu * step * step);
  for (const double stop : {stops.lower, stops.upper})
    if (std::isfinite(stop)) scale += std::abs(stop) + std::abs(constants.load);
  lanes.rounding.lane[i] = rounding * scale;
}

}  // namespace

bool accepts(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const bool moves = o.forcing != 0 && o.damping >= 0 && o.damping <= 0.9 && forcing_of(o) == Forcing::regular;
  const double amplitude = steady_response(o.damping, o.forcing, o.frequency).amplitude,
               room = stops.upper - stops.lower;
  const bool bounces = std::min(stops.restitution_lower, stops.restitution_upper) >= 1.0 / 16;
  return moves && o.frequency >= 1e-3 && o.frequency <= 1e3 && bounces && amplitude > 1e-100 && amplitude < 1e100 &&
         room > amplitude / 64 && std::min(std::abs(stops.lower), std::abs(stops.upper)) < 1e100;
}

void load_lane(BlockState& lanes, std::size_t i, const Scene& scene, const Stops& stops) {
  const motion::ArcConstants<double, effects> constants(scene.oscillator);
  const double step = step_of(scene), angle = constants.nu * step, rotation = constants.root * step;
  const motion::Propagator<double> free = constants.propagator(step);
  const auto set = [i](LaneArray& row, double value) { row.lane[i] = value; };
  set(lanes.free_pp, free.a), set(lanes.free_pw, free.b / step);
  set(lanes.free_wp, free.b * step), set(lanes.free_ww, free.c);
  set(lanes.turn_sine, std::sin(angle)), set(lanes.turn_cosine, std::cos(angle));
  set(lanes.in_phase, constants.response.in_phase), set(lanes.quadrature, constants.response.quadrature);
  set(lanes.angle, angle), set(lanes.rotation, rotation), set(lanes.decay, constants.h * step);
  set(lanes.damping, 2 * constants.h * step), set(lanes.skew, constants.h / constants.root),
      set(lanes.inverse_rotation, 1 / rotation);
  set(lanes.inverse_angle, 1 / angle), set(lanes.amplitude, constants.response.amplitude), set(lanes.step, step);
  set(lanes.forced_jerk, constants.f * constants.nu * step * step * step), set(lanes.stiffness, step * step),
      set(lanes.rate, 1 / step);
  set(lanes.lower, stops.lower - constants.load), set(lanes.upper, stops.upper - constants.load);
  set(lanes.restitution_lower, stops.restitution_lower), set(lanes.restitution_upper, stops.restitution_upper);
  set_bounds(lanes, i, constants, stops, step);
  set(lanes.period, constants.period / step);
  set(lanes.start_sine, std::sin(scene.start.phase)), set(lanes.start_cosine, std::cos(scene.start.phase));
  set(lanes.impacts, 0), set(lanes.itinerary, 0);
  set_state(lanes, i, scene, {scene.start.displacement, scene.start.velocity, 0});
}

void begin_observing(BlockState& lanes, std::size_t i, bool ends, bool stop_short) {
  lanes.skip_sections.lane[i] = 0, lanes.ends_here.lane[i] = ends ? 1 : 0,
  lanes.stop_short.lane[i] = ends && stop_short ? 1 : 0;
  lanes.y_low.lane[i] = lanes.y_high.lane[i] = lanes.y.lane[i];
  lanes.v_low.lane[i] = lanes.v_high.lane[i] = lanes.v.lane[i];
  for (const std::size_t which : {0u, 1u})
    lanes.reference_y[which].length.lane[i] = lanes.reference_v[which].length.lane[i] = -1;
  for (const std::size_t stop : {0u, 1u}) lanes.count[stop].lane[i] = 0;
  for (std::size_t k = 0; k <= lanes.harmonics; ++k) lanes.jump_real[k].lane[i] = lanes.jump_imaginary[k].lane[i] = 0;
}

void clear_lane(BlockState& lanes, std::size_t i) {
  const double infinity = std::numeric_limits<double>::infinity();
  for (LaneArray* const row : {&lanes.p, &lanes.w, &lanes.sine, &lanes.cosine, &lanes.y, &lanes.v, &lanes.a})
    row->lane[i] = 0;
  lanes.lower.lane[i] = -infinity, lanes.upper.lane[i] = lanes.time_to_section.lane[i] = infinity;
  begin_observing(lanes, i, false, false);
  lanes.y_low.lane[i] = lanes.v_low.lane[i] = -infinity, lanes.y_high.lane[i] = lanes.v_high.lane[i] = infinity;
  lanes.impacts.lane[i] = 0;
}

double x_of(const BlockState& lanes, std::size_t i, const Scene& scene, double y) {
  if (y == lanes.lower.lane[i]) return scene.stops.lower;
  if (y == lanes.upper.lane[i]) return scene.stops.upper;
  return scene.oscillator.load + y;
}

LaneState state_of(const BlockState& lanes, std::size_t i, const Scene& scene) {
  return {x_of(lanes, i, scene, lanes.y.lane[i]), lanes.v.lane[i] * lanes.rate.lane[i],
          1 - lanes.time_to_section.lane[i] / lanes.period.lane[i]};
}

void set_state(BlockState& lanes, std::size_t i, const Scene& scene, const LaneState& state) {
  const double turn = 2 * pi<double>() * state.phase_turns, phase = scene.start.phase + turn;
  const double sine = state.phase_turns == 0 ? lanes.start_sine.lane[i] : std::sin(phase);
  const double cosine = state.phase_turns == 0 ? lanes.start_cosine.lane[i] : std::cos(phase);
  const double P = lanes.in_phase.lane[i], Q = lanes.quadrature.lane[i], angle = lanes.angle.lane[i];
  const double y = state.x == scene.stops.lower   ? lanes.lower.lane[i]
                   : state.x == scene.stops.upper ? lanes.upper.lane[i]
                                                  : state.x - scene.oscillator.load;
  const double v = state.v / lanes.rate.lane[i], response = P * sine + Q * cosine;
  const double p = y - response, w = v - angle * (P * cosine - Q * sine);
  lanes.sine.lane[i] = sine, lanes.cosine.lane[i] = cosine;
  lanes.p.lane[i] = p, lanes.w.lane[i] = w, lanes.y.lane[i] = y, lanes.v.lane[i] = v;
  lanes.a.lane[i] = -(angle * angle * response + lanes.stiffness.lane[i] * p + lanes.damping.lane[i] * w);
  lanes.time_to_section.lane[i] = (1 - state.phase_turns) * lanes.period.lane[i];
  lanes.to_next.lane[i] = lanes.period.lane[i], lanes.excess.lane[i] = 0;
}

StepFunctions step_functions_of(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_avx512, step_observed_avx512};
  if (arch == InstructionSet::avx2) return {step_avx2, step_observed_avx2};
  return {step_sse2, step_observed_sse2};
}

}  // namespace clatter::lanes
