// A contact at the end of a run: taken in it, once.

#include <gtest/gtest.h>

#include "hard/measure.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::hard::last_instant_test {
namespace {

TEST(LastInstant, agrees_with_fifty_digits) { expect_agreement("last_instant"); }

TEST(LastInstant, belongs_to_the_run_that_it_ends) {
  const struct {
    const char* what;
    double impacts;
  } rows[] = {{"contact at the end", 2}, {"end 1e-12 later", 2}, {"end 1e-12 sooner", 1}, {"forced, at the end", 1}};
  for (const auto& [what, impacts] : rows) {
    const Case& one = case_of("last_instant", what);
    EXPECT_EQ(accuracy::record_of(one.scene, one.duration).impacts, impacts) << what;
  }
}

TEST(LastInstant, is_not_taken_again_by_the_run_that_goes_on) {
  const Case& one = case_of("last_instant", "contact at the end");
  stepping::Exact<double, effect_sets::complete(Damping::none, Forcing::none)> integrator(one.scene,
                                                                                          limits_of(one.scene));
  motion::State<double> state{0.0, one.scene.start.velocity};
  stepping::NoObserver nobody;
  const double contact = one.duration / integrator.period();
  for (double end : {contact, contact + 1e-6})
    EXPECT_EQ(integrator.advance(state, end, 0, nobody), stepping::Outcome::completed);
  EXPECT_EQ(integrator.impacts(), 2.0);
}

}  // namespace
}  // namespace clatter::hard::last_instant_test
