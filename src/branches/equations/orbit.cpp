#include "branches/equations/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::branches {
namespace {

using observables::ImpactWord;

Side mirror_image(Side side) { return static_cast<Side>(-sign_of(side)); }

OrbitEvent mirrored(const OrbitEvent& event) {
  OrbitEvent image{mirror_image(event.side),
                   event.phase,
                   -event.before,
                   event.kind,
                   event.rest,
                   -event.place,
                   {-event.other.place, -event.other.before},
                   event.contact};
  if (event.contact) image.contact = mirror_image(*event.contact);
  return image;
}

OrbitEvent later(OrbitEvent event, double advance) {
  event.phase += advance;
  return event;
}

std::vector<ImpactWord::Contact> contacts_of(const Orbit& orbit, const WordLetters& letters) {
  std::vector<ImpactWord::Contact> contacts;
  for (const OrbitEvent& event : orbit.whole().events) {
    if (letters.sticks && event.kind == Event::Kind::stick) contacts.push_back({event.phase, 0.0, Side::none});
    if (!event.is_letter()) continue;
    const bool grazes = event.before == 0 && event.rest == 0;  // an impact, too: without speed it would be a rest
    contacts.push_back({event.phase, grazes ? 1.0 : event.before, event.side, event.is_of_wall() && letters.walls});
  }
  return contacts;
}

}  // namespace

double Orbit::advance() const { return std::numbers::pi * half_turns; }

double Orbit::period_ratio() const { return mirrored ? half_turns : half_turns / 2.0; }

bool Orbit::rests() const {
  return std::ranges::any_of(events, [](const OrbitEvent& event) { return event.rest > 0; });
}

OrbitEvent Orbit::event(std::size_t i) const {
  if (i < size()) return events[i];
  const OrbitEvent before = event(i - size());
  return later(mirrored ? branches::mirrored(before) : before, advance());
}

Side Orbit::heading_before(std::size_t i) const {
  if (i > 0) return events[i - 1].heading();
  const Side last = events.back().heading();
  return mirrored ? opposite(last) : last;
}

bool Orbit::meets_soft_stop() const {
  return pressed != Side::none || std::ranges::any_of(events, [](const OrbitEvent& event) {
           return branches::halts(event.kind) ? event.held_by() != Side::none : !is_impact(event.kind);
         });
}

bool Orbit::meets_walls() const { return std::ranges::any_of(events, &OrbitEvent::is_of_wall); }

bool Orbit::halts() const {
  return std::ranges::any_of(events, [](const OrbitEvent& event) { return branches::halts(event.kind); });
}

bool Orbit::is_of_free_halts() const {
  return std::ranges::all_of(events, branches::halts, &OrbitEvent::kind) && !meets_soft_stop();
}

bool Orbit::changes_nothing(std::size_t i) const {
  const Event::Kind kind = events[i].kind, before = events[(i + size() - 1) % size()].kind;
  return is_impact(kind) || (!branches::halts(kind) && presses(kind) == presses(before));
}

bool Orbit::meets_stops() const { return !std::ranges::all_of(events, &OrbitEvent::is_of_wall); }

Side Orbit::pressed_after(std::size_t i) const {
  for (std::size_t back = 0; back < size(); ++back) {
    const OrbitEvent last = event(i + size() - back);
    if (last.is_of_wall() && !last.contact) continue;
    const Side side = last.contact ? *last.contact : presses(last.kind) ? last.side : Side::none;
    return mirrored ? branches::mirror_image(side) : side;
  }
  return pressed;
}

Orbit Orbit::from_event(std::size_t i) const {
  Orbit orbit = *this;
  for (std::size_t k = 0; k < size(); ++k) orbit.events[k] = event(i + k);
  return orbit;
}

Orbit Orbit::whole() const {
  if (!mirrored) return *this;
  Orbit orbit{events, 2 * half_turns, false};
  for (std::size_t i = 0; i < size(); ++i) orbit.events.push_back(event(size() + i));
  return orbit;
}

Orbit Orbit::mirror_image() const {
  Orbit orbit = *this;
  for (OrbitEvent& event : orbit.events) event = later(branches::mirrored(event), std::numbers::pi);
  orbit.pressed = branches::mirror_image(pressed);
  return orbit;
}

Orbit Orbit::repeated(int times) const {
  const Orbit one = whole();
  Orbit orbit{{}, times * one.half_turns, false};
  for (int round = 0; round < times; ++round)
    for (const OrbitEvent& event : one.events) orbit.events.push_back(later(event, round * one.advance()));
  return orbit;
}

Orbit Orbit::half_if_same(double tolerance, bool symmetric_scene) const {
  double farthest = 0, fastest = 0;  // of halts and of the other mass
  for (const OrbitEvent& event : events) {
    farthest = std::max({farthest, std::abs(event.place), std::abs(event.other.place)});
    fastest = std::max(fastest, std::abs(event.other.before));
  }
  const auto same = [&](const OrbitEvent& a, const OrbitEvent& b) {
    return a.side == b.side && a.kind == b.kind && a.contact == b.contact && std::abs(a.phase - b.phase) <= tolerance &&
           std::abs(a.before - b.before) <= tolerance * std::max(std::abs(a.before), std::abs(b.before)) &&
           std::abs(a.place - b.place) <= tolerance * farthest &&
           std::abs(a.other.place - b.other.place) <= tolerance * farthest &&
           std::abs(a.other.before - b.other.before) <= tolerance * fastest;
  };
  if (pressed != Side::none) return {{}, 2, false, pressed};
  if (size() == 0) return symmetric_scene ? Orbit{{}, 1, true} : Orbit{{}, 2, false};
  for (std::size_t times = 2; times <= size(); ++times) {
    const auto parts = static_cast<int>(times);
    if (size() % times != 0 || half_turns % parts != 0 || (mirrored && times % 2 == 0)) continue;
    const auto end = events.begin() + static_cast<std::ptrdiff_t>(size() / times);
    const Orbit part{{events.begin(), end}, half_turns / parts, half_turns / parts % 2 != 0};  // the force turns, too
    if (part.mirrored && !symmetric_scene) continue;
    bool all_same = true;
    for (std::size_t i = part.size(); i < size() && all_same; ++i) all_same = same(part.event(i), events[i]);
    if (all_same) return part.half_if_same(tolerance, symmetric_scene);
  }
  return *this;
}

Orbit Orbit::with(const OrbitEvent& event, std::size_t after) const {
  Orbit orbit = *this;
  if (!event.is_of_wall()) orbit.pressed = Side::none;  // from now on the events tell when it is
  orbit.events.insert(orbit.events.begin() + static_cast<std::ptrdiff_t>(after), event);
  return orbit;
}

Orbit Orbit::with_kind(std::size_t i, Event::Kind kind) const {
  Orbit orbit = *this;
  orbit.events[i].kind = kind;
  return orbit;
}

Orbit Orbit::without(std::size_t i) const {
  if (size() == 1)
    return {{}, mirrored ? 1 : 2, mirrored, events[0].kind == Event::Kind::renewal ? events[0].side : Side::none};
  Orbit orbit = *this;
  orbit.events.erase(orbit.events.begin() + static_cast<std::ptrdiff_t>(i));
  return orbit;
}

Orbit Orbit::once_with_graze(std::size_t i, bool symmetric_scene) const {
  const Orbit left = without(i), once = left.half_if_same(1e-6, symmetric_scene);
  if (once.half_turns == half_turns) return *this;
  OrbitEvent graze = events[i];
  const double first = once.size() > 0 ? once.events[0].phase : 0.0;
  const double repetition = std::floor((graze.phase - first) / once.advance());
  if (once.mirrored && std::remainder(repetition, 2.0) != 0) graze = branches::mirrored(graze);
  graze.phase -= repetition * once.advance();
  const auto later_ones = std::ranges::upper_bound(once.events, graze.phase, {}, &OrbitEvent::phase);
  return once.with(graze, static_cast<std::size_t>(later_ones - once.events.begin()));
}

/// Motion without a letter whose soft stop is left or meets the mass again does so beyond the stop's position.
std::string Orbit::word(const WordLetters& letters) const {
  const auto first = std::ranges::find_if(events, [](const OrbitEvent& event) { return !branches::halts(event.kind); });
  const Side held = events.empty() ? pressed : events.front().held_by();
  const Side soft = meets_soft_stop() && first != events.end() ? first->side : held;
  return ImpactWord::word_of(contacts_of(*this, letters), soft);
}
std::string Orbit::regime(const WordLetters& letters) const {
  // those of sticks count for nothing
  return ImpactWord::regime_of(contacts_of(*this, {.walls = letters.walls}), period_ratio());
}

Orbit orbit_of(const attractors::Round& round, double nu, double phase) {
  Orbit orbit{{}, 2 * static_cast<int>(round.orbit.periods), false};
  for (const auto& contact : round.contacts)
    orbit.events.push_back({contact.side, phase + nu * contact.time, contact.before});
  return orbit;
}

}  // namespace clatter::branches
