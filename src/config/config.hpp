#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "branches/settings.hpp"
#include "config/config_error.hpp"
#include "results/dataset_file.hpp"
#include "sweep/sweep.hpp"

namespace clatter::config {

enum class Format { toml, ini };

/// Something in a configuration that is valid but looks unintended.
struct Warning {
  std::string location;  ///< "fig22.toml:7:6", or the words of a --set
  std::string section;   ///< of the key
  std::string text;      ///< the problem; how to fix it
};

/// A complete configuration: the sweep with its observables, and how to write the output.
struct Config : results::FileHead {
  sweep::Sweep sweep;
  std::optional<branches::BranchSettings> branch{};  ///< if the text has [branch]
  std::vector<Warning> warnings;
  std::vector<std::string> notes;  ///< settings that the command line replaced, and a stretched force
};

/// A --set KEY=VALUE of the command line, e.g. {"sweep.nu", "linspace(0.5, 1.5, 51)"}.
struct Override {
  std::string key;
  std::string value;
  std::string option = "--set";  ///< or the words of another option that sets the key
};

/// The operand that means standard input.
inline constexpr std::string_view standard_input = "-";

/// Reads a configuration, as INI if the name ends in .ini (in any case) or the format says so, else as TOML. Throws
/// ConfigError, and IoError if the file cannot be read.
[[nodiscard]] Config read_config(const std::string& path, const std::vector<Override>& overrides,
                                 Format format = Format::toml);

/// Reads a configuration from TOML, such as the complete text of another one; errors name `file`.
[[nodiscard]] Config parse_config(const std::string& text, const std::string& file,
                                  const std::vector<Override>& overrides = {});

}  // namespace clatter::config
