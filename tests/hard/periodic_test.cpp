// Random scenes run until they repeat: harmonics from the impacts alone, and the energy of a period.

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <complex>
#include <numbers>
#include <vector>

#include "hard/energy.hpp"
#include "hard/panels.hpp"
#include "hard/tally.hpp"
#include "observables/harmonics/exact_harmonics.hpp"
#include "point/every_effect.hpp"

namespace clatter::hard::periodic_test {
namespace {

using Complex = std::complex<double>;

constexpr std::size_t highest = 3;  ///< harmonic

/// A period of a motion, observed in three ways.
struct Period : Watcher {
  Period(const point::Problem& scene, const motion::State<double>& from, double length, double base_)
      : base(base_), by_parts(highest, base_), books(scene, from.x, from.v), total(length) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    by_parts.arc(arc, begin, length), books.arc(arc, begin, length);
    for (std::size_t k = 0; k <= highest; ++k) {
      const double w = base * static_cast<double>(k);
      double part = 0;
      by_quadrature[k] += integral(
                              arc, length, arc.constants().rate + w,
                              [&](const auto& m, double s) { return m.x * std::polar(1.0, -w * (begin + s)); }, part) /
                          total;
      if (k == 0) size += part / total;
    }
  }
  void rest(const motion::Event& rest) { rests = true, by_parts.event(rest); }
  void impact(const motion::Event& impact) { impacts.push_back(impact), books.impact(impact); }
  /// Whether an impact is so soft that its speed is known to the square root of rounding.
  [[nodiscard]] bool grazes() const {
    return std::any_of(impacts.begin(), impacts.end(),
                       [&](const motion::Event& i) { return std::abs(i.before) < 1e-6 * size; });
  }
  /// The largest of a displacement and velocity and of the impacts' velocities.
  [[nodiscard]] double fastest(const motion::State<double>& state) const {
    double largest = std::max(std::abs(state.x), std::abs(state.v));
    for (const motion::Event& impact : impacts) largest = std::max(largest, std::abs(impact.before));
    return largest;
  }
  void finish(const motion::State<double>& state) { by_parts.finish(state.x, total), books.section(state); }

  double base;
  observables::ExactHarmonics by_parts;
  std::array<Complex, highest + 1> by_quadrature{};
  EnergyBooks books;
  std::vector<motion::Event> impacts{};
  double total, size = 0;  ///< mean of |x|
  bool rests = false;
};

/// The numerator of eq. 38: the terms of the force, the load and the impacts in harmonic k.
struct Shares {
  Complex sum;
  double size;
};

Shares shares_of(const point::Problem& scene, const Period& period, std::size_t k) {
  const auto& [h, f, nu, load, stiffness, shape, paces] = scene.oscillator;
  Shares shares{k == 0 ? Complex(load) : k == 1 ? f * std::polar(0.5, scene.start.phase - std::numbers::pi / 2) : 0, 0};
  shares.size = std::abs(shares.sum);
  for (const motion::Event& impact : period.impacts) {
    const double jump = (impact.after - impact.before) / period.total;
    shares.sum += jump * std::polar(1.0, -period.base * static_cast<double>(k) * impact.time);
    shares.size += std::abs(jump);
  }
  return shares;
}

/// The largest difference of the three ways in units of the allowed one: rounding, for the impacts that of the summed
/// jumps and of the angles, and the distance by which the period fails to close.
double difference_of_harmonics(const point::Problem& scene, const Period& period, double gap) {
  double worst = 0;
  for (std::size_t k = 0; k <= highest; ++k) {
    const double w = period.base * static_cast<double>(k), h = scene.oscillator.damping;
    const Complex z(scene.oscillator.stiffness - w * w, 2 * h * w);
    if (std::norm(z) < 1.0 / 64) continue;
    const auto [sum, size] = shares_of(scene, period, k);
    const double rounding =
        16 * epsilon<double>() * (1 + w * period.total) * (size + period.size * (1 + 2 * h + w) / period.total);
    const double open = 2 * gap * (1 + 2 * h + w) / period.total;
    const double allowed = (rounding + open) / std::abs(z) + 16 * epsilon<double>() * period.size;
    raise(worst, std::abs(sum / z - period.by_quadrature[k]) / allowed);
    raise(worst, std::abs(period.by_parts.displacement()[k] - period.by_quadrature[k]) / allowed);
  }
  return worst;
}

/// The tenth part of the scenes, from a steady state on if one is found within 300 periods.
template <class Check>
void in_steady_scenes(Check&& check) {
  in_every_scene([&](AnyScene any) {
    if (any.index % 10 != 0) return;
    any.scene.time.mode = steady::Mode::steady, any.scene.time.max_periods = 300, any.scene.time.max_impacts = 1e4;
    any.scene.time.tolerance = 1e-13;
    point::with_every_effect(any.scene, [&]<Effects effects>() {
      stepping::Exact<double, effects> integrator(any.scene, limits_of(any.scene));
      check(any, integrator,
            find_steady(integrator, start_of(any.scene), any.scene, any.scene.time, any.scene.integration));
    });
  });
}

/// Whether a period is observed from just before an impact to just after it.
bool begins_with_impact(const point::Problem& scene, const motion::State<double>& from) {
  return (from.x == scene.stops.lower && from.v < 0) || (from.x == scene.stops.upper && from.v > 0);
}

TEST(Properties, harmonics_of_a_periodic_motion_follow_from_its_impacts) {
  Tally closes("a period closes"), harmonics("harmonics from the impacts alone"), energy("work done over a period");
  std::uint64_t settled = 0, periodic = 0;
  in_steady_scenes([&](const AnyScene& any, auto& integrator, const steady::ObservedTime& observed) {
    ++settled, periodic += observed.status == steady::Status::periodic;
    if (observed.status != steady::Status::periodic || observed.found_by == steady::FoundBy::standstill ||
        begins_with_impact(any.scene, observed.from))
      return;
    const double total = observed.turns * integrator.period();
    const bool forced = any.scene.oscillator.forcing != 0;
    Period period(any.scene, observed.from, total,
                  forced ? any.scene.oscillator.frequency : 2 * std::numbers::pi / total);
    motion::State<double> state = observed.from;
    support::Told shown(period);
    const stepping::Outcome outcome = run_for(integrator, state, observed.turns, shown);
    if (outcome != stepping::Outcome::completed) return;  // over budget
    period.finish(state);
    const double gap = std::max(std::abs(state.x - observed.from.x), std::abs(state.v - observed.from.v));
    closes.take(any, gap / (1e-5 * period.fastest(state)));  // if it ends in a graze; others far better
    if (period.rests || period.grazes() || period.impacts.empty()) return;
    harmonics.take(any, difference_of_harmonics(any.scene, period, gap));
    energy.take(any, period.books.left_over() / 1e-11);
  });
  std::cout << settled << " scenes, " << periodic << " periodic\n";
  closes.conclude(0.05), harmonics.conclude(0.01), energy.conclude(0.01);
  if (settled >= Tally::enough / 10) {
    EXPECT_GT(periodic, settled / 2);
  }
}

}  // namespace
}  // namespace clatter::hard::periodic_test
