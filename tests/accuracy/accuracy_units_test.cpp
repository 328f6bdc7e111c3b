#include <gtest/gtest.h>

#include <cmath>
#include <string_view>

#include "accuracy/accuracies.hpp"
#include "accuracy/accuracy_dataset.hpp"
#include "sweep/sweep.hpp"

namespace clatter::accuracy::accuracy_units_test {
namespace {

/// The same motion in units of time so many times shorter: frequencies are as many times higher.
point::Problem in_shorter_units(point::Problem scene, double times) {
  const Oscillator& o = scene.oscillator;
  const double square = times * times;
  scene.oscillator = {o.damping * times, o.forcing * square, o.frequency * times, o.load * square,
                      o.stiffness * square};
  scene.start.velocity *= times, scene.time.duration /= times;
  return scene;
}

PointAccuracy accuracy_of(const point::Problem& scene) {
  const point::Problem computed = problem_at(sweep::Sweep{.problem = scene}, 0);
  return measure_accuracy(computed, one_of_each(), {.rounds = 0});
}

void expect_same(const PointAccuracy& a, const PointAccuracy& b) {
  for (const auto& [name, long_name, value] : point_variables()) {
    EXPECT_TRUE(a.*value == b.*value || (std::isnan(a.*value) && std::isnan(b.*value))) << name;
  }
  ASSERT_EQ(a.rows.size(), b.rows.size());
  for (std::size_t i = 0; i < a.rows.size(); ++i)
    for (const auto& [name, long_name, value] : row_variables()) {
      if (std::string_view(name).starts_with("ns_")) continue;
      const double one = a.rows[i].*value, other = b.rows[i].*value;
      EXPECT_TRUE(one == other || (std::isnan(one) && std::isnan(other)))
          << name << ' ' << i << ' ' << one << ' ' << other;
    }
}

/// With k > 0 the computed numbers are those of k = 1 to the last bit, as powers of 2 have no rounding: a table that
/// told them in a unit of the scene would differ.
TEST(Accuracy, of_a_scene_is_that_of_the_same_scene_in_other_units) {
  point::Problem transient = smooth_scene(), unforced = smooth_scene();
  transient.time.mode = unforced.time.mode = steady::Mode::transient;
  transient.time.duration = 25.0, unforced.time.duration = 40.0;
  unforced.oscillator.forcing = 0, unforced.start.velocity = 2.0;
  for (const point::Problem& scene : {smooth_scene(), chattering_scene(), transient, unforced}) {
    const PointAccuracy known = accuracy_of(scene);
    ASSERT_GT(known.impacts, 0);
    for (const double times : {2.0, 0.5}) expect_same(known, accuracy_of(in_shorter_units(scene, times)));
  }
}

/// Without a spring the numbers of the user are computed with, and yet a factor has no part in the table.
TEST(Accuracy, without_a_spring_has_no_units_either) {
  point::Problem scene = smooth_scene();
  scene.oscillator.stiffness = 0.0;
  const PointAccuracy known = accuracy_of(scene), other = accuracy_of(in_shorter_units(scene, 2.0));
  ASSERT_GT(known.impacts, 0);
  const WorkPrecision &one = row_of(known, TestedMethod::exact), &two = row_of(other, TestedMethod::exact);
  EXPECT_EQ(known.impacts, other.impacts);
  EXPECT_EQ(known.horizon, other.horizon);
  for (const double error : {one.contact_time, one.contact_speed, one.extrema, one.harmonics, one.v_harmonics,
                             two.contact_time, two.contact_speed, two.extrema, two.harmonics, two.v_harmonics})
    EXPECT_LT(error, 1e-12);
}

}  // namespace
}  // namespace clatter::accuracy::accuracy_units_test
