#include "branches/equations/housing_links.hpp"

#include <algorithm>

#include "branches/equations/housing_flight.hpp"
#include "math/dual.hpp"

namespace clatter::branches {
namespace {

/// Derivatives by the event that a flight begins with, by the phase at its end, and by two parameters.
constexpr std::size_t by_end_phase = of_event, by_first_axis = by_end_phase + 1;
using First = Dual<double, by_first_axis + 2>;
using Along1 = Dual<First, 1>;  // of those, the change in one direction

/// The numbers of a scene, with derivatives by the parameters that vary.
template <class Number>
SceneNumbers<Number> numbers_along(const FollowedScene& scene, const std::vector<OrbitEquations::Axis>& axes) {
  return numbers_of<Number>(scene, [&](BasicGivenScene<Number>& given) {
    for (std::size_t k = 0; k < axes.size(); ++k)
      set(given, axes[k].parameter, Number(First(value_of(scene, axes[k].parameter), by_first_axis + k)));
  });
}

}  // namespace

std::vector<HousingLink> housing_links(const FollowedScene& scene, const Orbit& orbit,
                                       const std::vector<OrbitEquations::Axis>& axes) {
  std::vector<HousingLink> links;
  const auto add_links = [&]<Effects E>() {
    const HousingFlights<First, E> flights(numbers_along<First>(scene, axes));
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const OrbitEvent next = orbit.event(i + 1);
      const std::array<double, of_event> there{0.0, next.coordinate(), next.other.place, next.other.before};
      const auto end =
          flights.end(flight_of_both<First>(orbit, i, [](double value, std::size_t k) { return First(value, k); }));
      HousingLink link;
      for (std::size_t row = 0; row < of_event; ++row) {
        const auto& slope = end[row].slope;
        link.residual[row] = end[row].value - there[row];
        std::copy_n(slope.begin(), of_event, link.by_begin[row].begin());
        link.by_end[row][0] = slope[by_end_phase];
        if (row > 0) link.by_end[row][row] = orbit.ends_mirrored(i) ? 1.0 : -1.0;
        for (std::size_t k = 0; k < axes.size(); ++k) link.by_axis[row][k] = slope[by_first_axis + k];
      }
      links.push_back(link);
    }
  };
  with_arcs_of_main(scene, add_links);
  return links;
}

HousingSlopes housing_slopes(const FollowedScene& scene, const Orbit& orbit,
                             const std::vector<OrbitEquations::Axis>& axes, const Vector& left, const Vector& right,
                             int multiplier) {
  HousingSlopes found{std::vector<Square4::value_type>(orbit.size()), {}};
  // J right is the change of the flights in one direction
  const auto add_flights = [&]<Effects E>() {
    const HousingFlights<Along1, E> flights(numbers_along<Along1>(scene, axes));
    for (std::size_t i = 0; i < orbit.size(); ++i) {
      const bool closes = i + 1 == orbit.size();
      const std::size_t next = closes ? 0 : i + 1;
      const auto varied = [&](double value, std::size_t k) {
        Along1 number(First(value, k));
        number.slope[0] = k < of_event ? right[of_event * i + k]
                                       : right[of_event * next] * (closes ? static_cast<double>(multiplier) : 1.0);
        return number;
      };
      const auto end = flights.end(flight_of_both<Along1>(orbit, i, varied));
      for (std::size_t row = 0; row < of_event; ++row) {
        const auto& slope = end[row].slope[0].slope;
        for (std::size_t j = 0; j < of_event; ++j) found.by_event[i][j] += left[of_event * i + row] * slope[j];
        found.by_event[next][0] += left[of_event * i + row] * slope[by_end_phase];
        for (std::size_t k = 0; k < axes.size(); ++k)
          found.by_axis[k] += left[of_event * i + row] * slope[by_first_axis + k];
      }
    }
  };
  with_arcs_of_main(scene, add_flights);
  return found;
}

}  // namespace clatter::branches
