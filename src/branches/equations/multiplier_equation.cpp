#include <cstddef>
#include <vector>

#include "branches/equations/equations.hpp"
#include "branches/equations/links.hpp"

namespace clatter::branches {

using namespace clatter::branches::detail;

namespace {

/// The products of a motion's links before and after each of them; c is that of their denominators.
struct Chain {
  std::vector<Square<double>> before{{{{1, 0}, {0, 1}}}}, after;
  std::vector<double> c_before{1}, c_after;

  explicit Chain(const std::vector<Link<First>>& links)
      : after(links.size() + 1, {{{1, 0}, {0, 1}}}), c_after(links.size() + 1, 1.0) {
    for (const Link<First>& link : links) {
      before.push_back(product(plain(link), before.back()));
      c_before.push_back(c_before.back() * link.denominator.value);
    }
    for (std::size_t i = links.size(); i-- > 0;) {
      after[i] = product(after[i + 1], plain(links[i]));
      c_after[i] = c_after[i + 1] * links[i].denominator.value;
    }
  }

  [[nodiscard]] double trace() const { return before.back()[0][0] + before.back()[1][1]; }
  [[nodiscard]] double c() const { return c_before.back(); }
  /// By how much the trace grows with a variable of link i: tr(A dK B) = tr(B A dK).
  [[nodiscard]] double slope_of_trace(std::size_t i, const Link<First>& link, std::size_t variable) const {
    double trace = 0;
    const Square<double> around = product(before[i], after[i + 1]);
    for (std::size_t r = 0; r < 2; ++r)
      for (std::size_t s = 0; s < 2; ++s) trace += around[s][r] * link.numerator[r][s].slope[variable];
    return trace;
  }
  [[nodiscard]] double slope_of_c(std::size_t i, const Link<First>& link, std::size_t variable) const {
    return c_before[i] * c_after[i + 1] * link.denominator.slope[variable];
  }

 private:
  [[nodiscard]] static Square<double> plain(const Link<First>& link) {
    Square<double> k;
    for (std::size_t i = 0; i < 2; ++i)
      for (std::size_t j = 0; j < 2; ++j) k[i][j] = link.numerator[i][j].value;
    return k;
  }
};

std::vector<Link<First>> links_of(const OrbitEquations& of, const FollowedScene& scene, const Orbit& orbit) {
  if (orbit.meets_soft_stop())
    return links_of_states(scene, orbit, numbers_along<First>(scene, of.axes()), of.stiffness_varies());
  std::vector<Link<First>> links;
  const auto add_links = [&]<Effects E>() {
    const Flights<Second, E> flights(numbers_along<Second>(scene, of.axes()));
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const FlightEnd<Second> end = flights.fly(flight_of<Second>(orbit, i));
      links.push_back(link_of(end.beyond.slope, end.coordinate.slope, orbit.ends_mirrored(i), orbit.event(i + 1).kind));
    }
  };
  with_arcs(scene, add_links, of.stiffness_varies());
  return links;
}

/// The determinant of a motion, by the phase and the place of its reversal i: that of the accelerations there.
First determinant_by_reversal(const SceneNumbers<First>& p, const Orbit& orbit, std::size_t i) {
  const OrbitEvent& halt = orbit.events[i];
  Orbit others = orbit;
  others.events.erase(others.events.begin() + static_cast<std::ptrdiff_t>(i));
  return determinant_of(p, others) *
         reversal_factor(p, halt.side,
                         Standing<First>{First(halt.place, by_before), First(halt.phase, by_begin), halt.held_by()});
}

}  // namespace

/// g = c (1 + D) - sigma tr(K_n ... K_1), c the product of the links' denominators.
void OrbitEquations::add_multiplier(const FollowedScene& scene, const Orbit& all, const Condition& condition,
                                    std::size_t row, Linearised& out) const {
  const Orbit orbit = condition.without ? all.without(*condition.without) : all;
  const std::size_t count = orbit.size();
  const auto phase_at = [&](std::size_t i) { return phase_of(i + (condition.without && *condition.without <= i)); };
  const auto next_phase = [&](std::size_t i) { return phase_at(i + 1 == count ? 0 : i + 1); };
  const std::vector<Link<First>> links = links_of(*this, scene, orbit);
  const Chain chain(links);
  const SceneNumbers<First> p = numbers_along<First>(scene, axes_);
  const First determinant = determinant_of(p, orbit);
  const double sigma = condition.multiplier;
  out.residual[row] = chain.c() * (1 + determinant.value) - sigma * chain.trace();
  const auto add = [&](std::size_t i, std::size_t variable, std::size_t unknown, double unit) {
    out.slope(row, unknown) += unit * (chain.slope_of_c(i, links[i], variable) * (1 + determinant.value) -
                                       sigma * chain.slope_of_trace(i, links[i], variable));
  };
  for (std::size_t i = 0; i < count; ++i) {
    add(i, by_begin, phase_at(i), 1.0), add(i, by_before, phase_at(i) + 1, speed_unit_);
    add(i, by_end, next_phase(i), 1.0);
    for (std::size_t k = 0; k < axes_.size(); ++k) add(i, by_first_axis + k, first_axis() + k, axes_[k].unit);
  }
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, first_axis() + k) += axes_[k].unit * chain.c() * determinant.slope[by_first_axis + k];
  for (std::size_t i = 0; i < count; ++i) {
    if (orbit.events[i].kind != Event::Kind::reversal) continue;
    const First by_halt = determinant_by_reversal(p, orbit, i);
    out.slope(row, phase_at(i)) += chain.c() * by_halt.slope[by_begin];
    out.slope(row, phase_at(i) + 1) += chain.c() * by_halt.slope[by_before] * speed_unit_;
  }
  for (std::size_t i = 0; i < count; ++i) {  // longer contacts with a soft stop take more
    const Side pressed = orbit.pressed_after(i);
    if (pressed == Side::none) continue;
    const double longer =
        -2 * p.soft_stop(pressed).damping.value / p.oscillator.frequency.value * chain.c() * determinant.value;
    out.slope(row, phase_at(i)) -= longer, out.slope(row, next_phase(i)) += longer;
  }
}

}  // namespace clatter::branches
