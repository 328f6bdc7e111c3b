// Two terms that are huge and cancel: the response at and near resonance.

#include <gtest/gtest.h>

#include <cmath>

#include "hard/measure.hpp"

namespace clatter::hard::resonance_test {
namespace {

TEST(Resonance, agrees_with_fifty_digits) { expect_agreement("resonance"); }

TEST(Resonance, grows_as_its_closed_form_and_is_approached_continuously) {
  const Case& one = case_of("resonance", "h = 0, nu = 1");
  for (double tau : {1.0, 10.0, 200 * pi<double>()}) {
    const double expected = -(tau * std::cos(tau) - std::sin(tau)) / 2;
    for (double h : {0.0, 1e-300, 1e-17})
      for (double nu : {std::nextafter(1.0, 0.0), 1.0, std::nextafter(1.0, 2.0)}) {
        point::Problem scene = one.scene;
        scene.oscillator.damping = h, scene.oscillator.frequency = nu;
        // relative to tau/2: h = 1e-17 and an ulp of nu each change it by 1e-16 tau, the duration's rounding by tau
        // ulps
        EXPECT_NEAR(accuracy::record_of(scene, tau).x, expected, 1e-12 * tau / 2)
            << "h = " << h << ", nu - 1 = " << nu - 1;
      }
  }
}

}  // namespace
}  // namespace clatter::hard::resonance_test
