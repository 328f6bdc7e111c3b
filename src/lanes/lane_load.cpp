#include <algorithm>
#include <cmath>
#include <limits>

#include "lanes/lane_view.hpp"
#include "math/bernstein.hpp"
#include "motion/arc_bounds.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::lanes {
namespace {

/// Length of a step times max(1, nu): shorter steps are more to prove, longer ones are free of contact less often.
constexpr double usual_step = 1.8;

/// Bound of the rounding of displacements, relative to the sizes of their summands.
constexpr double rounding = 0x1p-49;

}  // namespace

/// Sets the error bounds of the lane's enclosures. Without a spring displacement and velocity have bounds of their own.
template <Effects arcs>
void LaneView::set_bounds(const motion::ArcConstants<double, arcs>& constants, const Stops& stops, double step) {
  const auto error_of = [&](double free_x, double free_v, int derivative) {
    motion::Motion<double> m{};
    m.free_x = free_x, m.free_v = free_v;
    if constexpr (arcs.damping == Damping::heavy) m.fast_x = constants.fast_mode(free_x, free_v);
    return hermite_error(sixth_bound(constants, m, step, derivative));
  };
  const double size = std::max(1.0, constants.response.amplitude / 1024);  // that isn't lost beside the forced part
  const auto error_of_size = [&](int derivative) {
    if constexpr (!arcs.stiffness) return error_of(size, 0, derivative);
    if constexpr (arcs == cushioned.arc()) return error_of(0, size, derivative);
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

/// Loads the constants of an oscillator's arcs, and of steps between stops.
template <Effects arcs>
void LaneView::load_arc(const motion::ArcConstants<double, arcs>& constants, const Stops& stops) {
  const double fastest = arcs == unsprung.arc() ? constants.rate : std::max(constants.natural, constants.nu);
  const double step = usual_step / fastest;
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
  if constexpr (arcs == unsprung.arc()) load_unsprung(constants, step);
  set_bounds(constants, stops, step);
}

/// Loads all that lanes with soft stops have besides: motion in contact belongs to other oscillators (eq. 51).
void LaneView::load_phases(const Constants<cushioned>& between, const Stops& stops) {
  constexpr double infinity = std::numeric_limits<double>::infinity();
  for (const Side side : {Side::lower, Side::upper}) {
    const std::size_t i = index_of(side);
    at(block_->cushioned.soft[i]) = is_soft(stops, side) ? 1 : 0;
    if (!is_soft(stops, side)) continue;
    const auto stop = motion::soft_stop_at<double>(stops, side);
    const auto contact = Constants<cushioned>::in_contact(between, stop);
    at(block_->cushioned.relaxation_of[i]) = stop.relaxation();
    // contact ends at the stop's position or beyond it, which is on its side of the equilibrium that it presses to
    Stops bounds{.lower = -infinity, .upper = infinity};
    (side == Side::upper ? bounds.lower : bounds.upper) = stop.position;
    load_phase(1 + i, contact, bounds);
  }
  load_phase(0, between, stops);
  at(block_->cushioned.log_area) = 0;
}

/// Loads the constants of a phase into its own rows and into the present ones.
void LaneView::load_phase(std::size_t phase, const Constants<cushioned>& constants, const Stops& bounds) {
  BlockState::Cushioned& rows = block_->cushioned;
  load_arc(constants, bounds);
  if (std::isfinite(bounds.lower)) at(block_->lower) = (bounds.lower - constants.origin) - constants.balance;
  if (std::isfinite(bounds.upper)) at(block_->upper) = (bounds.upper - constants.origin) - constants.balance;
  const double r = phase == 0 ? 0.0 : constants.stop.relaxation();
  const double more = 1 + 4 * r * std::max(constants.natural, constants.nu);  // by the velocity's part, and its slope's
  at(block_->bound) += r * at(block_->bound_v), at(block_->bound_forced) += r * at(block_->bound_forced_v);
  at(block_->rounding) *= more, at(rows.rounding_of_free) = rounding * more;
  at(rows.k) = constants.k, at(rows.natural) = constants.natural;
  at(rows.free_kb) = constants.k * at(block_->free_b);
  at(rows.relaxation) = r, at(rows.shrinks) = 2 * constants.stop.damping;
  at(rows.shift) = phase == 0 ? 0.0 : constants.equilibrium - equilibrium_of(scene_->oscillator);
  const auto present = rows_of_phase(*block_);
  for (std::size_t i = 0; i < present.size(); ++i) at(rows.of_phase[phase][i]) = at(*present[i]);
}

template <Effects arcs>
void LaneView::load(const motion::ArcConstants<double, arcs>& constants, const Stops& stops) {
  BlockState& block = *block_;
  if constexpr (arcs == cushioned.arc()) {
    load_phases(constants, stops);
  } else {
    load_arc(constants, stops);
  }
  at(block.stop_lower) = at(block.lower), at(block.stop_upper) = at(block.upper);
  at(block.restitution_lower) = stops.restitution_lower.R, at(block.restitution_upper) = stops.restitution_upper.R;
  at(block.period) = constants.period;
  at(block.start_sine) = std::sin(scene_->start.phase), at(block.start_cosine) = std::cos(scene_->start.phase);
  at(block.impacts) = 0, at(block.itinerary) = 0;
  at(block.to_next) = constants.period;
  set_state({scene_->start.displacement, scene_->start.velocity, 0}, 0);
}

template void LaneView::load(const Constants<sprung>&, const Stops&);
template void LaneView::load(const Constants<unsprung>&, const Stops&);
template void LaneView::load(const Constants<cushioned>&, const Stops&);

}  // namespace clatter::lanes
