#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "results/dataset_file.hpp"

namespace clatter::app {

/// A variable in the files of a command, as these describe it.
struct CataloguedResult {
  std::string_view command;  ///< "run", "branch" or "accuracy"
  std::string name;
  std::string type;                    ///< "float64", "string", ...
  std::string over;                    ///< its dimensions in words: "the axes and stop"; empty: none
  std::string meaning, meaning_in_si;  ///< long names in files of a [scene] and of a [machine]
  std::string units, units_in_si;      ///< likewise, as files have them
  std::string frame;                   ///< "relative" to what is shaken, or "observed"; empty: any
  std::string observable;              ///< the key of [observe] that asks for it; empty: none
  std::string missing_if;              ///< when it is NaN or empty; empty: never
  std::vector<std::pair<std::uint8_t, std::string>> flags{};  ///< words for its values, if it has any
};

/// Every variable that a command writes but for axes and parameters, which are keys, in the order of the files. It is
/// read off the datasets that the commands make of a sweep with all observables, before anything is computed.
[[nodiscard]] std::span<const CataloguedResult> result_catalogue();

/// The variables of that name, and behind them those that users type by it: of a run, of branches, of accuracy.
[[nodiscard]] std::vector<const CataloguedResult*> results_named(std::string_view name);

/// The command that wrote a file: "run", "branch" or "accuracy".
[[nodiscard]] std::string_view command_of(const results::FileSummary& summary);

}  // namespace clatter::app
