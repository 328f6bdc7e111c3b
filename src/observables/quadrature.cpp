#include "observables/quadrature.hpp"

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

template <>
const std::array<GaussPair, 5>& gauss_pairs<10>() {
  static const std::array pairs = tabulated<10>();
  return pairs;
}

template <>
const std::array<GaussPair, 10>& gauss_pairs<20>() {
  static const std::array pairs = tabulated<20>();
  return pairs;
}

}  // namespace clatter::observables
