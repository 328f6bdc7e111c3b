#pragma once

#include <span>
#include <string_view>

#include "config/config.hpp"
#include "sweep/plan.hpp"

namespace clatter {

/// Says on stderr what looks unintended in a configuration, each with its place, but not of sections that a command
/// doesn't go by.
void warn(const Config& config, std::span<const std::string_view> but = {});

/// Says on stderr what looks unintended in a plan.
void warn(const Plan& plan);

/// Says on stderr where a single point may take long, which a plan says, too.
void warn_of_dearest_point(const Sweep& sweep, const std::optional<Shard>& shard);

/// Says on stderr what --set has put in place of the file's.
void say_notes(const Config& config);

/// Puts the warnings of a configuration, each with its place, before those of its plan.
void join_warnings(Plan& plan, const Config& config);

}  // namespace clatter
