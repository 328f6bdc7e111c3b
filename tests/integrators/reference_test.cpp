// The impact lists in tests/reference were computed in 50-digit arithmetic, independently of any code here.

#include <gtest/gtest.h>

#include <fstream>
#include <regex>
#include <sstream>

#include "integrators/runs.hpp"
#include "numbers/fifty_digits.hpp"

namespace clatter {
namespace {

struct Row {
  FiftyDigits time;
  int side;
  FiftyDigits before;
};

struct Reference {
  Scene scene;
  std::vector<Row> rows;
};

Reference read_reference(const std::string& name) {
  std::ifstream file(CLATTER_SOURCE "/tests/reference/" + name);
  std::stringstream text;
  text << file.rdbuf();
  const std::string json = text.str();
  const auto number = [&](const std::string& key) {
    std::smatch match;
    EXPECT_TRUE(std::regex_search(json, match, std::regex("\"" + key + "\": \"([^\"]+)\""))) << key << " in " << name;
    return std::stod(match[1]);
  };
  Reference reference;
  reference.scene = scene_of({number("h"), number("f"), number("nu"), 0.0}, -number("g"), number("g"), number("R"));
  const std::regex row("\"t\": \"([^\"]+)\",\\s*\"side\": (-?1),\\s*\"v_pre\": \"([^\"]+)\"");
  for (auto match = std::sregex_iterator(json.begin(), json.end(), row); match != std::sregex_iterator(); ++match)
    reference.rows.push_back({FiftyDigits((*match)[1].str()), std::stoi((*match)[2]), FiftyDigits((*match)[3].str())});
  return reference;
}

class ReferenceList : public testing::TestWithParam<const char*> {};

TEST_P(ReferenceList, double_has_every_impact_and_no_other) {
  const Reference reference = read_reference(GetParam());
  ASSERT_EQ(reference.rows.size(), 40u);
  const double last = static_cast<double>(reference.rows.back().time);
  const auto run = run_scene(reference.scene, last + 1e-3);
  ASSERT_EQ(run.record.impacts.size(), reference.rows.size());
  for (std::size_t i = 0; i < reference.rows.size(); ++i) {
    const Row& row = reference.rows[i];
    const Impact& impact = run.record.impacts[i];
    EXPECT_EQ(sign_of(impact.side), row.side);
    EXPECT_NEAR(impact.time / static_cast<double>(row.time), 1.0, 1e-11) << "impact " << i;
    EXPECT_NEAR(impact.before / static_cast<double>(row.before), 1.0, 1e-11) << "impact " << i;
  }
}

TEST_P(ReferenceList, fifty_digits_agree_with_all_digits_listed) {
  const Reference reference = read_reference(GetParam());
  const double last = static_cast<double>(reference.rows.back().time);
  const auto run = run_scene<FiftyDigits>(reference.scene, last + 1e-3);
  ASSERT_EQ(run.record.impacts.size(), reference.rows.size());
  for (std::size_t i = 0; i < reference.rows.size(); ++i) {  // observers see doubles: half an ulp
    EXPECT_NEAR(run.record.impacts[i].time / static_cast<double>(reference.rows[i].time), 1.0, 2.3e-16);
    EXPECT_NEAR(run.record.impacts[i].before / static_cast<double>(reference.rows[i].before), 1.0, 2.3e-16);
  }
}

INSTANTIATE_TEST_SUITE_P(Lists, ReferenceList, testing::Values("w2_a.json", "w2_b.json"),
                         [](const auto& list) { return std::string(list.param).substr(0, 4); });

}  // namespace
}  // namespace clatter
