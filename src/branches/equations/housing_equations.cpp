#include <cstddef>

#include "branches/equations/equations.hpp"
#include "branches/equations/housing_flight.hpp"
#include "branches/equations/housing_multipliers.hpp"

namespace clatter::branches {

void OrbitEquations::add_flights_in_housing(const FollowedScene& scene, const Orbit& orbit, Linearised& out) const {
  const std::vector<HousingLink> links = housing_links(scene, orbit, axes_);
  for (std::size_t i = 0; i < links.size(); ++i) {
    const std::size_t begin = phase_of(i), end = i + 1 == links.size() ? 0 : phase_of(i + 1);
    for (std::size_t row = 0; row < of_event; ++row) {
      out.residual[begin + row] = links[i].residual[row];
      for (std::size_t j = 0; j < of_event; ++j) {
        const double unit = j == 0 ? 1.0 : speed_unit_;
        out.slope(begin + row, begin + j) += links[i].by_begin[row][j] * unit;
        out.slope(begin + row, end + j) += links[i].by_end[row][j] * unit;
      }
      for (std::size_t k = 0; k < axes_.size(); ++k)
        out.slope(begin + row, first_axis() + k) += links[i].by_axis[row][k] * axes_[k].unit;
    }
  }
  if (is_anywhere(scene, orbit)) stay_in_place(orbit, out);
}

void OrbitEquations::stay_in_place(const Orbit& orbit, Linearised& out) const {
  constexpr std::size_t place = 2;
  const std::size_t row = phase_of(orbit.size() - 1) + place;
  for (std::size_t unknown = 0; unknown < unknowns(); ++unknown) out.slope(row, unknown) = 0;
  out.residual[row] = orbit.events[0].other.place - shape_.events[0].other.place;
  out.slope(row, phase_of(0) + place) = speed_unit_;
}

void OrbitEquations::add_multiplier_in_housing(const FollowedScene& scene, const Orbit& orbit,
                                               const Condition& condition, std::size_t row, Linearised& out) const {
  const HousingMultiplier of = housing_multiplier(scene, orbit, axes_, condition.multiplier, speed_unit_);
  out.residual[row] = of.value;
  for (std::size_t i = 0; i < orbit.size(); ++i)
    for (std::size_t j = 0; j < of_event; ++j)
      out.slope(row, phase_of(i) + j) = of.slopes.by_event[i][j] * (j == 0 ? 1.0 : speed_unit_);
  for (std::size_t k = 0; k < axes_.size(); ++k)
    out.slope(row, first_axis() + k) = of.slopes.by_axis[k] * axes_[k].unit;
}

// Its slope, by which Newton's method comes near, is one of differences: they lose half of the digits, its zero none.
void OrbitEquations::add_unit_product(const Vector& z, std::size_t row, Linearised& out) const {
  constexpr double step = 1e-6;
  const auto at = [&](const Vector& unknowns) {
    return housing_characteristic(scene_at(unknowns), orbit_at(unknowns)).distance_to_unit_product();
  };
  out.residual[row] = at(z);
  Vector aside = z;
  for (std::size_t unknown = 0; unknown < z.size(); ++unknown) {
    aside[unknown] = z[unknown] + step;
    const double above = at(aside);
    aside[unknown] = z[unknown] - step;
    out.slope(row, unknown) = (above - at(aside)) / (2 * step);
    aside[unknown] = z[unknown];
  }
}

}  // namespace clatter::branches
