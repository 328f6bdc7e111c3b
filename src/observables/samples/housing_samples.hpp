#pragma once

#include <cstddef>
#include <vector>

#include "observables/samples/in_housing.hpp"
#include "observables/samples/samples.hpp"
#include "scene/loose_mass.hpp"

namespace clatter::observables {

/// Samples of the place of a loose mass in its housing, z, and of z'.
class HousingSamples : public InHousing<Samples> {
 public:
  HousingSamples(std::size_t count, double spacing, AtImpact at_impact, const LooseMass& loose, double first = 0.0)
      : InHousing(std::in_place, count, spacing, at_impact, walls_of(loose), first) {}

  /// Ends the observed time, of length `total`, where the mass is.
  void finish(double total, bool periodic) { of().finish(last_z(), last_w(), total, periodic); }

  [[nodiscard]] std::vector<double>& place() { return of().displacement(); }
  [[nodiscard]] std::vector<double>& velocity() { return of().velocity(); }
};

}  // namespace clatter::observables
