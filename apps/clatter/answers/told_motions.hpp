#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "results/dataset_file.hpp"
#include "terminal/asked_units.hpp"

namespace clatter::app {

/// A motion that starts of a file end in.
struct ToldMotion {
  std::string word;    ///< of impacts
  double period;       ///< forcing periods until it repeats; 0: it doesn't
  std::size_t points;  ///< that end in it
  double speed;        ///< of the harder stop, at its example; NaN: not in the file
};

/// The motions of a file, and how many points it has.
struct ToldMotions {
  std::vector<ToldMotion> motions{};
  std::size_t points = 0;
  std::string units_of_speed{};
};

/// The motions of a file with attractors; none of any other. Throws IoError if it contradicts itself.
[[nodiscard]] ToldMotions motions_of(const results::FileSummary& summary, const std::string& path);

/// A line a motion: "  0  LU  period 1  62.3 % of the points  0.385 m/s"; at most twenty.
[[nodiscard]] std::string motions_text(const ToldMotions& told, const AskedUnits& asked);

}  // namespace clatter::app
