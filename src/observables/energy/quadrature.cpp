#include "observables/energy/quadrature.hpp"

#include <boost/math/quadrature/gauss.hpp>

namespace clatter::observables {
namespace {

template <unsigned points>
std::array<GaussPair, points / 2> tabulated() {
  using Rule = boost::math::quadrature::gauss<double, points>;
  std::array<GaussPair, points / 2> pairs;
  for (std::size_t i = 0; i < pairs.size(); ++i) pairs[i] = {Rule::abscissa()[i], Rule::weights()[i]};
  return pairs;
}

}  // namespace

const std::array<GaussPair, 5> gauss_of_ten = tabulated<10>();
const std::array<GaussPair, 10> gauss_of_twenty = tabulated<20>();

}  // namespace clatter::observables
