#pragma once

#include "command_line.hpp"
#include "io/config.hpp"

namespace clatter {

/// Options of every command that takes a configuration.
inline const Option set_option{"set", 0, "KEY=VALUE",
                               "a value in place of the configuration's, e.g. scene.R=0.5; repeatable", true};
inline const Option threads_option{"threads", 0, "N", "threads, 1 to 1024; default: as many as the machine offers"};

/// The configuration of the first operand, with what --set changes. Throws UsageError, ConfigError, IoError.
[[nodiscard]] Config config_of(const Arguments& arguments);

/// What --threads says; 0 where it isn't given. Throws UsageError.
[[nodiscard]] int threads_of(const Arguments& arguments);

}  // namespace clatter
