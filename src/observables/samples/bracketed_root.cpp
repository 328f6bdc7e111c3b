#include "observables/samples/bracketed_root.hpp"

#include <boost/math/tools/toms748_solve.hpp>
#include <cstdint>

namespace clatter::observables {

double bracketed_root(const std::function<double(double)>& function, double low, double high, double at_low,
                      double at_high) {
  std::uintmax_t iterations = 100;
  return boost::math::tools::toms748_solve([&](double x) { return function(x); }, low, high, at_low, at_high,
                                           boost::math::tools::eps_tolerance<double>(), iterations)
      .second;
}

}  // namespace clatter::observables
