#include "claims.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <optional>
#include <vector>

#include "deadline.hpp"

namespace verify {

void check_smallest_period(const Certificate& certificate, const Cycle& cycle,
                           const std::function<bool(long parts)>& repeats_after, Report& report) {
  for (long parts = 2; parts <= certificate.periods; ++parts) {
    if (certificate.periods % parts != 0 || cycle.differs_after(static_cast<std::size_t>(parts))) continue;
    try {
      report.add(repeats_after(parts) ? Verdict::refuted : Verdict::undecided,
                 "periods: claimed " + std::to_string(certificate.periods) + ", found " +
                     std::to_string(certificate.periods / parts));
    } catch (const Refuted&) {
      report.add(Verdict::undecided, "whether a smaller period is one");
    }
    return;
  }
}

void require_smallest_period_of_rests(long periods, const Cycle& cycle) {
  const long times = cycle.releases();
  if (times > 1)
    throw Refuted("periods: claimed " + std::to_string(periods) + ", and one stop lets the mass go " +
                  std::to_string(times) + " times in them, each time to the same motion");
}

void check_smallest_period(const Certificate& certificate, const Scene& scene, const Orbit& orbit, const Cycle& cycle,
                           Report& report) {
  if (cycle.releases() > 0 && !scene.loose) return require_smallest_period_of_rests(certificate.periods, cycle);
  const auto repeats = [&](long parts) { return repeats_after(certificate, scene, orbit, static_cast<int>(parts)); };
  check_smallest_period(certificate, cycle, repeats, report);
}

namespace {

/// Whether the claimed letters are the found ones in some rotation, or its first ones.
bool same_word(const Word& claimed, const std::vector<std::string>& found) {
  const std::size_t size = claimed.letters.size(), whole = found.size();
  if (claimed.is_cut ? size >= whole : size != whole) return false;
  for (std::size_t first = 0; first < whole; ++first) {
    require_time();
    std::size_t same = 0;
    while (same < size && claimed.letters[same] == found[(first + same) % whole]) ++same;
    if (same == size) return true;
  }
  return false;
}

/// Motion without impacts that starts on a stop, or beyond a soft one, stays there. A mass that friction holds, and
/// that neither turns nor is held once more in the period, is held for good: what moves has to come back. Nothing if
/// the start may be on either side of a stop.
std::optional<std::string> word_without_impacts(const std::vector<Event>& events, const Scene& scene, const Ball& x) {
  const auto stays = [](Side side) -> std::string { return side == Side::upper ? "(U)" : "(L)"; };
  const auto held = std::ranges::find_if(events, [](const Event& event) { return holds(event.kind); });
  if (scene.tells_walls() && held != events.end() && held->of_wall) return held->side == Side::upper ? "(u)" : "(l)";
  if (events.size() == 1 && events.front().kind == Kind::stick) return "(S)";
  const auto on_stop = std::ranges::find_if(events, [](const Event& event) { return !is_of_friction(event.kind); });
  if (on_stop != events.end()) return stays(on_stop->side);
  for (const Side side : {Side::lower, Side::upper}) {
    const auto& stop = scene.stops[index_of(side)];
    if (!stop) continue;
    const Ball beyond = (x - stop->position) * Ball(sign_of(side));
    if (beyond.is_positive() || beyond.is_zero()) return stays(side);
    if (!beyond.is_negative()) return std::nullopt;
  }
  return "-";
}

}  // namespace

void check_multipliers(const Certificate& certificate, const std::optional<std::vector<Vector>>& found,
                       Report& report) {
  if (!certificate.multipliers) return;
  if (!found) return report.add(Verdict::undecided, "multipliers: whether they are real");
  const auto& claimed = *certificate.multipliers;
  const auto distance = [&](std::size_t i, std::size_t j) {
    return std::hypot(claimed[i][0].ball().near() - (*found)[j].x.near(),
                      claimed[i][1].ball().near() - (*found)[j].y.near());
  };
  std::vector<std::size_t> order(claimed.size()), nearest;
  std::iota(order.begin(), order.end(), 0);
  double least = std::numeric_limits<double>::infinity();
  do {
    double sum = 0;
    for (std::size_t i = 0; i < order.size(); ++i) sum += distance(i, order[i]);
    if (sum < least || nearest.empty()) least = sum, nearest = order;
  } while (std::ranges::next_permutation(order).found);
  for (std::size_t i = 0; i < order.size(); ++i) {
    const Vector& one = (*found)[nearest[i]];
    const std::string name = "multiplier " + std::to_string(i + 1);
    report.compare(name + ", real part", one.x, {claimed[i][0], claimed[i][2]});
    report.compare(name + ", imaginary part", one.y, {claimed[i][1], claimed[i][2]});
  }
}

void check_word(const Certificate& certificate, const Cycle& cycle, const Scene& scene, const Ball& x, Report& report) {
  if (!certificate.word) return;
  const std::vector<std::string> letters = cycle.letters(scene.tells_walls());
  const std::string& claimed = certificate.word->text;
  std::string found;
  for (const std::string& letter : letters) found += letter;
  if (claimed.empty() && letters.empty()) return;  // says nothing of where it stays
  if (letters.empty()) {
    const auto word = word_without_impacts(cycle.events(), scene, x);
    if (!word) return report.add(Verdict::undecided, "word: on which side of a stop the mass stays");
    found = *word;
  }
  if (letters.empty() ? claimed != found : !same_word(*certificate.word, letters))
    report.add(Verdict::refuted, "word: claimed '" + claimed + "', found '" + found + "'");
}

void check_symmetry(const Certificate& certificate, const Scene& scene, const Cycle& cycle,
                    const std::function<bool(const Ball& centre)>& returns_mirrored, Report& report) {
  if (!certificate.symmetric) return;
  const bool claimed = *certificate.symmetric;
  const bool differs = certificate.periods % 2 == 0 || cycle.differs_from_mirror();
  if (differs && claimed) report.add(Verdict::refuted, "symmetric: claimed true, found false");
  if (differs) return;
  const auto centre = mirror_centre(scene);
  if (!centre) return report.add(Verdict::undecided, "symmetric: the scene isn't, to its last digit");
  const bool found = returns_mirrored(*centre);
  if (!found) report.add(Verdict::undecided, "symmetric: neither proved nor refuted");
  if (!claimed && found) report.add(Verdict::refuted, "symmetric: claimed false, found true");
}

void check_symmetry(const Certificate& certificate, const Scene& scene, const Orbit& orbit, const Cycle& cycle,
                    Report& report) {
  const auto is_mirrored = [&](const Ball& centre) {
    return cycle.releases() > 0 && !scene.loose ? cycle.releases_mirrored()
                                                : returns_mirrored(certificate, scene, orbit, centre);
  };
  check_symmetry(certificate, scene, cycle, is_mirrored, report);
}

}  // namespace verify
