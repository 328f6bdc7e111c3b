#include "observables/trajectory.hpp"

namespace clatter::observables {

std::vector<Column<Trajectory::Values>> Trajectory::columns(const Settings& settings) {
  const auto of = [&](const char* name, const char* long_name, std::vector<double> Values::*member, Quantity quantity) {
    return series<Values>(name, long_name, quantity, {"sample", count_of(settings)},
                          [member](const Values& v) -> const std::vector<double>& { return v.*member; });
  };
  return {of("tau", "time since the beginning of the observed time", &Values::tau, Quantity::time),
          in_observed_frame(of("x", "displacement", &Values::x, Quantity::length)),
          in_observed_frame(of("v", "velocity", &Values::v, Quantity::velocity))};
}

}  // namespace clatter::observables
