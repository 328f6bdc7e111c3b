#include "lanes/lane_view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "lanes/step_functions.hpp"
#include "math/bernstein.hpp"

namespace clatter::lanes {
namespace {

static_assert(observables::Harmonics::most_in_lanes == BlockState::most_harmonics);

/// Length of a step times max(1, nu): shorter steps are more to prove, longer ones are free of contact less often.
constexpr double usual_step = 2.0;

/// Bound of the rounding of displacements, relative to the sizes of their summands.
constexpr double rounding = 0x1p-49;

/// Begins counts and sums anew; no flight is a reference yet.
void begin_sums(BlockState& block, std::size_t lane) {
  for (const std::size_t i : {0u, 1u}) {
    block.reference_y[i].length.lane[lane] = block.reference_v[i].length.lane[lane] = -1;
    block.count[i].lane[lane] = 0;
  }
  for (std::size_t k = 0; k <= block.harmonics; ++k)
    block.jump_real[k].lane[lane] = block.jump_imaginary[k].lane[lane] = 0;
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

StepFunctions step_functions_of(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_avx512, step_observed_avx512};
  if (arch == InstructionSet::avx2) return {step_avx2, step_observed_avx2};
  return {step_sse2, step_observed_sse2};
}

void clear_lane(BlockState& block, std::size_t lane) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto set = [lane](LaneArray& row, double value) { row.lane[lane] = value; };
  for (LaneArray* const row : {&block.p, &block.w, &block.sine, &block.cosine, &block.y, &block.v, &block.a})
    set(*row, 0);
  for (LaneArray* const row : {&block.lower, &block.y_low, &block.v_low}) set(*row, -infinity);
  for (LaneArray* const row : {&block.upper, &block.y_high, &block.v_high, &block.time_to_section}) set(*row, infinity);
  for (LaneArray* const row : {&block.impacts, &block.skip_sections, &block.ends_here, &block.stop_short}) set(*row, 0);
  begin_sums(block, lane);
}

/// Sets the error bounds of the lane's enclosures.
void LaneView::set_bounds(const Constants& constants, const Stops& stops, double step) {
  const auto error_of = [&](double free, int derivative) {
    motion::Motion<double> m{};
    m.free_x = free;
    return hermite_error(constants.sixth_bound(m, step, derivative)) * (derivative == 1 ? step : 1.0);
  };
  at(block_->bound_forced) = error_of(0, 0), at(block_->bound) = error_of(1, 0) - error_of(0, 0);
  at(block_->bound_forced_v) = error_of(0, 1), at(block_->bound_v) = error_of(1, 1) - error_of(0, 1);
  at(block_->forced_size) = 2 * constants.response.amplitude * (1 + constants.nu);
  double scale = constants.response.amplitude * (1 + constants.nu * constants.nu * step * step);
  for (const double stop : {stops.lower, stops.upper})
    if (std::isfinite(stop)) scale += std::abs(stop) + std::abs(constants.load);
  at(block_->rounding) = rounding * scale;
}

void LaneView::load(const Stops& stops) {
  const Constants constants(scene_->oscillator);
  const double step = usual_step / std::max(1.0, scene_->oscillator.frequency);
  const double angle = constants.nu * step, rotation = constants.root * step;
  const motion::Propagator<double> free = constants.propagator(step);
  BlockState& block = *block_;
  at(block.free_pp) = free.a, at(block.free_pw) = free.b / step;
  at(block.free_wp) = free.b * step, at(block.free_ww) = free.c;
  at(block.turn_sine) = std::sin(angle), at(block.turn_cosine) = std::cos(angle);
  at(block.in_phase) = constants.response.in_phase, at(block.quadrature) = constants.response.quadrature;
  at(block.amplitude) = constants.response.amplitude;
  at(block.angle) = angle, at(block.inverse_angle) = 1 / angle;
  at(block.rotation) = rotation, at(block.inverse_rotation) = 1 / rotation;
  at(block.decay) = constants.h * step, at(block.damping) = 2 * constants.h * step;
  at(block.skew) = constants.h / constants.root;
  at(block.step) = step, at(block.rate) = 1 / step, at(block.stiffness) = step * step;
  at(block.forced_jerk) = constants.f * constants.nu * step * step * step;
  at(block.lower) = stops.lower - constants.load, at(block.upper) = stops.upper - constants.load;
  at(block.restitution_lower) = stops.restitution_lower, at(block.restitution_upper) = stops.restitution_upper;
  set_bounds(constants, stops, step);
  at(block.period) = constants.period / step;
  at(block.start_sine) = std::sin(scene_->start.phase), at(block.start_cosine) = std::cos(scene_->start.phase);
  at(block.impacts) = 0, at(block.itinerary) = 0;
  set_state({scene_->start.displacement, scene_->start.velocity, 0});
}

double LaneView::x_of(double y) const {
  if (y == at(block_->lower)) return scene_->stops.lower;
  if (y == at(block_->upper)) return scene_->stops.upper;
  return scene_->oscillator.load + y;
}

double LaneView::y_of(double x) const {
  if (x == scene_->stops.lower) return at(block_->lower);
  if (x == scene_->stops.upper) return at(block_->upper);
  return x - scene_->oscillator.load;
}

LaneState LaneView::state() const {
  return {x_of(at(block_->y)), at(block_->v) * at(block_->rate), 1 - at(block_->time_to_section) / at(block_->period)};
}

void LaneView::set_state(const LaneState& state) {
  const double turn = 2 * pi<double>() * state.phase_turns, phase = scene_->start.phase + turn;
  const double sine = state.phase_turns == 0 ? at(block_->start_sine) : std::sin(phase);
  const double cosine = state.phase_turns == 0 ? at(block_->start_cosine) : std::cos(phase);
  const double P = at(block_->in_phase), Q = at(block_->quadrature), angle = at(block_->angle);
  const double y = y_of(state.x), v = state.v / at(block_->rate), response = P * sine + Q * cosine;
  const double p = y - response, w = v - angle * (P * cosine - Q * sine);
  at(block_->sine) = sine, at(block_->cosine) = cosine;
  at(block_->p) = p, at(block_->w) = w, at(block_->y) = y, at(block_->v) = v;
  at(block_->a) = -(angle * angle * response + at(block_->stiffness) * p + at(block_->damping) * w);
  at(block_->time_to_section) = (1 - state.phase_turns) * at(block_->period);
  at(block_->to_next) = at(block_->period), at(block_->excess) = 0;
}

LaneSection LaneView::section() const {
  return {x_of(at(block_->section_y)), at(block_->section_v) * at(block_->rate), at(block_->section_impacts),
          std::bit_cast<std::uint64_t>(at(block_->section_itinerary))};
}

PhaseState LaneView::section_from_load() const {
  return {at(block_->section_y), at(block_->section_v) * at(block_->rate), at(block_->start_sine),
          at(block_->start_cosine)};
}

void LaneView::set_section(double y, double v) {
  at(block_->section_y) = y, at(block_->section_v) = v / at(block_->rate);
}

void LaneView::pass_section(double x, double v) {
  set_section(x - scene_->oscillator.load, v);
  at(block_->section_itinerary) = std::exchange(at(block_->itinerary), 0.0);
  at(block_->section_impacts) = at(block_->impacts);
  double& skip = at(block_->skip_sections);
  if (skip > 0) {
    --skip;
  } else {
    block_->arrived |= LaneMask{1} << lane_;
  }
}

void LaneView::begin_observing(const observables::Observe& observe, bool ends, bool stop_short) {
  block_->extrema = observe.extrema, block_->counts = observe.impacts || observe.period;
  block_->harmonics = static_cast<std::size_t>(observe.harmonics);
  at(block_->y_low) = at(block_->y_high) = at(block_->y);
  at(block_->v_low) = at(block_->v_high) = at(block_->v);
  skip_sections(0, ends, stop_short);
  begin_sums(*block_, lane_);
}

void LaneView::skip_sections(std::int64_t count, bool ends, bool stop_short) {
  at(block_->skip_sections) = static_cast<double>(count);
  at(block_->ends_here) = ends ? 1 : 0, at(block_->stop_short) = stop_short ? 1 : 0;
}

void LaneView::add_impact(const motion::Impact& impact, bool observes) {
  at(block_->itinerary) = 3 * at(block_->itinerary) + (impact.side == Side::upper ? 2 : 1);
  if (!observes) return;
  const double step = 1 / at(block_->rate), jump = impact.after - impact.before;
  const std::size_t stop = index_of(impact.side);
  if (at(block_->count[0]) + at(block_->count[1]) == 0) at(block_->first_before) = impact.before * step;
  if (at(block_->count[stop]) == 0)
    at(block_->before[stop]) = impact.before * step, at(block_->after[stop]) = impact.after * step;
  at(block_->count[stop]) += 1;
  for (std::size_t k = 0; k <= block_->harmonics; ++k) {
    const double angle = static_cast<double>(k) * scene_->oscillator.frequency * impact.time;
    at(block_->jump_real[k]) += step * jump * std::cos(angle);
    at(block_->jump_imaginary[k]) -= step * jump * std::sin(angle);
  }
}

void LaneView::widen(const observables::Extrema& seen) {
  const double step = 1 / at(block_->rate);
  const auto x = seen.displacement(scene_->stops), v = seen.velocity();
  at(block_->y_low) = std::min(at(block_->y_low), y_of(x.low));
  at(block_->y_high) = std::max(at(block_->y_high), y_of(x.high));
  at(block_->v_low) = std::min(at(block_->v_low), v.low * step);
  at(block_->v_high) = std::max(at(block_->v_high), v.high * step);
}

bool LaneView::extrema_hold(double transient) const {
  const double slack = at(block_->rounding) / 2, y = at(block_->amplitude) + transient - slack;
  const double v = (scene_->oscillator.frequency * at(block_->amplitude) + transient - slack) / at(block_->rate);
  return at(block_->y_low) <= -y && at(block_->y_high) >= y && at(block_->v_low) <= -v && at(block_->v_high) >= v;
}

observables::Extrema::Range LaneView::x_range() const { return {x_of(at(block_->y_low)), x_of(at(block_->y_high))}; }

observables::Extrema::Range LaneView::v_range() const {
  return {at(block_->v_low) * at(block_->rate), at(block_->v_high) * at(block_->rate)};
}

std::array<observables::Impacts::OfStop, 2> LaneView::stops() const {
  std::array<observables::Impacts::OfStop, 2> stops;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (at(block_->count[i]) == 0) continue;
    stops[i] = {at(block_->count[i]), at(block_->before[i]) * at(block_->rate), at(block_->after[i]) * at(block_->rate),
                0.0};
  }
  return stops;
}

double LaneView::first_speed() const {
  const bool met = at(block_->count[0]) + at(block_->count[1]) > 0;
  return met ? std::abs(at(block_->first_before)) * at(block_->rate) : observables::no_value;
}

std::vector<std::complex<double>> LaneView::velocity_jumps() const {
  std::vector<std::complex<double>> jumps;
  for (std::size_t k = 0; k <= block_->harmonics; ++k)
    jumps.emplace_back(at(block_->jump_real[k]) * at(block_->rate), at(block_->jump_imaginary[k]) * at(block_->rate));
  return jumps;
}

}  // namespace clatter::lanes
