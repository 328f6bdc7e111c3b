#include "attractors/visited_cells.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::attractors {

VisitedCells::VisitedCells(std::span<const SectionState> states) {
  planes_.push_back({&SectionState::x, &SectionState::v});
  if (std::ranges::any_of(states, [](const SectionState& state) { return state.z != 0 || state.w != 0; }))
    planes_.push_back({&SectionState::z, &SectionState::w});
  constexpr double returns = 0.9;  // least share of later states in cells visited before
  const std::size_t earlier = states.size() * 3 / 4;
  for (const double cells : {64, 32, 16, 8}) {
    for (Plane& plane : planes_) plane.divide(states, cells);
    add(states.first(earlier));
    if (share_of(states.subspan(earlier)) >= returns) break;
  }
  add(states);
}

/// Begins anew with so many cells across the range of each number.
void VisitedCells::Plane::divide(std::span<const SectionState> states, double cells) {
  const auto [least_x, most_x] = std::ranges::minmax(states, {}, across);
  const auto [least_v, most_v] = std::ranges::minmax(states, {}, up);
  const double smallest = 1e-12 * std::max(std::abs(most_x.*across), std::abs(most_v.*up));
  corner = {least_x.*across, least_v.*up};
  side = {std::max((most_x.*across - least_x.*across) / cells, smallest),
          std::max((most_v.*up - least_v.*up) / cells, smallest)};
  visited.clear();
}

void VisitedCells::add(std::span<const SectionState> states) {
  for (Plane& plane : planes_)
    for (const SectionState& state : states) plane.visited.insert(plane.cell_of(state));
}

bool VisitedCells::are_visited_by(std::span<const SectionState> states) const {
  for (std::size_t begin = 0; begin < states.size(); begin += successive)
    if (share_of(states.subspan(begin, std::min(successive, states.size() - begin))) >= most) return true;
  return false;
}

double VisitedCells::share_of(std::span<const SectionState> states) const {
  const auto is_visited = [&](const SectionState& state) {
    return std::ranges::all_of(planes_,
                               [&](const Plane& plane) { return plane.visited.contains(plane.cell_of(state)); });
  };
  const auto inside = std::ranges::count_if(states, is_visited);
  return static_cast<double>(inside) / static_cast<double>(states.size());
}

std::uint64_t VisitedCells::Plane::cell_of(const SectionState& state) const {
  const auto index = [](double distance, double length) {
    return static_cast<std::uint32_t>(static_cast<std::int32_t>(std::clamp(std::floor(distance / length), -1e9, 1e9)));
  };
  return std::uint64_t{index(state.*across - corner.x, side.x)} << 32 | index(state.*up - corner.v, side.v);
}

}  // namespace clatter::attractors
