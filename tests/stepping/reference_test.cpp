// The impact lists in tests/reference were computed in 50-digit arithmetic, independently of any code here.

#include <gtest/gtest.h>

#include <fstream>
#include <sstream>

#include "math/fifty_digits.hpp"
#include "support/runs.hpp"

namespace clatter::stepping::reference_test {
namespace {

struct Row {
  FiftyDigits time;
  int side;
  FiftyDigits before;
};

struct Reference {
  point::Problem scene;
  std::vector<Row> rows;
};

/// The quoted or bare value that follows `"key": ` from `from` on; moves `from` past it.
std::string value_of(const std::string& json, const std::string& key, std::size_t& from) {
  const std::size_t name = json.find('"' + key + "\": ", from);
  if (name == std::string::npos) return {};
  const std::size_t begin = json.find_first_not_of("\" ", name + key.size() + 3);
  from = json.find_first_of("\",\n", begin);
  return json.substr(begin, from - begin);
}

Reference read_reference(const std::string& name) {
  std::ifstream file(CLATTER_SOURCE "/tests/reference/" + name);
  std::stringstream text;
  text << file.rdbuf();
  const std::string json = text.str();
  const auto parameter = [&](const std::string& key) {
    std::size_t from = json.find("\"params\"");
    return std::stod(value_of(json, key, from));
  };
  Reference reference;
  reference.scene = support::scene_of({parameter("h"), parameter("f"), parameter("nu"), 0.0}, -parameter("g"),
                                      parameter("g"), parameter("R"));
  for (std::size_t from = json.find("\"events\"");;) {
    const std::string time = value_of(json, "t", from);
    if (time.empty()) break;
    const std::string side = value_of(json, "side", from), before = value_of(json, "v_pre", from);
    reference.rows.push_back({FiftyDigits(time), std::stoi(side), FiftyDigits(before)});
  }
  return reference;
}

class ReferenceList : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceList, double_has_every_impact_and_no_other) {
  const Reference reference = read_reference(GetParam());
  ASSERT_EQ(reference.rows.size(), 40u);
  const double last = static_cast<double>(reference.rows.back().time);
  const auto run = support::run_scene(reference.scene, last + 1e-3);
  ASSERT_EQ(run.record.impacts.size(), reference.rows.size());
  for (std::size_t i = 0; i < reference.rows.size(); ++i) {
    const Row& row = reference.rows[i];
    const motion::Event& impact = run.record.impacts[i];
    EXPECT_EQ(sign_of(impact.side), row.side);
    EXPECT_NEAR(impact.time / static_cast<double>(row.time), 1.0, 1e-11) << "impact " << i;
    EXPECT_NEAR(impact.before / static_cast<double>(row.before), 1.0, 1e-11) << "impact " << i;
  }
}

TEST_P(ReferenceList, fifty_digits_agree_with_all_digits_listed) {
  const Reference reference = read_reference(GetParam());
  const double last = static_cast<double>(reference.rows.back().time);
  const auto run = support::run_scene<FiftyDigits>(reference.scene, last + 1e-3);
  ASSERT_EQ(run.record.impacts.size(), reference.rows.size());
  for (std::size_t i = 0; i < reference.rows.size(); ++i) {  // observers are given doubles: half an ulp
    EXPECT_NEAR(run.record.impacts[i].time / static_cast<double>(reference.rows[i].time), 1.0, 2.3e-16);
    EXPECT_NEAR(run.record.impacts[i].before / static_cast<double>(reference.rows[i].before), 1.0, 2.3e-16);
  }
}

INSTANTIATE_TEST_SUITE_P(Lists, ReferenceList, testing::Values("w2_a.json", "w2_b.json"),
                         [](const auto& list) { return std::string(list.param).substr(0, 4); });

}  // namespace
}  // namespace clatter::stepping::reference_test
