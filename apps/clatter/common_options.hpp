#pragma once

#include <optional>
#include <string>

#include "command_line.hpp"
#include "config/config.hpp"
#include "lanes/instruction_set.hpp"
#include "sweep/share.hpp"

namespace clatter::app {

/// Options of every command that takes a configuration.
inline const Option set_option{"set", 0, "KEY=VALUE",
                               "a value in place of the configuration's, e.g. scene.R=0.5; repeatable", true};
inline const Option ini_option{"ini", 0, "",
                               "CONFIG, or stdin where that is -, is INI; else TOML unless its name ends in .ini"};
inline const Option threads_option{"threads", 0, "N", "threads, 1 to 1024; default: as many as the machine offers"};

/// The configuration of the first operand, with what --set changes. Throws UsageError, ConfigError, IoError.
[[nodiscard]] config::Config config_of(const Arguments& arguments);

/// What --threads says; 0 where it isn't given. Throws UsageError.
[[nodiscard]] int threads_of(const Arguments& arguments);

/// What --shard says; nothing where it isn't given. Throws UsageError.
[[nodiscard]] std::optional<sweep::Shard> shard_of(const Arguments& arguments);

inline const Option arch_option{"arch", 0, "NAME",
                                "instruction set: scalar, sse2, avx2, avx512; default: CLATTER_ARCH, else the widest"};

/// The instruction set that --arch or the environment names; the widest of this machine where neither does. Throws
/// UsageError.
[[nodiscard]] lanes::InstructionSet arch_of(const Arguments& arguments);

/// Options of the commands that write a file.
inline const Option output_option{"output", 'o', "FILE.h5",
                                  "where the results go; default: the configuration's name with .h5, here"};
inline const Option force_option{"force", 0, "", "replace any file that has the output's name"};
inline const Option progress_option{"progress", 0, "WHEN", "auto (on a terminal), always, never"};

/// Whether progress is to be shown. Throws UsageError.
[[nodiscard]] bool progress_wanted(const Arguments& arguments);

/// The file that -o names, or the configuration's name with this ending. Throws UsageError where there is neither.
[[nodiscard]] std::string output_of(const Arguments& arguments, const std::string& ending);

/// Results must not take the place of the configuration. Throws UsageError.
void check_not_config(const std::string& config, const std::string& output);

}  // namespace clatter::app
