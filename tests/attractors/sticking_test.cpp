#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <string>
#include <vector>

#include "sweep/figures.hpp"
#include "sweep/run.hpp"

namespace clatter::attractors::sticking_test {
namespace {

using results::Dataset;
using Numbers = std::vector<std::int32_t>;

point::Problem slide(double forcing, double kinetic, double static_level) {
  point::Problem problem;
  problem.oscillator = {.damping = 0.05, .forcing = forcing, .frequency = 1.3};
  problem.stops = {-0.5, 0.5, 0.7, 0.7};
  problem.friction = {kinetic, static_level};
  problem.observe.attractor = problem.observe.word = true;
  return problem;
}

std::vector<double> starts() {
  std::vector<double> x;
  for (int i = -24; i <= 24; ++i) x.push_back(i / 50.0);
  return x;
}

Dataset attractors_of(const point::Problem& problem, std::vector<sweep::Axis> axes) {
  axes.push_back({Parameter("x0"), starts()});
  return run(sweep::sweep_of(problem, std::move(axes)), {}).dataset;
}

template <class T>
const std::vector<T>& of(const Dataset& dataset, const std::string& name) {
  return std::get<std::vector<T>>(results::find(dataset, name)->values);
}

/// A force of 0.1 moves no mass that 0.7 holds: from each start, |x| < 0.5, it stays where it is.
TEST(Sticking, wherever_friction_holds_the_mass_for_good_is_one_attractor) {
  for (const double force : {0.0, 0.1}) {
    const Dataset dataset = attractors_of(slide(force, 0.2, 0.7), {});
    EXPECT_EQ(of<std::string>(dataset, "motion_word"), std::vector<std::string>{"(S)"}) << force;
    EXPECT_EQ(of<std::int64_t>(dataset, "motion_points")[0], 49) << force;
    EXPECT_TRUE(std::ranges::all_of(of<std::uint8_t>(dataset, "status"), [](int status) { return status == 0; }));
  }
}

TEST(Sticking, the_attractor_keeps_its_number_as_long_as_there_is_a_place_to_stick) {
  const Dataset dataset = attractors_of(slide(0.1, 0.2, 0.7), {{Parameter("load"), {0.0, 0.3, 0.6, 0.9, 1.2}}});
  const auto& numbers = of<std::int32_t>(dataset, "attractor");
  const std::size_t n = starts().size();
  for (std::size_t load = 0; load < 4; ++load)  // |load - x| <= 0.6 somewhere between the stops
    EXPECT_NE(std::find(numbers.begin() + static_cast<std::ptrdiff_t>(load * n),
                        numbers.begin() + static_cast<std::ptrdiff_t>((load + 1) * n), 0),
              numbers.begin() + static_cast<std::ptrdiff_t>((load + 1) * n))
        << load;
  EXPECT_EQ(std::count(numbers.begin() + static_cast<std::ptrdiff_t>(4 * n), numbers.end(), 0), 0);
}

/// From x0 = 0 the mass strikes the upper stop harder, from x0 = 0.1 the lower one.
TEST(Sticking, mirror_images_of_motion_that_sticks_are_told_apart) {
  const Dataset dataset = attractors_of(slide(1.0, 0.2, 0.2), {});
  const auto& numbers = of<std::int32_t>(dataset, "attractor");
  ASSERT_EQ(of<std::int32_t>(dataset, "motion_mirror"), (Numbers{1, 0}));
  const std::vector<double> x = starts();
  const auto number_at = [&](double x0) {
    return numbers[static_cast<std::size_t>(std::ranges::find(x, x0) - x.begin())];
  };
  EXPECT_NE(number_at(0.0), number_at(0.1));
  EXPECT_EQ(std::ranges::count(numbers, undecided), 0);
}

/// Friction 1.05 holds a mass against the force 1 from -0.05 to 0.05; from beyond it creeps to either edge.
TEST(Sticking, each_edge_to_which_the_mass_creeps_is_one_attractor) {
  point::Problem problem = slide(1.0, 1.05, 1.05);
  problem.stops = {-1, 1, 0.7, 0.7};
  const Dataset dataset = attractors_of(problem, {});
  EXPECT_EQ(of<std::int64_t>(dataset, "motion_points"), (std::vector<std::int64_t>{22, 5, 22}));
  EXPECT_EQ(of<std::string>(dataset, "motion_word"), (std::vector<std::string>{"(S)", "(S)", "(S)"}));
  const auto& mirrors = of<std::int32_t>(dataset, "motion_mirror");
  EXPECT_EQ(mirrors[0], 2);
  EXPECT_EQ(mirrors[2], 0);
  const auto& x = of<double>(dataset, "motion_x");
  EXPECT_NEAR(x[0], -0.05, 1e-15);
  EXPECT_NEAR(x[2], 0.05, 1e-15);
  EXPECT_EQ(std::ranges::count(of<std::uint8_t>(dataset, "status"), 5), 44);
}

/// The edges of the band are (load -+ 0.05)/k.
TEST(Sticking, the_edges_keep_their_numbers_as_they_move) {
  point::Problem problem = slide(1.0, 1.05, 1.05);
  problem.stops = {-1, 1, 0.7, 0.7};
  const Dataset dataset = attractors_of(problem, {{Parameter("load"), {0.0, 0.1, 0.2}}});
  const auto& numbers = of<std::int32_t>(dataset, "attractor");
  const std::size_t n = starts().size();
  for (std::size_t load = 0; load < 3; ++load) {
    EXPECT_EQ(numbers[load * n], numbers[0]) << load;
    EXPECT_EQ(numbers[load * n + n - 1], numbers[n - 1]) << load;
  }
  EXPECT_EQ(of<std::string>(dataset, "motion_word").size(), 3);
}

}  // namespace
}  // namespace clatter::attractors::sticking_test
