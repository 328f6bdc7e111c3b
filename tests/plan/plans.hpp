#pragma once

#include "plan/plan.hpp"

namespace clatter::plan {

/// The plan of a sweep, or of a shard, with the memory that its run alone takes.
inline Plan plan_of(const sweep::Sweep& sweep, int threads, const std::optional<results::Shard>& shard = {}) {
  return plan_of(sweep, {.threads = threads}, memory_need(sweep, shard, threads), shard);
}

}  // namespace clatter::plan
