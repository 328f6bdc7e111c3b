#include "observables/period.hpp"

namespace clatter::observables {

std::vector<Column<Period::Values>> Period::columns(const Settings&) {
  return {scalar("period", "period of the motion", &Values::period, Quantity::time),
          scalar("period_ratio", "period of the motion in forcing periods", &Values::period_ratio),
          in_si("one over the period of unforced motion",
                scalar("eigenfrequency", "2 pi over the period of unforced motion", &Values::eigenfrequency,
                       Quantity::frequency)),
          in_relative_frame(
              scalar("velocity_ratio", "|velocity before impact / xs|", &Values::velocity_ratio, Quantity::rate))};
}

}  // namespace clatter::observables
