#include "observables/attractor.hpp"

namespace clatter::observables {

std::vector<Column<Attractor::Values>> Attractor::columns(const Settings&) {
  const auto intermediate = [](const char* name, const char* long_name, double Values::*member) {
    Column<Values> column = scalar(name, long_name, member);
    column.intermediate = true;
    return column;
  };
  return {
      in_relative_frame(intermediate("attractor_x", "displacement in which the point ended", &Values::attractor_x)),
      in_relative_frame(intermediate("attractor_v", "velocity in which the point ended", &Values::attractor_v)),
      intermediate("attractor_periods", "forcing periods after which it repeats, 0: none", &Values::attractor_periods)};
}

}  // namespace clatter::observables
