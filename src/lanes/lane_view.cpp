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
constexpr double usual_step = 1.8;

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
  const bool moves =
      o.forcing != 0 && o.damping >= 0 && o.damping <= 0.9 && o.stiffness == 1.0 && forcing_of(o) == Forcing::regular;
  const double amplitude = steady_response(o).amplitude, room = stops.upper - stops.lower;
  const bool bounces = std::min(stops.restitution_lower, stops.restitution_upper) >= 1.0 / 16;
  return moves && !has_soft_stop(stops) && o.frequency >= 1e-3 && o.frequency <= 1e3 && bounces && amplitude > 1e-100 &&
         amplitude < 1e100 && room > amplitude / 64 && std::min(std::abs(stops.lower), std::abs(stops.upper)) < 1e100;
}

StepFunctions step_functions_of(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_avx512, step_observed_avx512};
  if (arch == InstructionSet::avx2) return {step_avx2, step_observed_avx2};
  return {step_sse2, step_observed_sse2};
}

void clear_lane(BlockState& block, std::size_t lane) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto set = [lane](LaneArray& row, double value) { row.lane[lane] = value; };
  for (LaneArray* const row : {&block.free_x, &block.free_v, &block.sine, &block.cosine, &block.y, &block.v, &block.a})
    set(*row, 0);
  for (LaneArray* const row : {&block.lower, &block.y_low, &block.v_low}) set(*row, -infinity);
  for (LaneArray* const row : {&block.upper, &block.y_high, &block.v_high, &block.time_to_section}) set(*row, infinity);
  for (LaneArray* const row : {&block.impacts, &block.ends_here, &block.stop_short}) set(*row, 0);
  begin_sums(block, lane);
}

/// Sets the error bounds of the lane's enclosures.
void LaneView::set_bounds(const Constants& constants, const Stops& stops, double step) {
  const auto error_of = [&](double free, int derivative) {
    motion::Motion<double> m{};
    m.free_x = free;
    return hermite_error(constants.sixth_bound(m, step, derivative));
  };
  at(block_->bound_forced) = error_of(0, 0), at(block_->bound) = error_of(1, 0) - error_of(0, 0);
  at(block_->bound_forced_v) = error_of(0, 1), at(block_->bound_v) = error_of(1, 1) - error_of(0, 1);
  at(block_->forced_size) = 2 * constants.response.amplitude * (1 + constants.nu);
  double scale = constants.response.amplitude * (1 + constants.nu * constants.nu * step * step);
  for (const double stop : {stops.lower, stops.upper})
    if (std::isfinite(stop)) scale += std::abs(stop) + std::abs(constants.load);
  at(block_->rounding) = rounding * scale;
}

void LaneView::load(const Constants& constants, const Stops& stops) {
  const double step = usual_step / std::max(1.0, constants.nu);
  const motion::Step<double> of_step = constants.step(step);
  BlockState& block = *block_;
  at(block.h) = constants.h, at(block.twice_h) = 2 * constants.h, at(block.f) = constants.f;
  at(block.nu) = constants.nu, at(block.root) = constants.root, at(block.inverse_root) = 1 / constants.root;
  at(block.in_phase) = constants.response.in_phase, at(block.quadrature) = constants.response.quadrature;
  at(block.amplitude) = constants.response.amplitude;
  at(block.step) = step, at(block.inverse_step) = 1 / step;
  at(block.free_a) = of_step.free.a, at(block.free_b) = of_step.free.b, at(block.free_c) = of_step.free.c;
  at(block.turn_sine) = of_step.turn.sine, at(block.turn_cosine_minus_one) = of_step.turn.cosine_minus_one;
  at(block.lower) = stops.lower - constants.load, at(block.upper) = stops.upper - constants.load;
  at(block.restitution_lower) = stops.restitution_lower, at(block.restitution_upper) = stops.restitution_upper;
  set_bounds(constants, stops, step);
  at(block.period) = constants.period;
  at(block.start_sine) = std::sin(scene_->start.phase), at(block.start_cosine) = std::cos(scene_->start.phase);
  at(block.impacts) = 0, at(block.itinerary) = 0;
  at(block.to_next) = constants.period;
  set_state({scene_->start.displacement, scene_->start.velocity, 0}, 0);
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

double LaneView::sections_between() const {
  return std::max(0.0, std::ceil(at(block_->time_to_section) / at(block_->period)) - 1);
}

LaneState LaneView::state() const {
  const double periods_left = at(block_->time_to_section) / at(block_->period);
  return {x_of(at(block_->y)), at(block_->v), 1 + sections_between() - periods_left};
}

void LaneView::set_state(const LaneState& state, double sections_between) {
  const double turn = 2 * pi<double>() * state.phase_turns, phase = scene_->start.phase + turn;
  const double sine = state.phase_turns == 0 ? at(block_->start_sine) : std::sin(phase);
  const double cosine = state.phase_turns == 0 ? at(block_->start_cosine) : std::cos(phase);
  const Response<double> forced{at(block_->in_phase), at(block_->quadrature)};
  const double y = y_of(state.x), nu = at(block_->nu);
  at(block_->sine) = sine, at(block_->cosine) = cosine;
  at(block_->y) = y, at(block_->v) = state.v;
  at(block_->free_x) = y - forced.displacement(sine, cosine);
  at(block_->free_v) = state.v - forced.velocity(nu, sine, cosine);
  at(block_->a) = Constants::Equation{at(block_->twice_h), at(block_->f), nu}.acceleration(y, state.v, sine);
  at(block_->time_to_section) = (1 - state.phase_turns + sections_between) * at(block_->period);
  at(block_->to_next) = std::round(at(block_->to_next) / at(block_->period)) * at(block_->period);
  at(block_->excess) = 0;
}

LaneSection LaneView::section() const {
  return {x_of(at(block_->section_y)), at(block_->section_v), at(block_->section_impacts),
          std::bit_cast<std::uint64_t>(at(block_->section_itinerary))};
}

PhaseState LaneView::section_from_load() const {
  return {at(block_->section_y), at(block_->section_v), at(block_->start_sine), at(block_->start_cosine)};
}

void LaneView::set_section(double y, double v) { at(block_->section_y) = y, at(block_->section_v) = v; }

double LaneView::pass_section(double x, double v) {
  set_section(x - scene_->oscillator.load, v);
  at(block_->section_itinerary) = std::exchange(at(block_->itinerary), 0.0);
  at(block_->section_impacts) = at(block_->impacts);
  block_->arrived |= LaneMask{1} << lane_;
  return std::round(std::exchange(at(block_->to_next), at(block_->period)) / at(block_->period)) - 1;
}

void LaneView::begin_observing(const observables::Observe& observe) {
  block_->extrema = observe.extrema, block_->counts = observe.impacts || observe.period;
  block_->harmonics = static_cast<std::size_t>(observe.harmonics);
  at(block_->y_low) = at(block_->y_high) = at(block_->y);
  at(block_->v_low) = at(block_->v_high) = at(block_->v);
  begin_sums(*block_, lane_);
}

void LaneView::expect_section(bool ends, bool stop_short, std::int64_t periods_after) {
  at(block_->ends_here) = ends ? 1 : 0, at(block_->stop_short) = stop_short ? 1 : 0;
  at(block_->to_next) += static_cast<double>(periods_after - 1) * at(block_->period);
}

void LaneView::add_to_itinerary(Side side) {
  at(block_->itinerary) = 3 * at(block_->itinerary) + (side == Side::upper ? 2 : 1);
}

void LaneView::include(const Observed& observed) {
  const auto x = observed.extrema.displacement(scene_->stops), v = observed.extrema.velocity();
  at(block_->y_low) = std::min(at(block_->y_low), y_of(x.low));
  at(block_->y_high) = std::max(at(block_->y_high), y_of(x.high));
  at(block_->v_low) = std::min(at(block_->v_low), v.low);
  at(block_->v_high) = std::max(at(block_->v_high), v.high);
  if (observed.first && at(block_->count[0]) + at(block_->count[1]) == 0)
    at(block_->first_before) = observed.first->before;
  for (const std::size_t i : {0u, 1u}) {
    const observables::Impacts::OfStop& stop = observed.impacts.stops()[i];
    if (at(block_->count[i]) == 0) at(block_->before[i]) = stop.before, at(block_->after[i]) = stop.after;
    at(block_->count[i]) += stop.count;
  }
  for (std::size_t k = 0; k <= block_->harmonics; ++k) {
    at(block_->jump_real[k]) += observed.jumps.sums()[k].real();
    at(block_->jump_imaginary[k]) += observed.jumps.sums()[k].imag();
  }
}

bool LaneView::extrema_hold(double transient) const {
  const double slack = at(block_->rounding) / 2, y = at(block_->amplitude) + transient - slack;
  const double v = scene_->oscillator.frequency * at(block_->amplitude) + transient - slack / at(block_->step);
  return at(block_->y_low) <= -y && at(block_->y_high) >= y && at(block_->v_low) <= -v && at(block_->v_high) >= v;
}

observables::Extrema::Range LaneView::x_range() const { return {x_of(at(block_->y_low)), x_of(at(block_->y_high))}; }

observables::Extrema::Range LaneView::v_range() const { return {at(block_->v_low), at(block_->v_high)}; }

std::array<observables::Impacts::OfStop, 2> LaneView::stops() const {
  std::array<observables::Impacts::OfStop, 2> stops;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (at(block_->count[i]) == 0) continue;
    stops[i] = {at(block_->count[i]), at(block_->before[i]), at(block_->after[i]), 0.0};
  }
  return stops;
}

double LaneView::first_speed() const {
  const bool met = at(block_->count[0]) + at(block_->count[1]) > 0;
  return met ? std::abs(at(block_->first_before)) : observables::no_value;
}

std::vector<std::complex<double>> LaneView::velocity_jumps() const {
  std::vector<std::complex<double>> jumps;
  for (std::size_t k = 0; k <= block_->harmonics; ++k)
    jumps.emplace_back(at(block_->jump_real[k]), at(block_->jump_imaginary[k]));
  return jumps;
}

}  // namespace clatter::lanes
