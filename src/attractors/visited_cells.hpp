#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <unordered_set>
#include <vector>

#include "attractors/section_state.hpp"

namespace clatter::attractors {

/// The cells of the section plane that a motion without a period visits, after Datseris & Wagemakers (Chaos 32, 023104,
/// 2022). Another motion is the same if its states lie in them. Cells are 1/64 of the motion's own range in x and in v,
/// or 1/32, 1/16, 1/8: the smallest in which most of its later states fall where it has been before. With a loose mass
/// a state has a cell in the plane (z, z'), too, and both have to be visited: cells of all four numbers would be too
/// many to be visited twice.
class VisitedCells {
 public:
  /// States that make the set; those that are looked at before a motion counts as another one, so many at once.
  static constexpr std::size_t long_look = 1024, longest_look = 8 * long_look, at_once = 256;
  static constexpr std::size_t short_look = 32;  ///< states that are looked at first

  VisitedCells() = default;
  explicit VisitedCells(std::span<const SectionState> states);

  /// Whether at least three in four of 128 successive states, or of all if they are fewer, lie in visited cells.
  [[nodiscard]] bool are_visited_by(std::span<const SectionState> states) const;

 private:
  static constexpr std::size_t successive = 128;
  static constexpr double most = 0.75;

  /// The cells of one plane.
  struct Plane {
    double SectionState::*across = nullptr;
    double SectionState::*up = nullptr;
    PhasePoint corner{0, 0}, side{1, 1};
    std::unordered_set<std::uint64_t> visited{};

    void divide(std::span<const SectionState> states, double cells);
    [[nodiscard]] std::uint64_t cell_of(const SectionState& state) const;
  };

  void add(std::span<const SectionState> states);
  [[nodiscard]] double share_of(std::span<const SectionState> states) const;  ///< that lie in visited cells

  std::vector<Plane> planes_{};  ///< of the mass, and of a loose one
};

}  // namespace clatter::attractors
