#include "observables/contacts/impact_word.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>

#include "point/point.hpp"
#include "support/random.hpp"

namespace clatter::observables::impact_word_test {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity(), pi_ = std::numbers::pi;

/// Impacts written as their stops, "l" and "u" as the beginnings of rests.
std::vector<ImpactWord::Contact> contacts(const std::string& letters) {
  std::vector<ImpactWord::Contact> all;
  for (const char letter : letters) {
    const bool lower = letter == 'L' || letter == 'l', rests = letter == 'l' || letter == 'u';
    all.push_back({0.0, rests ? 0.0 : lower ? -1.0 : 1.0, lower ? Side::lower : Side::upper});
  }
  return all;
}

std::string word(const std::string& letters) { return ImpactWord::word_of(contacts(letters)); }
std::string regime(const std::string& letters, double periods) {
  return ImpactWord::regime_of(contacts(letters), periods);
}

point::PointResult result_of(point::Problem scene) {
  scene.observe.word = true;
  point::ThreadScratch scratch;
  return run_point(scene, scratch);
}

point::Problem scene_of(const Oscillator& oscillator, const Stops& stops, const Start& start = {}) {
  point::Problem scene;
  scene.oscillator = oscillator, scene.stops = stops, scene.start = start;
  return scene;
}

/// h = 0.1, f = -1, R = 0.7 between symmetric stops.
point::Problem paper_scene(double xs, double nu) { return scene_of({0.1, -1.0, nu, 0.0}, {-xs, xs, 0.7, 0.7}); }

TEST(Word, is_the_rotation_that_sorts_first) {
  EXPECT_EQ(word("UL"), "LU");
  EXPECT_EQ(word("ULLUUL"), "LLUULU");
  EXPECT_EQ(word("UUU"), "UUU");
  EXPECT_EQ(word(""), "-");
  support::Random random(1, 0);
  for (int trial = 0; trial < 500; ++trial) {
    std::string letters;
    for (int i = 0; i < 1 + trial % 12; ++i) letters += random.happens(0.5) ? 'L' : 'U';
    const std::string first = word(letters);
    for (std::size_t i = 0; i < letters.size(); ++i) {
      std::rotate(letters.begin(), letters.begin() + 1, letters.end());
      EXPECT_LE(first, letters);
      EXPECT_EQ(word(letters), first);
    }
  }
}

TEST(Word, has_one_sign_for_impacts_that_end_in_rest_wherever_the_period_begins) {
  // two series of impacts that end in rest, on L and on U, with two impacts on U before the flight to L
  std::string letters = "LLLLlUUUuLU";
  for (std::size_t i = 0; i < letters.size(); ++i) {
    std::rotate(letters.begin(), letters.begin() + 1, letters.end());
    EXPECT_EQ(word(letters), "L*U*LU") << letters;
    EXPECT_EQ(regime(letters, 1), "inf/1");
  }
  EXPECT_EQ(word("lULLl"), "L*U");  // the period begins during the rest
  EXPECT_EQ(word("LLllU"), "L*U");  // a summed end of the impacts, then the rest
  EXPECT_EQ(word("Ll"), "L*");
  EXPECT_EQ(word("l"), "(L)");  // it never moves
  EXPECT_EQ(word("uu"), "(U)");
  EXPECT_EQ(regime("l", 1), "0/1");
}

TEST(Word, of_many_impacts_is_cut_but_their_number_is_not) {
  const auto then = [](std::string word, std::string_view end) { return word.append(end); };
  const std::string all = then(std::string(70, 'L'), "U"), longest = then(std::string(63, 'L'), "U");
  EXPECT_EQ(word(all), then(std::string(64, 'L'), "…"));
  EXPECT_EQ(regime(all, 3), "70/3");
  EXPECT_EQ(word(longest), longest);
  EXPECT_EQ(word(then("LLl", std::string(63, 'U'))), then(then("L*", std::string(62, 'U')), "…"));
}

TEST(Word, of_simulated_motion_is_that_of_its_impacts) {
  for (const double nu : {0.5, 0.6, 0.7, 0.85, 1.0, 1.2}) {
    point::Problem scene = paper_scene(1.0, nu);
    scene.observe.impact_log = true;
    const point::PointResult r = result_of(scene);
    ASSERT_EQ(r.status, steady::Status::periodic) << nu;
    std::string letters;
    for (const LoggedImpact& impact : r.log) letters += impact.stop < 0 ? 'L' : 'U';
    EXPECT_EQ(r.impact_word, word(letters)) << nu;
    EXPECT_GE(letters.size(), 2u);
  }
}

TEST(Word, of_chatter_is_the_same_however_its_impacts_are_taken) {
  // the forcing phase of the start is where the observed period begins: in flight, in the chatter, and at rest
  int cuts = 0;
  for (int i = 0; i < 24; ++i) {
    point::Problem scene = paper_scene(0.5, 0.3);
    scene.start.phase = 2 * pi_ * i / 24;
    scene.observe.impact_log = true;
    const point::PointResult r = result_of(scene);
    EXPECT_EQ(r.impact_word, "L*U*") << i;
    EXPECT_EQ(r.regime, "inf/1");
    EXPECT_EQ(r.symmetric, 1.0);
    cuts += r.log.front().stop == r.log.back().stop;
  }
  EXPECT_GT(cuts, 5);  // periods that begin between impacts on one stop
  point::Problem scene = paper_scene(0.5, 0.3);
  scene.integration.method = stepping::Method::dopri5;
  EXPECT_EQ(result_of(scene).impact_word, "L*U*");
}

TEST(Word, tells_motion_that_stays_on_a_stop_from_one_that_meets_none) {
  const auto word_of = [](double f, double load, double kappa, double zeta) {
    Stops stops{-1, 1, 0.5, 0.5};
    stops.stiffness_lower = stops.stiffness_upper = kappa, stops.damping_lower = stops.damping_upper = zeta;
    const point::PointResult r = result_of(scene_of({0.1, f, 0.7, load}, stops, {0.9, 0.0, 0.0}));
    EXPECT_EQ(r.status, steady::Status::periodic);
    EXPECT_EQ(r.regime, f == 0 ? "" : "0/1");
    return r.impact_word;
  };
  for (const double f : {0.0, 0.2}) {
    EXPECT_EQ(word_of(f, 0, infinity, 0), "-") << f;
    EXPECT_EQ(word_of(f, 5, infinity, 0), "(U)") << f;
    EXPECT_EQ(word_of(f, -5, infinity, 0), "(L)") << f;
    EXPECT_EQ(word_of(f, 0, 20, 0.1), "-") << f;
    EXPECT_EQ(word_of(f, 5, 20, 0.1), "(U)") << f;
    EXPECT_EQ(word_of(f, -5, 20, 0.1), "(L)") << f;
  }
}

TEST(Word, tells_motion_that_stays_beyond_a_soft_stop_and_outruns_it) {
  // a stiff spring's stop with a heavy damper loses the mass beyond its position and is met again there
  point::Problem scene = scene_of({0.1, 3.0, 2.5, 3.0}, {-infinity, 0.0, 1, 1});
  scene.stops.stiffness_upper = 1.0, scene.stops.damping_upper = 3.0;
  scene.observe.impacts = true;
  const point::PointResult r = result_of(scene);
  ASSERT_EQ(r.status, steady::Status::periodic);
  ASSERT_GT(r.contact_fraction[1], 0.0);
  ASSERT_LT(r.contact_fraction[1], 1.0);
  EXPECT_EQ(r.impacts_per_period[1], 0.0);
  EXPECT_EQ(r.impact_word, "(U)");
}

TEST(Symmetry, of_a_mirrored_start_is_the_same_and_its_word_is_mirrored) {
  std::size_t asymmetric = 0;
  for (int i = 0; i <= 60; ++i) {
    const double nu = 0.62 + 0.001 * i;  // symmetric, and in between two mirror images
    point::Problem scene = paper_scene(1.45, nu);
    scene.start = {0.1, 0.2, 0.3};
    const point::PointResult r = result_of(scene);
    scene.start = {-0.1, -0.2, 0.3 + pi_};
    const point::PointResult mirrored = result_of(scene);
    if (r.status != steady::Status::periodic || mirrored.status != r.status) continue;
    std::string swapped = r.impact_word;
    for (char& letter : swapped) letter = letter == 'L' ? 'U' : 'L';
    EXPECT_EQ(word(swapped), mirrored.impact_word) << nu;
    EXPECT_EQ(r.regime, mirrored.regime);
    EXPECT_EQ(r.symmetric, mirrored.symmetric);
    asymmetric += r.symmetric == 0.0;
    EXPECT_TRUE(r.symmetric == 0.0 || swapped.size() % 2 == 0) << nu;
  }
  EXPECT_GT(asymmetric, 0u);
}

TEST(Symmetry, is_that_of_the_extrema) {
  int asymmetric = 0;
  for (int i = 0; i <= 100; ++i) {
    point::Problem scene = paper_scene(0.45, 1.0 + 0.005 * i);
    scene.observe.extrema = true;
    const point::PointResult r = result_of(scene);
    if (r.status != steady::Status::periodic) continue;
    const double apart = std::abs(r.v_min + r.v_max);
    EXPECT_EQ(r.symmetric, apart < 1e-6 ? 1.0 : 0.0) << i << ' ' << apart;
    asymmetric += r.symmetric == 0.0;
  }
  EXPECT_GT(asymmetric, 0);
}

TEST(Symmetry, of_motion_without_impacts_is_that_of_its_states) {
  // free and forced together, undamped: cos t has turned into its mirror half a period later if p is odd and n too
  for (const auto& [nu, symmetric] : {std::pair(3.0, 1.0), std::pair(1.5, 0.0), std::pair(2.0, 0.0)}) {
    const point::PointResult r = result_of(scene_of({0.0, 1.0, nu, 0.0}, {-9, 9, 1, 1}, {0.3, 0.0, 0.0}));
    ASSERT_EQ(r.status, steady::Status::periodic) << nu;
    EXPECT_EQ(r.impact_word, "-");
    EXPECT_EQ(r.symmetric, symmetric) << nu;
  }
}

TEST(Symmetry, of_the_steady_response_is_known_without_flights) {
  const Oscillator o{0.1, 1.0, 0.7, 0.0};
  const point::PointResult r = result_of(scene_of(o, {-infinity, infinity, 1, 1}));
  EXPECT_EQ(r.regime, "0/1");
  EXPECT_EQ(r.symmetric, 1.0);
  EXPECT_EQ(result_of(scene_of({0.1, 1.0, 0.7, 0.2}, {-infinity, infinity, 1, 1})).symmetric, 1.0);  // about 0.2
  EXPECT_TRUE(std::isnan(result_of(scene_of(o, {-0.5, infinity, 0.7, 1})).symmetric));
  EXPECT_TRUE(std::isnan(result_of(scene_of(o, {-0.5, 0.5, 0.7, 0.8})).symmetric));
}

TEST(Symmetry, of_free_vibration_and_of_a_mass_at_rest) {
  const point::PointResult free = result_of(scene_of({}, {-0.5, 0.5, 1, 1}, {0.0, 1.0, 0.0}));
  EXPECT_EQ(free.impact_word, "LU");
  EXPECT_EQ(free.regime, "");  // no force, no periods of it
  EXPECT_EQ(free.symmetric, 1.0);
  EXPECT_EQ(result_of(scene_of({}, {-2, 2, 1, 1}, {0.3, 1.0, 0.0})).symmetric, 1.0);
  EXPECT_EQ(result_of(scene_of({0.1, 0.0, 1.0, 0.0}, {-2, 2, 1, 1}, {0.3, 1.0, 0.0})).symmetric, 1.0);
}

TEST(Symmetry, is_about_the_equilibrium_or_without_a_spring_about_the_middle) {
  // the same motion wherever stops, start and equilibrium are moved to, but for rounding
  const auto symmetric = [](double k, double load, double middle, double gap_ratio = 1) {
    const double gap = 0.6;
    return result_of(scene_of({0.1, 1.0, 0.8, load, k}, {middle - gap, middle + gap_ratio * gap, 0.6, 0.6},
                              {middle + 0.1, 0.3, 0.0}))
        .symmetric;
  };
  for (const double k : {0.0, 1.0, 0.3, -0.2}) {
    const double centred = symmetric(k, 0, 0);
    EXPECT_FALSE(std::isnan(centred)) << k;
    for (const double place : {0.1, -0.7, 3.3}) {
      EXPECT_EQ(symmetric(k, k * place, place), centred) << k << ' ' << place;
      EXPECT_TRUE(std::isnan(symmetric(k, k * place + 0.05, place))) << k << ' ' << place;
      if (k != 0) {
        EXPECT_TRUE(std::isnan(symmetric(k, k * place, place, 1.01))) << k << ' ' << place;
      }
    }
  }
}

TEST(Word, of_motion_without_a_period_is_empty) {
  point::Problem scene = paper_scene(3.0, 0.9);
  scene.time.max_periods = 100;
  const point::PointResult r = result_of(scene);
  ASSERT_EQ(r.status, steady::Status::aperiodic);
  EXPECT_EQ(r.impact_word + r.regime, "");
  EXPECT_TRUE(std::isnan(r.symmetric));
}

}  // namespace
}  // namespace clatter::observables::impact_word_test
