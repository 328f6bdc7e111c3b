#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "dynamics/required_effects.hpp"
#include "sweep/estimate.hpp"
#include "sweep/memory.hpp"
#include "sweep/share.hpp"

namespace clatter {

/// Points that call for equal effects.
struct Group {
  Effects effects;
  std::size_t points = 0;
  std::size_t example = 0;      ///< the point whose reasons are given: the one that leaves the least room before a stop
  std::vector<Reason> reasons;  ///< of that point
  Estimate periods;             ///< forcing periods to simulate, all points together
  Estimate seconds;             ///< on one thread, from a short measurement of the kernel
};

/// What a sweep, or a shard of it, will do, known before anything runs.
struct Plan {
  std::optional<Shard> shard;
  std::size_t points = 0;
  std::optional<std::size_t> sampled_points;  ///< so many were looked at, and counts are estimates; empty: all were
  std::size_t branches = 0;                   ///< of them, so many don't wait for others: the rest follow
  std::vector<std::string> observed;          ///< the observables, e.g. "harmonics 0 ... 3 by FFT of 4096 samples"
  std::vector<Group> groups;                  ///< the cheapest kernel first
  MemoryNeed need;                            ///< of a run
  double machine_bytes = 0.0;                 ///< memory that a run may have
  std::vector<std::string> warnings;          ///< what looks unintended, and the remedy
};

/// Groups the points by the effects that they call for and estimates their work, on so many threads; runs none of them,
/// and looks at a million of them at most.
[[nodiscard]] Plan plan_of(const Sweep& sweep, int threads, const std::optional<Shard>& shard = {});

/// A compiled set of effects in words, e.g. "light damping, forcing, stops, chatter and rest".
[[nodiscard]] std::string kernel_name(const Effects& effects);

/// Whether one set of effects stands before another in lists: that of the cheaper kernel, else any fixed order.
[[nodiscard]] bool cheaper(const Effects& one, const Effects& other);

}  // namespace clatter
