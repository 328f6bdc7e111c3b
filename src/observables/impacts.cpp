#include "observables/impacts.hpp"

namespace clatter::observables {

std::vector<Column<Impacts::Values>> Impacts::columns(const Settings& settings) {
  const Coordinate stop = stop_coordinate();
  std::vector<Column<Values>> all{
      pair("impacts_per_period", "impacts per forcing period", stop, &Values::impacts_per_period),
      in_relative_frame(
          pair("v_before", "velocity before the first impact", stop, &Values::v_before, Quantity::velocity)),
      in_relative_frame(pair("v_after", "velocity after the first impact", stop, &Values::v_after, Quantity::velocity)),
      in_relative_frame(
          pair("impact_speed", "speed of the fastest impact", stop, &Values::impact_speed, Quantity::velocity)),
      pair("rest_fraction", "share of time at rest on the stop", stop, &Values::rest_fraction)};
  if (!settings.of_soft_stops) return all;
  all.push_back(pair("contact_fraction", "share of time in contact with the stop", stop, &Values::contact_fraction));
  all.push_back(in_si("greatest force of the soft stop",
                      pair("contact_force_max", "greatest force of the soft stop, per unit mass", stop,
                           &Values::contact_force_max, Quantity::force)));
  return all;
}

}  // namespace clatter::observables
