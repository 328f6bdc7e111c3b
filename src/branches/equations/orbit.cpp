#include "branches/equations/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::branches {
namespace {

using observables::ImpactWord;

Side mirror_image(Side side) { return static_cast<Side>(-sign_of(side)); }

OrbitImpact mirrored(OrbitImpact impact) {
  return {
      mirror_image(impact.side), impact.phase, -impact.before, impact.rest, impact.event, -impact.place, -impact.main};
}

OrbitImpact later(OrbitImpact impact, double advance) {
  impact.phase += advance;
  return impact;
}

std::vector<ImpactWord::Contact> contacts_of(const Orbit& orbit, bool with_sticks = false) {
  std::vector<ImpactWord::Contact> contacts;
  for (const OrbitImpact& impact : orbit.whole().impacts) {
    if (with_sticks && impact.event == EventKind::stick) contacts.push_back({impact.phase, 0.0, Side::none});
    if (!impact.is_letter()) continue;
    const bool grazes = impact.before == 0 && impact.rest == 0;  // an impact, too: without speed it would be a rest
    contacts.push_back({impact.phase, grazes ? 1.0 : impact.before, impact.side});
  }
  return contacts;
}

}  // namespace

double Orbit::advance() const { return std::numbers::pi * half_turns; }

double Orbit::period_ratio() const { return mirrored ? half_turns : half_turns / 2.0; }

bool Orbit::rests() const {
  return std::ranges::any_of(impacts, [](const OrbitImpact& impact) { return impact.rest > 0; });
}

OrbitImpact Orbit::impact(std::size_t i) const {
  if (i < size()) return impacts[i];
  const OrbitImpact before = impact(i - size());
  return later(mirrored ? branches::mirrored(before) : before, advance());
}

Side Orbit::heading_before(std::size_t i) const {
  if (i > 0) return impacts[i - 1].heading();
  const Side last = impacts.back().heading();
  return mirrored ? opposite(last) : last;
}

bool Orbit::meets_soft_stop() const {
  return pressed != Side::none || std::ranges::any_of(impacts, [](const OrbitImpact& impact) {
           return impact.event != EventKind::impact && !branches::halts(impact.event);
         });
}

bool Orbit::halts() const {
  return std::ranges::any_of(impacts, [](const OrbitImpact& impact) { return branches::halts(impact.event); });
}

bool Orbit::changes_nothing(std::size_t i) const {
  const EventKind event = impacts[i].event, before = impacts[(i + size() - 1) % size()].event;
  return event == EventKind::impact || presses(event) == presses(before);
}

Orbit Orbit::from_event(std::size_t i) const {
  Orbit orbit = *this;
  for (std::size_t k = 0; k < size(); ++k) orbit.impacts[k] = impact(i + k);
  return orbit;
}

Orbit Orbit::whole() const {
  if (!mirrored) return *this;
  Orbit orbit{impacts, 2 * half_turns, false};
  for (std::size_t i = 0; i < size(); ++i) orbit.impacts.push_back(impact(size() + i));
  return orbit;
}

Orbit Orbit::mirror_image() const {
  Orbit orbit = *this;
  for (OrbitImpact& impact : orbit.impacts) impact = later(branches::mirrored(impact), std::numbers::pi);
  orbit.pressed = branches::mirror_image(pressed);
  return orbit;
}

Orbit Orbit::repeated(int times) const {
  const Orbit one = whole();
  Orbit orbit{{}, times * one.half_turns, false};
  for (int round = 0; round < times; ++round)
    for (const OrbitImpact& impact : one.impacts) orbit.impacts.push_back(later(impact, round * one.advance()));
  return orbit;
}

Orbit Orbit::half_if_same(double tolerance, bool symmetric_scene) const {
  double farthest = 0, fastest = 0;
  for (const OrbitImpact& impact : impacts)
    farthest = std::max(farthest, std::abs(impact.place)), fastest = std::max(fastest, std::abs(impact.main));
  const auto same = [&](const OrbitImpact& a, const OrbitImpact& b) {
    return a.side == b.side && a.event == b.event && std::abs(a.phase - b.phase) <= tolerance &&
           std::abs(a.before - b.before) <= tolerance * std::max(std::abs(a.before), std::abs(b.before)) &&
           std::abs(a.place - b.place) <= tolerance * farthest && std::abs(a.main - b.main) <= tolerance * fastest;
  };
  if (pressed != Side::none) return {{}, 2, false, pressed};
  if (size() == 0) return symmetric_scene ? Orbit{{}, 1, true} : Orbit{{}, 2, false};
  for (std::size_t times = 2; times <= size(); ++times) {
    const auto parts = static_cast<int>(times);
    if (size() % times != 0 || half_turns % parts != 0 || (mirrored && times % 2 == 0)) continue;
    const auto end = impacts.begin() + static_cast<std::ptrdiff_t>(size() / times);
    const Orbit part{{impacts.begin(), end}, half_turns / parts, half_turns / parts % 2 != 0};  // the force turns, too
    if (part.mirrored && !symmetric_scene) continue;
    bool all_same = true;
    for (std::size_t i = part.size(); i < size() && all_same; ++i) all_same = same(part.impact(i), impacts[i]);
    if (all_same) return part.half_if_same(tolerance, symmetric_scene);
  }
  return *this;
}

Orbit Orbit::with(const OrbitImpact& impact, std::size_t after) const {
  Orbit orbit = *this;
  orbit.pressed = Side::none;  // from now on the events tell when it is
  orbit.impacts.insert(orbit.impacts.begin() + static_cast<std::ptrdiff_t>(after), impact);
  return orbit;
}

Orbit Orbit::with_event(std::size_t i, EventKind event) const {
  Orbit orbit = *this;
  orbit.impacts[i].event = event;
  return orbit;
}

Orbit Orbit::without(std::size_t i) const {
  if (size() == 1)
    return {{}, mirrored ? 1 : 2, mirrored, impacts[0].event == EventKind::renewal ? impacts[0].side : Side::none};
  Orbit orbit = *this;
  orbit.impacts.erase(orbit.impacts.begin() + static_cast<std::ptrdiff_t>(i));
  return orbit;
}

Orbit Orbit::once_with_graze(std::size_t i, bool symmetric_scene) const {
  const Orbit left = without(i), once = left.half_if_same(1e-6, symmetric_scene);
  if (once.half_turns == half_turns) return *this;
  OrbitImpact graze = impacts[i];
  const double first = once.size() > 0 ? once.impacts[0].phase : 0.0;
  const double repetition = std::floor((graze.phase - first) / once.advance());
  if (once.mirrored && std::remainder(repetition, 2.0) != 0) graze = branches::mirrored(graze);
  graze.phase -= repetition * once.advance();
  const auto later_ones = std::ranges::upper_bound(once.impacts, graze.phase, {}, &OrbitImpact::phase);
  return once.with(graze, static_cast<std::size_t>(later_ones - once.impacts.begin()));
}

/// Motion without a letter whose soft stop is left or meets the mass again does so beyond the stop's position.
std::string Orbit::word(bool with_sticks) const {
  const Side soft = meets_soft_stop() && !impacts.empty() ? impacts.front().side : pressed;
  return ImpactWord::word_of(contacts_of(*this, with_sticks), soft);
}
std::string Orbit::regime() const { return ImpactWord::regime_of(contacts_of(*this), period_ratio()); }

Orbit orbit_of(const attractors::Round& round, double nu, double phase) {
  Orbit orbit{{}, 2 * static_cast<int>(round.orbit.periods), false};
  for (const auto& contact : round.contacts)
    orbit.impacts.push_back({contact.side, phase + nu * contact.time, contact.before});
  return orbit;
}

}  // namespace clatter::branches
