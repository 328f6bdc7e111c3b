#pragma once

#include <span>
#include <string_view>

#include "config/config.hpp"
#include "plan/plan.hpp"

namespace clatter::app {

/// Says on stderr what looks unintended in a configuration, each with its place, but not of sections that a command
/// doesn't go by.
void warn(const config::Config& config, std::span<const std::string_view> but = {});

/// Says on stderr what looks unintended in a plan.
void warn(const plan::Plan& plan);

/// Says on stderr where a single point may take long, which a plan says, too.
void warn_of_dearest_point(const sweep::Sweep& sweep, const std::optional<sweep::Shard>& shard);

/// Says on stderr what --set has put in place of the file's.
void say_notes(const config::Config& config);

/// Puts the warnings of a configuration, each with its place, before those of its plan.
void join_warnings(plan::Plan& plan, const config::Config& config);

}  // namespace clatter::app
