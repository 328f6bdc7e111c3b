#include "branches/orbit.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace clatter::branches {
namespace {

using observables::ImpactWord;

Side mirror_image(Side side) { return static_cast<Side>(-sign_of(side)); }

OrbitImpact mirrored(OrbitImpact impact) { return {mirror_image(impact.side), impact.phase, -impact.before}; }

OrbitImpact later(OrbitImpact impact, double advance) {
  impact.phase += advance;
  return impact;
}

std::vector<ImpactWord::Contact> contacts_of(const Orbit& orbit) {
  std::vector<ImpactWord::Contact> contacts;
  for (const OrbitImpact& impact :
       orbit.whole().impacts)  // a graze is an impact, too: without speed it would be a rest
    contacts.push_back({impact.phase, impact.before != 0 ? impact.before : 1.0, impact.side});
  return contacts;
}

}  // namespace

double Orbit::advance() const { return std::numbers::pi * half_turns; }

double Orbit::period_ratio() const { return mirrored ? half_turns : half_turns / 2.0; }

OrbitImpact Orbit::impact(std::size_t i) const {
  if (i < size()) return impacts[i];
  return later(mirrored ? branches::mirrored(impacts[i - size()]) : impacts[i - size()], advance());
}

Orbit Orbit::whole() const {
  if (!mirrored) return *this;
  Orbit orbit{impacts, 2 * half_turns, false};
  for (std::size_t i = 0; i < size(); ++i) orbit.impacts.push_back(impact(size() + i));
  return orbit;
}

Orbit Orbit::twice() const {
  Orbit orbit = whole();
  const std::size_t count = orbit.size();
  for (std::size_t i = 0; i < count; ++i) orbit.impacts.push_back(later(orbit.impacts[i], orbit.advance()));
  orbit.half_turns *= 2;
  return orbit;
}

Orbit Orbit::half_if_same(double tolerance, bool symmetric_scene) const {
  const auto same = [&](const OrbitImpact& a, const OrbitImpact& b) {
    return a.side == b.side && std::abs(a.phase - b.phase) <= tolerance &&
           std::abs(a.before - b.before) <= tolerance * std::max(std::abs(a.before), std::abs(b.before));
  };
  if (size() == 0) return symmetric_scene ? Orbit{{}, 1, true} : Orbit{{}, 2, false};
  if (mirrored || size() % 2 != 0) return *this;
  const auto middle = impacts.begin() + static_cast<std::ptrdiff_t>(size() / 2);
  const Orbit half{{impacts.begin(), middle}, half_turns / 2, half_turns / 2 % 2 != 0};  // the force turns, too
  if (half.mirrored && !symmetric_scene) return *this;
  for (std::size_t i = half.size(); i < size(); ++i)
    if (!same(half.impact(i), impacts[i])) return *this;
  return half.half_if_same(tolerance, symmetric_scene);
}

Orbit Orbit::with(const OrbitImpact& impact, std::size_t after) const {
  Orbit orbit = *this;
  orbit.impacts.insert(orbit.impacts.begin() + static_cast<std::ptrdiff_t>(after), impact);
  return orbit;
}

Orbit Orbit::without(std::size_t i) const {
  Orbit orbit = *this;
  orbit.impacts.erase(orbit.impacts.begin() + static_cast<std::ptrdiff_t>(i));
  return orbit;
}

std::string Orbit::word() const { return ImpactWord::word_of(contacts_of(*this)); }
std::string Orbit::regime() const { return ImpactWord::regime_of(contacts_of(*this), period_ratio()); }

Orbit orbit_of(const attractors::Round& round, double nu) {
  Orbit orbit{{}, 2 * static_cast<int>(round.orbit.periods), false};
  for (const auto& contact : round.contacts) orbit.impacts.push_back({contact.side, nu * contact.time, contact.before});
  return orbit;
}

}  // namespace clatter::branches
