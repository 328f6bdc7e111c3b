#include "branches/equations/flight.hpp"

#include <gtest/gtest.h>

#include <array>
#include <random>

#include "math/dual.hpp"
#include "math/fifty_digits.hpp"

namespace clatter::branches::flight_test {
namespace {

/// The numbers of a scene that a flight depends on.
template <class Number>
std::array<Number*, 16> numbers_in(SceneNumbers<Number>& p) {
  auto& [h, f, nu, load, k, shape, paces] = p.oscillator;
  auto& [lower, upper, R_lower, R_upper, kappa_lower, kappa_upper, zeta_lower, zeta_upper, motion_lower, motion_upper] =
      p.stops;
  auto& [stops, base, lead, phase] = p.shaking;
  return {&h,     &f,     &nu,        &load,      &k,           &stops,       &base,       &phase,
          &lower, &upper, &R_lower.R, &R_upper.R, &kappa_lower, &kappa_upper, &zeta_lower, &zeta_upper};
}
constexpr std::size_t number_of_h = 0, number_of_k = 4, number_of_stops = 5, number_of_base = 6;

/// A flight and all that it depends on, as variables: its two phases, its velocity, then the numbers of the scene.
constexpr std::size_t of_flight = 3, variables = of_flight + 16;

template <class Number>
struct Flown {
  SceneNumbers<Number> p;
  Flight<Number> flight;

  Number& variable(std::size_t i) {
    if (i == 0) return flight.begin;
    if (i == 1) return flight.coordinate;
    return i == 2 ? flight.end : *numbers_in(p)[i - of_flight];
  }
};

template <class Number>
Flown<Number> flown_of(const FollowedScene& scene, const Flight<double>& flight) {
  return {numbers_of<Number>(scene),
          {flight.from, Number(flight.begin), Number(flight.coordinate), flight.to, Number(flight.end), flight.leaves,
           flight.arrives}};
}

/// Against central differences in 50 digits, whose error is 1e-32.
void expect_derivatives(const FollowedScene& scene, const Flight<double>& flight, bool any_stiffness) {
  using Many = Dual<double, variables>;
  Flown<Many> many = flown_of<Many>(scene, flight);
  for (std::size_t i = 0; i < variables; ++i) many.variable(i).slope[i] = 1;
  const double h = scene.oscillator.damping, k = scene.oscillator.stiffness;
  with_arcs(
      scene,
      [&]<Effects E>() {
        constexpr Effects without_resonance{
            .damping = E.damping, .forcing = Forcing::regular, .stiffness = E.stiffness};
        const FlightEnd<Many> exact = Flights<Many, E>(many.p).fly(many.flight);
        for (std::size_t i = 0; i < variables; ++i) {
          if (i == of_flight + number_of_k && (!any_stiffness || k == 0)) continue;
          if (i == of_flight + number_of_h && h * h == k) continue;
          if (i == of_flight + number_of_stops && scene.shaking.base != 0) continue;
          if (i == of_flight + number_of_base && scene.shaking.stops != 0) continue;
          const auto at = [&](const char* step) {
            Flown<FiftyDigits> one = flown_of<FiftyDigits>(scene, flight);
            one.variable(i) += FiftyDigits(step);
            return Flights<FiftyDigits, without_resonance>(one.p).fly(one.flight);
          };
          const auto ahead = at("1e-16"), behind = at("-1e-16");
          const FiftyDigits width("2e-16");
          const double x = static_cast<double>(FiftyDigits((ahead.beyond - behind.beyond) / width)),
                       v = static_cast<double>(FiftyDigits((ahead.coordinate - behind.coordinate) / width));
          // formulas of free motion have the root of |h^2 - k| in denominators
          const double condition = 1 / std::min(1.0, std::abs(h * h - k) == 0 ? 1.0 : std::abs(h * h - k));
          EXPECT_NEAR(exact.beyond.slope[i], x, 2e-12 * (1 + std::abs(x)) * condition) << i << " k = " << k;
          EXPECT_NEAR(exact.coordinate.slope[i], v, 2e-12 * (1 + std::abs(v)) * condition) << i << " k = " << k;
        }
      },
      any_stiffness);
}

TEST(Flight, has_the_derivatives_that_differences_in_fifty_digits_have) {
  std::mt19937 random(5);
  const auto in = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  for (int i = 0; i < 240; ++i) {
    const double k = i % 4 == 0 ? 1.0 : i % 4 == 1 ? 0.0 : i % 4 == 2 ? in(-2, -0.1) : in(0.1, 4);
    double h = i % 5 == 0 ? 0.0 : i % 3 == 0 ? in(1.1, 2) : in(0.01, 0.9);
    if (k > 0 && std::abs(h * h - k) < 0.1) h = std::sqrt(k + 0.2);
    Scene scene;
    scene.oscillator = {h, in(-2, 2), in(0.2, 4), in(-0.3, 0.3), k};
    scene.stops = {-in(0.2, 2), in(0.2, 2), in(0, 1), in(0, 1)};
    if (i % 3 == 1) scene.shaking.stops = in(-1, 1);
    if (i % 3 == 2) scene.shaking.base = in(-1, 1);
    if (i % 2 == 1) scene.shaking.phase = 0.05 * i;
    const double begin = in(0, 6), end = begin + scene.oscillator.frequency * in(0.05, 6);
    const Side to = i % 7 == 0 ? Side::lower : Side::upper;
    const Flight<double> flight{Side::lower, begin, in(-2, -0.1), to, end};
    expect_derivatives(scene, flight, k != 1 || i % 8 == 0);
  }
}

/// Contacts with soft stops, their interruptions, and what lies between; short ones, too.
TEST(Flight, has_the_derivatives_of_differences_at_soft_stops) {
  std::mt19937 random(7);
  const auto in = [&](double a, double b) { return std::uniform_real_distribution(a, b)(random); };
  const std::array<std::pair<Event::Kind, Event::Kind>, 6> kinds{{{Event::Kind::touch, Event::Kind::separation},
                                                                  {Event::Kind::renewal, Event::Kind::separation},
                                                                  {Event::Kind::separation, Event::Kind::renewal},
                                                                  {Event::Kind::separation, Event::Kind::touch},
                                                                  {Event::Kind::impact, Event::Kind::touch},
                                                                  {Event::Kind::separation, Event::Kind::impact}}};
  for (std::size_t i = 0; i < 180; ++i) {
    const auto [leaves, arrives] = kinds[i % kinds.size()];
    Scene scene;
    scene.oscillator = {in(0.05, 0.4), in(-2, 2), in(0.5, 3), in(-0.3, 0.3), i % 2 == 0 ? 1.0 : in(0.4, 3)};
    scene.stops = {-in(0.2, 1), in(0.2, 1), in(0.3, 0.9), in(0.3, 0.9)};
    const bool from_rigid = leaves == Event::Kind::impact;
    if (!from_rigid) scene.stops.stiffness_lower = in(3, 50), scene.stops.damping_lower = in(0.05, 0.6);
    const bool to_lower = arrives == Event::Kind::separation || arrives == Event::Kind::renewal || i % 12 < 6;
    if (arrives != Event::Kind::impact && !to_lower)
      scene.stops.stiffness_upper = in(3, 50), scene.stops.damping_upper = in(0.05, 0.6);
    if (arrives == Event::Kind::touch && to_lower && from_rigid) continue;
    const bool same_side = to_lower && arrives != Event::Kind::impact;
    const double length = i % 5 == 0 ? in(1e-4, 1e-3) : in(0.05, 2), begin = in(0, 6);
    const double v = leaves == Event::Kind::touch || from_rigid ? in(-2, -0.1) : in(0.1, 1);
    expect_derivatives(scene,
                       {Side::lower, begin, v, same_side ? Side::lower : Side::upper, begin + length, leaves, arrives},
                       i % 2 == 1);
  }
}

/// Near resonance the response is formed together with the free motion.
TEST(Flight, has_the_derivatives_of_differences_near_resonance) {
  for (const double k : {1.0, 0.3, 4.0}) {
    Scene scene;
    scene.oscillator = {0.01, 1.0, std::sqrt(k) * 1.003, 0.1, k};
    scene.stops = {-1.0, 0.7, 0.8, 0.8};
    const Flight<double> flight{Side::lower, 0.3, -0.8, Side::upper, 5.0};
    expect_derivatives(scene, flight, true);
    scene.oscillator.forcing = 0, scene.shaking.base = 1.0;
    expect_derivatives(scene, flight, k != 1);
    scene.shaking = {0.7, 0.0, 0.0};
    expect_derivatives(scene, flight, true);
  }
}

}  // namespace
}  // namespace clatter::branches::flight_test
