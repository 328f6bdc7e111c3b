#include "observables/harmonics/exact_harmonics.hpp"

#include <gtest/gtest.h>

#include <boost/math/quadrature/gauss.hpp>
#include <numbers>

#include "observables/arc_of.hpp"
#include "observables/contacts/impact_log_observer.hpp"
#include "observables/runs.hpp"

namespace clatter::observables::harmonics_test {
namespace {

using Complex = std::complex<double>;

/// Harmonics 0 ... K of a scene's observed time, from its arcs; log gets the impacts.
ExactHarmonics harmonics_of(const point::Problem& scene, std::size_t highest, ImpactLog::Observer& log, double& total) {
  std::optional<ExactHarmonics> harmonics;
  total = observe(scene, [&](double length, auto run) {
    harmonics.emplace(highest,
                      scene.oscillator.forcing == 0.0 ? 2 * std::numbers::pi / length : scene.oscillator.frequency);
    const auto end = run(*harmonics, log);
    harmonics->finish(end.x, length);
  });
  return *harmonics;
}

TEST(Harmonics, equal_those_of_the_impacts_alone) {
  // check 6: X_k = [F_k + load_k + (1/T) sum (v+ - v-) e^{-ik Omega tau}] / (1 - k^2 Omega^2 + 2ihk Omega)
  const struct {
    double xs, R, nu, load;
  } scenes[] = {{0.5, 0.7, 1.0, 0.0}, {0.3, 0.7, 1.0, 0.0}, {0.6, 0.8, 1.3, 0.1}, {3.0, 0.7, 0.868, 0.0}};
  for (const auto& [xs, R, nu, load] : scenes) {
    point::Problem scene = paper_scene(xs, R, nu);
    scene.oscillator.load = load;
    ImpactLog::Observer log;
    double total = 0.0;
    const ExactHarmonics harmonics = harmonics_of(scene, 6, log, total);
    ASSERT_FALSE(log.impacts().empty());
    for (std::size_t k = 0; k <= 6; ++k) {
      const double w = nu * static_cast<double>(k);
      Complex sum = k == 0   ? Complex(load)
                    : k == 1 ? Complex(0, 0.5)
                             : Complex(0);  // f = -1: -sin = Re(i e^{i nu tau})
      for (const LoggedImpact& impact : log.impacts())
        sum += (impact.after - impact.before) / total * std::polar(1.0, -w * impact.time);
      const Complex expected = sum / Complex(1 - w * w, 0.2 * w);
      // settled to 1e-14, and a factor of |v|/|Z| <= 5 for both
      EXPECT_LT(std::abs(harmonics.displacement()[k] - expected), 1e-12) << "nu = " << nu << ", k = " << k;
      EXPECT_LT(std::abs(harmonics.velocity()[k] - Complex(0, w) * expected), 1e-12 * std::max(1.0, w))
          << "nu = " << nu << ", k = " << k;
    }
  }
}

TEST(Harmonics, of_free_vibration_between_stops_have_their_closed_form) {
  // check 2; V = 0.7501 is a hair past touching, where k Omega is nearly 1: the resonance of the undamped oscillator
  const double g = 0.75;
  for (double V : {0.7501, 0.8, 1.0, 1.5, 3.0}) {
    ImpactLog::Observer log;
    double total = 0.0;
    const ExactHarmonics harmonics = harmonics_of(conservative_scene(g, V), 5, log, total);
    const double T1 = 2 * std::asin(g / V), omega = std::numbers::pi / T1, speed = std::sqrt((V - g) * (V + g));
    const auto part = [&](double rate) { return rate == 0 ? T1 / 2 : std::sin(rate * T1 / 2) / rate; };
    for (int k = 0; k <= 5; ++k) {
      const double b = k % 2 == 0 ? 0.0 : 2 * V / T1 * (part(1 - k * omega) - part(1 + k * omega));
      const double amplitude = (k == 0 ? 1 : 2) * std::abs(harmonics.displacement()[static_cast<std::size_t>(k)]);
      EXPECT_NEAR(amplitude, std::abs(b), 1e-14 / speed) << "V = " << V << ", k = " << k;  // the period's conditioning
      const double velocity = (k == 0 ? 1 : 2) * std::abs(harmonics.velocity()[static_cast<std::size_t>(k)]);
      EXPECT_NEAR(velocity, k * omega * std::abs(b), 3e-14 / speed) << "V = " << V << ", k = " << k;
    }
  }
}

TEST(Harmonics, quadrature_at_a_resonance_and_integration_by_parts_agree) {
  // the same lightly damped motion, seen at frequencies just either side of the switch between the two
  point::Problem scene = paper_scene(1.0, 0.7, 0.6);
  scene.oscillator.damping = 0.01;
  scene.time.mode = steady::Mode::transient;
  scene.time.duration = 37.0;
  const double edge = std::sqrt(1 - 1.0 / 8);  // |Z| = 1/8 up to h^2
  const auto at = [&](double w) {
    std::optional<ExactHarmonics> harmonics;
    observe(scene, [&](double length, auto run) {
      harmonics.emplace(1, w);
      harmonics->finish(run(*harmonics).x, length);
    });
    return harmonics->displacement()[1];
  };
  const double step = 1e-3;
  const Complex predicted =
      3.0 * at(edge - 2 * step) - 3.0 * at(edge - 3 * step) + at(edge - 4 * step);  // parabola through one side
  EXPECT_LT(std::abs(predicted - at(edge - step)), 1e-3);                           // is smooth there,
  const Complex below = at(edge - 1e-9), above = at(edge + 1e-9);
  EXPECT_LT(std::abs(below - above), 1e-9 * 37);  // and continues without a jump: |dX/dw| <= the length of the run
}

TEST(Harmonics, of_velocity_know_the_beginning_that_comes_later_by_rounding) {
  // an impact at the very beginning is passed before anything is seen, so the first arc begins at 1e-15
  constexpr Effects effects{.damping = Damping::light, .forcing = Forcing::regular};
  const motion::ArcConstants<double, effects> constants({0.1, 1.0, 1.3, 0.0});
  const auto arc = arc_of(constants, 0.4, -0.3);
  const double length = 2.0;
  const auto from = [&](double begin) {
    ExactHarmonics harmonics(3, 1.3);
    harmonics.arc(arc, begin, length);
    harmonics.finish(arc.at(length).x, length);
    return harmonics.velocity();
  };
  const std::vector<Complex> at_once = from(0.0), later = from(1e-15);
  for (std::size_t k = 0; k <= 3; ++k) EXPECT_LT(std::abs(later[k] - at_once[k]), 1e-14) << k;
}

TEST(Harmonics, see_rests_too) {
  // a mass held on the upper stop all the time: constant part = its place, nothing else
  point::Problem scene = paper_scene(0.5, 0.5, 1.0);
  scene.oscillator.load = 3.0;
  scene.start.displacement = 0.5;
  ImpactLog::Observer log;
  double total = 0.0;
  const ExactHarmonics harmonics = harmonics_of(scene, 2, log, total);
  EXPECT_NEAR(harmonics.displacement()[0].real(), 0.5, 1e-15);
  for (std::size_t k : {1u, 2u}) EXPECT_LT(std::abs(harmonics.displacement()[k]), 1e-15);
}

/// f <x' sin(nu tau)> - 2h <x'^2> times the length, by Gauss-Legendre panels.
struct Work {
  double input = 0.0, friction = 0.0, impacts = 0.0;
  const point::Problem& scene;

  template <class A>
  void arc(const A& arc, double, double length) {
    using Rule = boost::math::quadrature::gauss<double, 20>;
    const int panels = 1 + static_cast<int>(length * 2);
    for (int panel = 0; panel < panels; ++panel)
      for (double sign : {-1.0, 1.0})
        for (std::size_t i = 0; i < Rule::abscissa().size(); ++i) {
          const double half = length / panels / 2, s = (2 * panel + 1 + sign * Rule::abscissa()[i]) * half;
          const auto m = arc.at(s);
          input += half * Rule::weights()[i] * scene.oscillator.forcing * m.v * m.sine;
          friction += half * Rule::weights()[i] * 2 * scene.oscillator.damping * m.v * m.v;
        }
  }
  void event(const motion::Event& event) {
    if (event.kind == motion::Event::Kind::impact)
      impacts += (event.before * event.before - event.after * event.after) / 2;
  }
};

TEST(Harmonics, energy_of_a_periodic_motion_balances) {
  for (double xs : {0.3, 0.5}) {  // check 7
    const point::Problem scene = paper_scene(xs, 0.7, 1.0);
    Work work{.scene = scene};
    observe(scene, [&](double, auto run) { run(work); });
    EXPECT_GT(work.impacts, 0.1);
    EXPECT_NEAR(work.input, work.friction + work.impacts, 1e-13);
  }
}

}  // namespace
}  // namespace clatter::observables::harmonics_test
