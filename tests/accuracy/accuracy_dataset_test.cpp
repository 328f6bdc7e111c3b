#include "accuracy/accuracy_dataset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <set>
#include <string>

#include "accuracy/accuracies.hpp"
#include "sweep/figures.hpp"

namespace clatter::accuracy::accuracy_dataset_test {
namespace {

const AccuracyOptions once{.rounds = 1};

using Names = std::vector<std::string>;

std::size_t length_of(const results::ValueArray& column) {
  return std::visit([](const auto& all) { return all.size(); }, column);
}

/// A sweep, and the accuracy run of its points.
struct MeasuredSweep {
  sweep::Sweep sweep;
  std::vector<PointAccuracy> points;
};

MeasuredSweep two_points() {
  MeasuredSweep all{sweep::sweep_of(smooth_scene(), {{Parameter("nu"), {0.9, 1.0}}}), {}};
  for (std::size_t i = 0; i < 2; ++i)
    all.points.push_back(measure_accuracy(problem_at(all.sweep, i), one_of_each(), once));
  return all;
}

TEST(AccuracyDataset, has_the_axes_and_then_the_rows) {
  const auto [sweep, points] = two_points();
  const results::Dataset dataset = accuracy_dataset(sweep, points);
  ASSERT_EQ(dataset.dimensions.size(), 2u);
  EXPECT_EQ(dataset.dimensions[0].name, "nu");
  EXPECT_EQ(dataset.dimensions[0].length, 2u);
  EXPECT_EQ(dataset.dimensions[1].name, "row");
  EXPECT_EQ(dataset.dimensions[1].length, one_of_each().size());
  std::set<std::string> names;
  for (const results::Variable& variable : dataset.variables) {
    EXPECT_TRUE(names.insert(variable.name).second) << variable.name << " is there twice";
    EXPECT_FALSE(variable.long_name.empty());
    EXPECT_EQ(variable.units, "1");
    std::size_t expected = 1;
    for (const std::string& dimension : variable.dimensions) expected *= dimension == "nu" ? 2 : one_of_each().size();
    EXPECT_EQ(length_of(variable.values), expected) << variable.name;
  }
  EXPECT_EQ(find(dataset, "nu")->dimensions, Names{"nu"});
  for (const char* name : {"method", "setting", "arch"}) EXPECT_EQ(find(dataset, name)->dimensions, Names{"row"});
  for (const PointVariable& variable : point_variables())
    EXPECT_EQ(find(dataset, variable.name)->dimensions, Names{"nu"});
  for (const RowVariable& variable : row_variables())
    EXPECT_EQ(find(dataset, variable.name)->dimensions, (Names{"nu", "row"}));
  EXPECT_EQ(find(dataset, "status")->dimensions, (Names{"nu", "row"}));
  EXPECT_EQ(names.size(), 5 + point_variables().size() + row_variables().size());  // nu, method, setting, arch, status
}

TEST(AccuracyDataset, has_the_variables_of_the_contract) {
  const auto [sweep, points] = two_points();
  const results::Dataset dataset = accuracy_dataset(sweep, points);
  for (const char* name : {"method", "setting", "arch", "error_contact_time", "error_contact_speed", "missed",
                           "doubled", "error_extrema", "error_harmonics", "ns_per_period", "ns_spread"})
    EXPECT_NE(find(dataset, name), nullptr) << name;
}

TEST(AccuracyDataset, holds_the_numbers_of_the_points_in_their_order) {
  const auto [sweep, points] = two_points();
  const results::Dataset dataset = accuracy_dataset(sweep, points);
  const std::size_t rows = one_of_each().size();
  EXPECT_EQ(values(dataset, "nu"), (std::vector{0.9, 1.0}));
  const auto same = [](double a, double b) { return a == b || (std::isnan(a) && std::isnan(b)); };
  for (std::size_t i = 0; i < 2; ++i) {
    for (const PointVariable& variable : point_variables())
      EXPECT_TRUE(same(values(dataset, variable.name)[i], points[i].*variable.value)) << variable.name;
    for (std::size_t row = 0; row < rows; ++row) {
      for (const RowVariable& variable : row_variables())
        EXPECT_TRUE(same(values(dataset, variable.name)[i * rows + row], points[i].rows[row].*variable.value))
            << variable.name << ' ' << i << ' ' << row;
      EXPECT_EQ(statuses(dataset)[i * rows + row], static_cast<std::uint8_t>(points[i].rows[row].status));
    }
  }
  EXPECT_NE(values(dataset, "error_extrema")[0], values(dataset, "error_extrema")[rows]);  // two different points
}

TEST(AccuracyDataset, names_its_methods) {
  const auto [sweep, points] = two_points();
  const results::Dataset dataset = accuracy_dataset(sweep, points);
  const results::Variable& method = *find(dataset, "method");
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(method.values), (std::vector<std::uint8_t>{0, 1, 2, 3, 4, 5, 6}));
  ASSERT_EQ(method.attributes.size(), 2u);
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(method.attributes[0].second).size(), method_names.size());
  EXPECT_EQ(std::get<std::string>(method.attributes[1].second),
            "exact dopri5 moreau harmonics_exact harmonics_fft steady steady_repetition");
  EXPECT_TRUE(std::isnan(values(dataset, "setting")[0]));
  EXPECT_EQ(values(dataset, "setting")[4], 1024.0);
}

TEST(AccuracyDataset, names_the_instruction_set_of_each_row) {
  PointAccuracy point;
  for (const lanes::InstructionSet arch :
       {lanes::InstructionSet::scalar, lanes::InstructionSet::avx512, lanes::InstructionSet::sse2})
    point.rows.push_back({.trial = {TestedMethod::exact, no_setting, arch}});
  const results::Dataset dataset = accuracy_dataset(sweep::sweep_of(smooth_scene(), {}), {point});
  const results::Variable& arch = *find(dataset, "arch");
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(arch.values), (std::vector<std::uint8_t>{0, 3, 1}));
  EXPECT_EQ(std::get<std::vector<std::uint8_t>>(arch.attributes[0].second), (std::vector<std::uint8_t>{0, 1, 2, 3}));
  EXPECT_EQ(std::get<std::string>(arch.attributes[1].second), "scalar sse2 avx2 avx512");
}

TEST(AccuracyDataset, names_linked_axes_as_coordinates) {
  sweep::Sweep sweep = sweep::sweep_of(smooth_scene(), {});
  sweep.dimensions = {{{Parameter("nu"), {0.9, 1.0}}, {Parameter("f"), {1.0, 2.0}}}};
  const results::Dataset dataset = accuracy_dataset(sweep, std::vector<PointAccuracy>(2));
  for (const char* name : {"status", "horizon", "missed"})
    EXPECT_EQ(find(dataset, name)->attributes.back(), (results::Attribute{"coordinates", "f"})) << name;
  for (const char* name : {"nu", "f", "setting"})
    EXPECT_EQ(std::ranges::count(find(dataset, name)->attributes, "coordinates", &results::Attribute::first), 0)
        << name;
}

TEST(AccuracyDataset, of_one_point_has_rows_alone) {
  const sweep::Sweep sweep = sweep::sweep_of(smooth_scene(), {});
  const std::vector<PointAccuracy> points{
      measure_accuracy(smooth_scene(), {{TestedMethod::exact, no_setting}}, {.rounds = 0})};
  const results::Dataset dataset = accuracy_dataset(sweep, points);
  ASSERT_EQ(dataset.dimensions.size(), 1u);
  EXPECT_EQ(dataset.dimensions[0].name, "row");
  EXPECT_EQ(find(dataset, "error_extrema")->dimensions, Names{"row"});
  EXPECT_TRUE(find(dataset, "horizon")->dimensions.empty());
  EXPECT_EQ(values(dataset, "horizon"), std::vector{6.0});
}

TEST(AccuracyDataset, of_two_axes_lets_the_first_vary_slowest) {
  const sweep::Sweep sweep =
      sweep::sweep_of(smooth_scene(), {{Parameter("nu"), {0.9, 1.0}}, {Parameter("R"), {0.5, 0.6, 0.7}}});
  std::vector<PointAccuracy> points(6);
  for (std::size_t i = 0; i < 6; ++i) points[i].horizon = static_cast<double>(i), points[i].rows.resize(2);
  const results::Dataset dataset = accuracy_dataset(sweep, points);
  EXPECT_EQ(find(dataset, "horizon")->dimensions, (Names{"nu", "R"}));
  EXPECT_EQ(find(dataset, "missed")->dimensions, (Names{"nu", "R", "row"}));
  EXPECT_EQ(length_of(find(dataset, "missed")->values), 12u);
  EXPECT_EQ(values(dataset, "horizon"), (std::vector<double>{0, 1, 2, 3, 4, 5}));
}

}  // namespace
}  // namespace clatter::accuracy::accuracy_dataset_test
