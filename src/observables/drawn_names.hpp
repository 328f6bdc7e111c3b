#pragma once

#include <string>
#include <string_view>

namespace clatter::observables {

/// How pictures name a variable of the results, or a key of the scene: words and a symbol, which is TeX between dollars
/// and text otherwise. Both are empty if pictures use its long name.
struct DrawnName {
  std::string words, symbol;
};

/// Of a variable or a key, in a file of [scene] or of [machine]; a derivative d_RESULT_d_KEY has the symbols of both.
/// With a loose mass impacts are those on its walls.
[[nodiscard]] DrawnName drawn_name(std::string_view variable, bool is_si, bool has_loose_mass = false);

/// The keys of [scene], or of [machine], with unit, words and symbol of each, as lines of TOML: the constants of a
/// scene are no variables of the file, and captions of pictures name them (root attribute `scene_names`). Those of a
/// loose mass only if the scene has one.
[[nodiscard]] std::string scene_names(bool is_si, bool has_loose_mass = false);

}  // namespace clatter::observables
