#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "config/unit.hpp"
#include "results/dataset_file.hpp"
#include "scene/quantity.hpp"

namespace clatter::app {

/// Units in which people want numbers printed, as --in gives them: rpm, mm.
class AskedUnits {
 public:
  AskedUnits() = default;
  /// Throws ChoiceError at a word that is no unit, or that of no number of the file.
  AskedUnits(const std::vector<std::string>& words, const results::FileSummary& summary, const std::string& path);

  struct Unit {
    std::string name;
    Quantity quantity;
    double in_si;  ///< one of it
  };
  /// The unit for numbers that a file has in `units`; nullptr: none was asked for.
  [[nodiscard]] const Unit* of(std::string_view units) const;

 private:
  std::vector<Unit> units_{};
};

}  // namespace clatter::app
