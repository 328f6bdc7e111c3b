#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <numbers>
#include <vector>

#include "hard/event_match.hpp"
#include "hard/machine.hpp"

/// For tests of the simulator against closed forms.
namespace clatter::hard::machine_checks {

using Told = ToldEvent::Kind;
using Real = ToldEvent::Real;

inline constexpr Real pi = std::numbers::pi_v<Real>;

inline MachineRun run_of(const MachineScene& scene, Real duration) {
  return run_machine(scene, static_cast<double>(duration), 10000);
}
inline std::vector<ToldEvent> those(const MachineRun& run, Told kind, Side side = Side::none) {
  std::vector<ToldEvent> found;
  const auto all = told_events(run);
  std::copy_if(all.begin(), all.end(), std::back_inserter(found),
               [&](const ToldEvent& event) { return event.kind == kind && event.side == side; });
  return found;
}
/// The only event of a run.
inline ToldEvent only(const MachineRun& run, Told kind, Side side = Side::none) {
  const auto all = told_events(run);
  EXPECT_EQ(all.size(), 1u);
  const ToldEvent event = all.empty() ? ToldEvent{kind} : all[0];
  EXPECT_EQ(event.kind, kind);
  EXPECT_EQ(event.side, side);
  return event;
}

inline void expect_near(Real value, Real expected, Real tolerance = 1e-15L) {
  EXPECT_LE(std::abs(value - expected), tolerance * (1 + std::abs(expected)))
      << static_cast<double>(value) << " for " << static_cast<double>(expected);
}
/// Without a force and a load, what was there is lost to damper, impacts and friction.
inline void expect_loss(const MachineRun& run) {
  expect_near(run.stored + run.damped + run.struck + run.rubbed, 0, 1e-17L);
}

}  // namespace clatter::hard::machine_checks
