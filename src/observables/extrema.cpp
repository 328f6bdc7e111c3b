#include "observables/extrema.hpp"

namespace clatter::observables {

std::vector<Column<Extrema::Values>> Extrema::columns(const Settings&) {
  return {in_observed_frame(scalar("x_min", "minimum displacement", &Values::x_min, Quantity::length)),
          in_observed_frame(scalar("x_max", "maximum displacement", &Values::x_max, Quantity::length)),
          in_observed_frame(scalar("v_min", "minimum velocity", &Values::v_min, Quantity::velocity)),
          in_observed_frame(scalar("v_max", "maximum velocity", &Values::v_max, Quantity::velocity))};
}

}  // namespace clatter::observables
