#include "attractors/visited_cells.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::attractors {

VisitedCells::VisitedCells(std::span<const PhasePoint> states) {
  constexpr double returns = 0.9;  // least share of later states in cells visited before
  const std::size_t earlier = states.size() * 3 / 4;
  for (const double cells : {64, 32, 16, 8}) {
    divide(states, cells);
    add(states.first(earlier));
    if (share_of(states.subspan(earlier)) >= returns) break;
  }
  add(states);
}

/// Begins anew with so many cells across the range of x and of v.
void VisitedCells::divide(std::span<const PhasePoint> states, double cells) {
  const auto [least_x, most_x] = std::ranges::minmax(states, {}, &PhasePoint::x);
  const auto [least_v, most_v] = std::ranges::minmax(states, {}, &PhasePoint::v);
  const double smallest = 1e-12 * std::max(std::abs(most_x.x), std::abs(most_v.v));
  corner_ = {least_x.x, least_v.v};
  side_ = {std::max((most_x.x - least_x.x) / cells, smallest), std::max((most_v.v - least_v.v) / cells, smallest)};
  visited_.clear();
}

void VisitedCells::add(std::span<const PhasePoint> states) {
  for (const PhasePoint& state : states) visited_.insert(cell_of(state));
}

bool VisitedCells::are_visited_by(std::span<const PhasePoint> states) const {
  for (std::size_t begin = 0; begin < states.size(); begin += successive)
    if (share_of(states.subspan(begin, std::min(successive, states.size() - begin))) >= most) return true;
  return false;
}

double VisitedCells::share_of(std::span<const PhasePoint> states) const {
  const auto inside = std::ranges::count_if(states, [&](const PhasePoint& s) { return visited_.contains(cell_of(s)); });
  return static_cast<double>(inside) / static_cast<double>(states.size());
}

std::uint64_t VisitedCells::cell_of(const PhasePoint& state) const {
  const auto index = [](double distance, double side) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(std::floor(distance / side), -1e9, 1e9)));
  };
  return std::uint64_t{index(state.x - corner_.x, side_.x)} << 32 | index(state.v - corner_.v, side_.v);
}

}  // namespace clatter::attractors
