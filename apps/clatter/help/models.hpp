#pragma once

#include <span>
#include <string_view>

namespace clatter::app {

/// A shipped configuration.
struct Model {
  std::string_view name;     ///< of its file without the ending, "drill"
  std::string_view machine;  ///< that it is the model of, in the words of the guide; empty: it isn't in its table
  std::string_view text;     ///< TOML, with its comments
};

/// The configurations in `configs`, those of the guide's table of models first, in its order.
[[nodiscard]] std::span<const Model> models();

}  // namespace clatter::app
