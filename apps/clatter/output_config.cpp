#include "output_config.hpp"

#include <algorithm>

#include "config/config_error.hpp"
#include "storage/input_file.hpp"

namespace clatter::app {

config::Config config_of_output(const results::FileSummary& summary, const std::string& path) try {
  const auto text = std::ranges::find(summary.attributes, "config", [](const auto& pair) { return pair.first; });
  if (text == summary.attributes.end())
    storage::refuse_reading(path, "has no configuration", "name an output of clatter");
  return config::parse_config(text->second, path);
} catch (const config::ConfigError& error) {
  storage::refuse_reading(path, std::string("has a configuration that doesn't run: ") + error.what(),
                          "run its configuration again");
}

}  // namespace clatter::app
