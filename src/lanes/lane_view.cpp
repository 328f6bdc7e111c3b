#include "lanes/lane_view.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <limits>
#include <utility>

#include "lanes/observed.hpp"
#include "lanes/step_functions.hpp"

namespace clatter::lanes {
namespace {

static_assert(observables::Harmonics::most_in_lanes == BlockState::most_harmonics);

/// Begins counts and sums anew; no flight is a reference yet.
void begin_sums(BlockState& block, std::size_t lane) {
  for (const std::size_t i : {0u, 1u}) {
    block.reference_y[i].length.lane[lane] = block.reference_v[i].length.lane[lane] = -1;
    block.count[i].lane[lane] = block.fastest[i].lane[lane] = 0;
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

/// Whether lanes take contact with a stop, if it is soft: beside a spring, a decaying rotation away from resonance.
bool yields(const Scene& scene, Side side) {
  if (!is_soft(scene.stops, side)) return true;
  const auto stop = motion::soft_stop_at<double>(scene.stops, side);
  const Oscillator& o = scene.oscillator;
  const Oscillator contact{.damping = o.damping + stop.damping,
                           .forcing = o.forcing,
                           .frequency = o.frequency,
                           .stiffness = o.stiffness + stop.stiffness};
  const bool turns = contact.damping * contact.damping <= 0.81 * contact.stiffness;
  const bool leaves = stop.damping == 0 || stop.damping >= 1e-4 * std::sqrt(stop.stiffness);
  return o.stiffness == 1 && stop.stiffness >= 1.0 / 16 && stop.stiffness <= 1e8 && turns && leaves &&
         forcing_of(contact) == Forcing::regular;
}

}  // namespace

bool accepts(const Scene& scene) {
  const Oscillator& o = scene.oscillator;
  const Stops& stops = scene.stops;
  const bool moves = o.forcing != 0 && o.shape.is_sine() && !has_friction(scene.friction) && o.damping >= 0 &&
                     o.damping <= 0.9 * rate_of(o) && holds(scene) && forcing_of(o) == Forcing::regular;
  const double amplitude = steady_response(o).amplitude, room = stops.upper - stops.lower;
  const auto bounces_on = [](const Restitution<double>& law) { return law.is_constant() && law.R >= 1.0 / 16; };
  const bool bounces = bounces_on(stops.restitution_lower) && bounces_on(stops.restitution_upper);
  return moves && yields(scene, Side::lower) && yields(scene, Side::upper) && o.frequency >= 1e-3 &&
         o.frequency <= 1e3 && bounces && amplitude > 1e-100 && amplitude < 1e100 && room > amplitude / 64 &&
         std::min(std::abs(stops.lower), std::abs(stops.upper)) < 1e100;
}

template <>
StepFunctions step_functions_of<sprung>(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_avx512, step_observed_avx512};
  if (arch == InstructionSet::avx2) return {step_avx2, step_observed_avx2};
  return {step_sse2, step_observed_sse2};
}

template <>
StepFunctions step_functions_of<cushioned>(InstructionSet arch) {
  if (arch == InstructionSet::avx512) return {step_cushioned_avx512, nullptr};
  if (arch == InstructionSet::avx2) return {step_cushioned_avx2, nullptr};
  return {step_cushioned_sse2, nullptr};
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

double LaneView::acceleration(double y, double v, double sine) const {
  const Oscillator& o = scene_->oscillator;
  if (is_cushioned())
    return Constants<cushioned>::Equation{at(block_->twice_h), o.forcing, o.frequency, at(block_->cushioned.k)}
        .acceleration(y, v, sine);
  const double twice_h = 2 * o.damping, pull = o.stiffness == 0 ? o.load : 0.0;
  if (o.stiffness == 1) return Constants<sprung>::Equation{twice_h, o.forcing, o.frequency}.acceleration(y, v, sine);
  return Constants<unsprung>::Equation{twice_h, o.forcing, o.frequency, o.stiffness, pull}.acceleration(y, v, sine);
}

double LaneView::x_of(double y) const {
  if (y == at(block_->stop_lower)) return scene_->stops.lower;
  if (y == at(block_->stop_upper)) return scene_->stops.upper;
  return equilibrium_of(scene_->oscillator) + y;
}

double LaneView::y_of(double x) const {
  if (x == scene_->stops.lower) return at(block_->stop_lower);
  if (x == scene_->stops.upper) return at(block_->stop_upper);
  return x - equilibrium_of(scene_->oscillator);
}

double LaneView::sections_between() const {
  return std::max(0.0, std::ceil(at(block_->time_to_section) / at(block_->period)) - 1);
}

LaneState LaneView::state() const {
  const double periods_left = at(block_->time_to_section) / at(block_->period);
  LaneState state{x_of(at(block_->y)), at(block_->v), 1 + sections_between() - periods_left};
  const double phase = is_cushioned() ? at(block_->cushioned.phase) : 0.0;
  if (phase == 0) return state;
  state.within = phase > 0 ? Side::upper : Side::lower, state.pressed = std::abs(phase) == 1;
  state.offset = at(block_->y) - (phase > 0 ? at(block_->lower) : at(block_->upper));
  state.x = (phase > 0 ? scene_->stops.upper : scene_->stops.lower) + state.offset;
  return state;
}

/// Puts the lane into the phase of a state, and returns its displacement from that phase's equilibrium.
double LaneView::enter_phase(const LaneState& state) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  BlockState::Cushioned& rows = block_->cushioned;
  LaneState s = state;
  if (s.within == Side::none) {
    const motion::Within<double> around = motion::soft_stop_around(scene_->stops, s.x, s.v);
    s.within = around.side, s.offset = around.offset, s.pressed = around.pressed;
  }
  const auto present = rows_of_phase(*block_);
  const std::size_t phase = s.within != Side::none && s.pressed ? 1 + index_of(s.within) : 0;
  for (std::size_t i = 0; i < present.size(); ++i) at(*present[i]) = at(rows.of_phase[phase][i]);
  at(rows.phase) = sign_of(s.within) * (s.pressed ? 1 : 2);
  if (s.within == Side::none) return y_of(s.x);
  const bool upper = s.within == Side::upper;
  if (!s.pressed) {
    at(block_->lower) = upper ? at(block_->stop_upper) : -infinity;
    at(block_->upper) = upper ? infinity : at(block_->stop_lower);
  }
  return (upper ? at(block_->lower) : at(block_->upper)) + s.offset;
}

void LaneView::set_state(const LaneState& state, double sections_between) {
  const double turn = 2 * pi<double>() * state.phase_turns, phase = scene_->start.phase + turn;
  const double sine = state.phase_turns == 0 ? at(block_->start_sine) : std::sin(phase);
  const double cosine = state.phase_turns == 0 ? at(block_->start_cosine) : std::cos(phase);
  const double y = is_cushioned() ? enter_phase(state) : y_of(state.x), nu = at(block_->nu);
  at(block_->sine) = sine, at(block_->cosine) = cosine;
  at(block_->y) = y, at(block_->v) = state.v;
  const Response<double> forced{at(block_->in_phase), at(block_->quadrature)};
  at(block_->free_x) = y - forced.displacement(sine, cosine);
  at(block_->free_v) = state.v - forced.velocity(nu, sine, cosine);
  at(block_->a) = acceleration(y, state.v, sine);
  at(block_->time_to_section) = (1 - state.phase_turns + sections_between) * at(block_->period);
  at(block_->to_next) = std::round(at(block_->to_next) / at(block_->period)) * at(block_->period);
  at(block_->excess) = 0;
}

LaneSection LaneView::section_of(const LaneReport& report) const {
  return {x_of(report.y), report.v, report.impacts, std::bit_cast<std::uint64_t>(report.itinerary), report.log_area};
}

PhaseState LaneView::section_from_load() const {
  return {at(block_->section_y), at(block_->section_v), at(block_->start_sine), at(block_->start_cosine)};
}

void LaneView::set_section(double y, double v) { at(block_->section_y) = y, at(block_->section_v) = v; }

double LaneView::pass_section(double x, double v) {
  set_section(x - equilibrium_of(scene_->oscillator), v);
  at(block_->section_itinerary) = std::exchange(at(block_->itinerary), 0.0);
  at(block_->section_impacts) = at(block_->impacts);
  at(block_->cushioned.section_log_area) = std::exchange(at(block_->cushioned.log_area), 0.0);
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
    at(block_->count[i]) += stop.count, at(block_->fastest[i]) = std::max(at(block_->fastest[i]), stop.fastest);
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

observables::Range LaneView::x_range() const { return {x_of(at(block_->y_low)), x_of(at(block_->y_high))}; }

observables::Range LaneView::v_range() const { return {at(block_->v_low), at(block_->v_high)}; }

std::array<observables::Impacts::OfStop, 2> LaneView::stops() const {
  std::array<observables::Impacts::OfStop, 2> stops;
  for (std::size_t i = 0; i < stops.size(); ++i) {
    if (at(block_->count[i]) == 0) continue;
    stops[i] = {.count = at(block_->count[i]),
                .before = at(block_->before[i]),
                .after = at(block_->after[i]),
                .fastest = at(block_->fastest[i])};
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
