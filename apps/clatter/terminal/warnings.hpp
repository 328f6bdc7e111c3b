#pragma once

#include <span>
#include <string_view>

#include "config/config.hpp"
#include "plan/plan.hpp"

namespace clatter::app {

/// Prints the warnings of a configuration to stderr with their locations, except those of sections that the command
/// ignores.
void warn(const config::Config& config, std::span<const std::string_view> ignored = {});

/// Prints the warnings of a plan to stderr.
void warn(const plan::Plan& plan);

/// Warns on stderr if a single point may take long; a plan includes this warning.
void warn_of_costliest_point(const sweep::Sweep& sweep, const std::optional<results::Shard>& shard);

/// Prints to stderr which settings of the file --set has replaced.
void say_notes(const config::Config& config);

/// Puts the warnings of a configuration, with their locations, before those of its plan.
void join_warnings(plan::Plan& plan, const config::Config& config);

}  // namespace clatter::app
