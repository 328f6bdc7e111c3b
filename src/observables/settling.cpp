#include "observables/settling.hpp"

namespace clatter::observables {

std::vector<Column<Settling::Values>> Settling::columns(const Settings&) {
  return {scalar("settling_periods", "forcing periods after which the motion stays within 1e-3 of the steady one",
                 &Values::settling_periods)};
}

}  // namespace clatter::observables
