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

/// The rate that the damping of lanes is relative to: that of the spring, without one that of the force.
double rate_of(const Oscillator& oscillator) { return oscillator.stiffness == 0 ? oscillator.frequency : 1.0; }

/// Whether the spring or the stops hold the mass for ever, or a load does that presses it onto the only stop; points
/// have k = 1, 0 or -1.
bool holds(const Scene& scene) {
  const double k = scene.oscillator.stiffness, load = scene.oscillator.load;
  if (k == 1) return true;
  const bool above = std::isfinite(scene.stops.lower), below = std::isfinite(scene.stops.upper);
  if (above && below) return k == 0 || k == -1;
  return k == 0 && ((above && load < 0) || (below && load > 0));
}

}  // namespace

bool accepts(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const bool moves = o.forcing != 0 && o.damping >= 0 && o.damping <= 0.9 * rate_of(o) && holds(scene) &&
                     forcing_of(o) == Forcing::regular;
  const double amplitude = steady_response(o).amplitude, room = stops.upper - stops.lower;
  const bool bounces = std::min(stops.restitution_lower, stops.restitution_upper) >= 1.0 / 16;
  return moves && !has_soft_stop(stops) && o.frequency >= 1e-3 && o.frequency <= 1e3 && bounces && amplitude > 1e-100 &&
         amplitude < 1e100 && room > amplitude / 64 && std::min(std::abs(stops.lower), std::abs(stops.upper)) < 1e100;
}

template <>
StepFunctions step_functions_of<sprung>(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_avx512, step_observed_avx512};
  if (arch == InstructionSet::avx2) return {step_avx2, step_observed_avx2};
  return {step_sse2, step_observed_sse2};
}

template <>
StepFunctions step_functions_of<unsprung>(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_unsprung_avx512, step_unsprung_observed_avx512};
  if (arch == InstructionSet::avx2) return {step_unsprung_avx2, step_unsprung_observed_avx2};
  return {step_unsprung_sse2, step_unsprung_observed_sse2};
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

/// Sets the error bounds of the lane's enclosures. Without a spring displacement and velocity have bounds of their own.
template <Effects arcs>
void LaneView::set_bounds(const motion::ArcConstants<double, arcs>& constants, const Stops& stops, double step) {
  const auto error_of = [&](double free_x, double free_v, int derivative) {
    motion::Motion<double> m{};
    m.free_x = free_x, m.free_v = free_v;
    if constexpr (arcs.damping == Damping::heavy) m.fast_x = constants.fast_mode(free_x, free_v);
    return hermite_error(constants.sixth_bound(m, step, derivative));
  };
  const double size = std::max(1.0, constants.response.amplitude / 1024);  // that isn't lost beside the forced part
  const auto error_of_size = [&](int derivative) {
    if constexpr (!arcs.stiffness) return error_of(size, 0, derivative);
    const double of_x = error_of(size / at(block_->unsprung.reach_x), 0, derivative);
    return std::max(of_x, error_of(0, size / at(block_->unsprung.reach_v), derivative));
  };
  const auto set = [&](LaneArray& bound, LaneArray& forced, int derivative) {
    at(forced) = error_of(0, 0, derivative), at(bound) = (error_of_size(derivative) - at(forced)) / size;
  };
  set(block_->bound, block_->bound_forced, 0), set(block_->bound_v, block_->bound_forced_v, 1);
  at(block_->forced_size) = 2 * constants.response.amplitude * (1 + constants.nu);
  double scale = constants.response.amplitude * (1 + constants.nu * constants.nu * step * step);
  for (const double stop : {stops.lower, stops.upper})
    if (std::isfinite(stop)) scale += std::abs(stop) + std::abs(constants.equilibrium);
  if constexpr (arcs.stiffness) scale += std::abs(constants.unbalanced) * step * step;
  at(block_->rounding) = rounding * scale;
}

/// Loads all that lanes without a spring have besides (eqs. 43, 45 and 47).
template <Effects arcs>
void LaneView::load_unsprung(const motion::ArcConstants<double, arcs>& constants, double step) {
  BlockState::Unsprung& rows = block_->unsprung;
  const motion::Step<double> of_step = constants.step(step);
  const double k = constants.k, pull = constants.unbalanced, growth = std::exp(-constants.slow * step);
  at(rows.k) = k, at(rows.pull) = pull, at(rows.root_square) = -constants.root * constants.root;
  at(rows.free_kb) = k * of_step.free.b;
  at(rows.pulled_x) = pull * of_step.pulled, at(rows.pulled_v) = pull * of_step.free.b;
  at(rows.reach_x) = growth * std::max(1.0, -k * step), at(rows.reach_v) = growth * std::max(1.0, step);
  at(rows.reach_of_pull) = std::abs(pull) * std::max(step, step * step / 2);
}

template <Effects arcs>
void LaneView::load(const motion::ArcConstants<double, arcs>& constants, const Stops& stops) {
  const double step = usual_step / (arcs.stiffness ? constants.rate : std::max(1.0, constants.nu));
  const motion::Step<double> of_step = constants.step(step);
  BlockState& block = *block_;
  at(block.h) = constants.h, at(block.twice_h) = 2 * constants.h, at(block.f) = constants.f;
  at(block.nu) = constants.nu, at(block.root) = constants.root, at(block.inverse_root) = 1 / constants.root;
  at(block.in_phase) = constants.response.in_phase, at(block.quadrature) = constants.response.quadrature;
  at(block.amplitude) = constants.response.amplitude;
  at(block.step) = step, at(block.inverse_step) = 1 / step;
  at(block.free_a) = of_step.free.a, at(block.free_b) = of_step.free.b, at(block.free_c) = of_step.free.c;
  at(block.turn_sine) = of_step.turn.sine, at(block.turn_cosine_minus_one) = of_step.turn.cosine_minus_one;
  at(block.lower) = stops.lower - constants.equilibrium, at(block.upper) = stops.upper - constants.equilibrium;
  at(block.restitution_lower) = stops.restitution_lower, at(block.restitution_upper) = stops.restitution_upper;
  if constexpr (arcs.stiffness) load_unsprung(constants, step);
  set_bounds(constants, stops, step);
  at(block.period) = constants.period;
  at(block.start_sine) = std::sin(scene_->start.phase), at(block.start_cosine) = std::cos(scene_->start.phase);
  at(block.impacts) = 0, at(block.itinerary) = 0;
  at(block.to_next) = constants.period;
  set_state({scene_->start.displacement, scene_->start.velocity, 0}, 0);
}

template void LaneView::load(const Constants<sprung>&, const Stops&);
template void LaneView::load(const Constants<unsprung>&, const Stops&);

double LaneView::acceleration(double y, double v, double sine) const {
  const Oscillator& o = scene_->oscillator;
  const double twice_h = 2 * o.damping, pull = o.stiffness == 0 ? o.load : 0.0;
  if (o.stiffness == 1) return Constants<sprung>::Equation{twice_h, o.forcing, o.frequency}.acceleration(y, v, sine);
  return Constants<unsprung>::Equation{twice_h, o.forcing, o.frequency, o.stiffness, pull}.acceleration(y, v, sine);
}

double LaneView::x_of(double y) const {
  if (y == at(block_->lower)) return scene_->stops.lower;
  if (y == at(block_->upper)) return scene_->stops.upper;
  return equilibrium_of(scene_->oscillator) + y;
}

double LaneView::y_of(double x) const {
  if (x == scene_->stops.lower) return at(block_->lower);
  if (x == scene_->stops.upper) return at(block_->upper);
  return x - equilibrium_of(scene_->oscillator);
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
  at(block_->a) = acceleration(y, state.v, sine);
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
  set_section(x - equilibrium_of(scene_->oscillator), v);
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
