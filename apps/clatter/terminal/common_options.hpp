#pragma once

#include <optional>
#include <string>
#include <vector>

#include "config/config.hpp"
#include "lanes/instruction_set.hpp"
#include "sweep/share.hpp"
#include "terminal/command_line.hpp"
#include "terminal/progress.hpp"

namespace clatter::app {

/// Options of every command that takes a configuration.
inline const Option set_option{"set", 0, "KEY=VALUE",
                               "replace a value of the configuration, e.g. scene.R=0.5; repeatable", true};
inline const Option ini_option{"ini", 0, "",
                               "read CONFIG (- for stdin) as INI; default: TOML unless its name ends in .ini"};
inline const Option threads_option{"threads", 0, "N",
                                   "number of threads, 1 to 1024; default: as many as the machine offers"};

/// The settings of all --set. Throws UsageError.
[[nodiscard]] std::vector<config::Override> overrides_of(const Arguments& arguments);

/// The configuration of the first operand, changed by --set, and then by `changes`. Throws UsageError, ConfigError,
/// IoError.
[[nodiscard]] config::Config config_of(const Arguments& arguments, const std::vector<config::Override>& changes = {});

/// The number of an option that counts something, from 1 to `most` or on; nothing if it isn't given. Throws UsageError.
[[nodiscard]] std::optional<int> count_of(const Arguments& arguments, std::string_view option,
                                          std::optional<int> most = std::nullopt);

/// The number of --threads; 0 if it isn't given. Throws UsageError.
[[nodiscard]] int threads_of(const Arguments& arguments);

/// The shard of --shard; nothing if it isn't given. Throws UsageError.
[[nodiscard]] std::optional<results::Shard> shard_of(const Arguments& arguments);

inline const Option arch_option{
    "arch", 0,
    "NAME", "instruction set: scalar, sse2, avx2, avx512; default: CLATTER_ARCH, else the widest",
    false,  lanes::instruction_set_names};

/// The instruction set that --arch or else CLATTER_ARCH names; by default the widest of this machine. Throws
/// UsageError.
[[nodiscard]] lanes::InstructionSet arch_of(const Arguments& arguments);

/// Options of the commands that write a file.
inline const Option output_option{"output", 'o', "FILE.h5",
                                  "output file; default: the configuration's name with .h5, in this directory"};
inline const Option force_option{"force", 0, "", "replace whatever file has the output's name"};
inline constexpr std::string_view progress_choices[] = {"auto", "always", "never"};
inline const Option progress_option{
    "progress", 0,
    "WHEN",     "show progress: auto (a bar on a terminal, elsewhere a line a minute), always (the bar) or never",
    false,      progress_choices};

/// How to show progress. Throws UsageError.
[[nodiscard]] ProgressKind progress_kind(const Arguments& arguments);

/// The file that -o names, else the name of the configuration, or of the output of --from in its place, with this
/// ending. Throws UsageError if there is neither.
[[nodiscard]] std::string output_of(const Arguments& arguments, const std::string& ending);

/// The kinds of files that the program writes.
enum class FileKind { results, table, certificates, configuration };

/// Throws UsageError if the name of an output is one of another kind of file, with the name to write: results are HDF5,
/// tables CSV.
void check_name(const std::string& output, FileKind kind);

/// Throws UsageError if the output would replace the configuration.
void check_not_config(const std::string& config, const std::string& output);
/// Throws UsageError if the output would replace another file that is read; `what` it is.
void check_not_input(const std::string& input, const std::string& output, const std::string& what);

}  // namespace clatter::app
