// Motion that never repeats: labelled so, and the same to the last bit however many threads compute it.

#include <gtest/gtest.h>

#include "hard/measure.hpp"
#include "sweep/figures.hpp"

namespace clatter::hard::chaos_test {
namespace {

TEST(Chaos, agrees_with_fifty_digits_while_it_remembers_its_start) { expect_agreement("chaos"); }

TEST(Chaos, is_labelled_aperiodic_and_has_one_set_of_bits) {
  point::Problem scene = case_of("chaos", "xs = 3, nu = 0.95").scene;
  scene.observe.extrema = scene.observe.impact_log = scene.observe.period = true;
  const sweep::Sweep sweep = sweep::sweep_of(scene, {{Parameter("nu"), {0.9, 0.91, 0.92, 0.93, 0.94, 0.95}}});
  const results::Dataset one = run(sweep, {.threads = 1}).dataset;
  for (const std::uint8_t status : statuses(one))
    EXPECT_EQ(status, static_cast<std::uint8_t>(steady::Status::aperiodic));
  for (const double ratio : values(one, "period_ratio")) EXPECT_EQ(ratio, 0.0);
  for (int threads : {2, 3, 4}) expect_same(one, run(sweep, {.threads = threads}).dataset);
}

}  // namespace
}  // namespace clatter::hard::chaos_test
