#include "scene/force_orders.hpp"

#include <algorithm>

namespace clatter {
inline namespace scene {

template std::array<double, 5> ForceOrders<double>::derivatives(const SineCosine<double>&) const;

std::vector<double> crests_of(const ForceOrders<double>& orders, double sign) {
  if (orders.highest() == 1) return {std::atan2(sign * orders.of[0].in_phase, sign * orders.of[0].quadrature)};
  const ForceOrders<double> slope = orders.derivative();
  const detail::RisingPhase<double> stops_to_rise(slope, -sign, 0.0);
  constexpr double end = 0.5, apart = 1e-9;  // turns
  std::vector<double> crests;
  for (auto at = stops_to_rise.first(-end, end); at; at = stops_to_rise.first(*at + apart, end))
    crests.push_back(2 * pi<double>() * *at);
  return crests;
}

double crest_of(const ForceOrders<double>& orders, double sign) {
  const auto height = [&](double at) {
    return sign * orders.derivatives(SineCosine<double>{std::sin(at), std::cos(at)})[0];
  };
  const std::vector<double> crests = crests_of(orders, sign);
  return *std::ranges::max_element(crests, {}, height);
}

}  // namespace scene
}  // namespace clatter
