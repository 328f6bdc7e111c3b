#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "plan/bounds.hpp"
#include "plan/memory_need.hpp"
#include "plan/reasons.hpp"
#include "sweep/run.hpp"

namespace clatter::plan {

/// Points that call for equal effects.
struct Group {
  Effects effects;
  std::size_t points = 0;
  std::size_t example = 0;      ///< the point whose reasons are given: the one that comes closest to a stop
  std::vector<Reason> reasons;  ///< of that point
  Bounds periods;               ///< forcing periods to simulate, all points together
  Bounds seconds;               ///< on one thread, from short measurements of the compiled set of effects and of lanes
};

/// The plan of a sweep, or of a shard of it: its groups, work and memory, known before anything runs.
struct Plan {
  std::optional<results::Shard> shard;
  std::size_t points = 0;
  std::optional<std::size_t> sampled_points;  ///< points that were examined, so counts are estimates; empty: all were
  std::size_t mirror_images = 0;              ///< points whose results follow from others', and aren't simulated
  std::size_t chains = 0;                     ///< number of independent chains
  std::vector<std::string> observed;          ///< the observables, e.g. "harmonics 0 ... 3 by FFT of 4096 samples"
  std::vector<Group> groups;                  ///< the cheapest compiled set of effects first
  MemoryNeed need;                            ///< the need of a run
  double available_memory = 0.0;              ///< memory that a run may have
  std::vector<std::string> warnings;          ///< settings that look unintended, and the remedy
};

/// Groups the points by the effects that they call for and estimates the work of a run with these options, whose number
/// of threads is known; runs none of them, and examines a million at most. `need` is the need of the run, which the
/// caller has checked before.
[[nodiscard]] Plan plan_of(const sweep::Sweep& sweep, const sweep::RunOptions& options, const MemoryNeed& need,
                           const std::optional<results::Shard>& shard = {});

/// A compiled set of effects in words, e.g. "light damping, forcing, impacts".
[[nodiscard]] std::string effect_set_name(const Effects& effects);

}  // namespace clatter::plan
