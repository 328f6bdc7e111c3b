#pragma once

#include <cstddef>
#include <map>
#include <optional>
#include <span>
#include <vector>

#include "attractors/periodic_motion.hpp"
#include "attractors/visited_cells.hpp"

namespace clatter::attractors {

/// The state in which a point of a sweep ended, after whole forcing periods.
struct Ending {
  SectionState state{};
  double periods = 0.0;  ///< forcing periods after which the motion repeats; 0: none; NaN: failed, or not known
  std::optional<double> phase{};  ///< forcing phase then, as the scene gives it, rad; nothing: that of its start
};

/// A motion that points with equal parameters end in.
struct Motion {
  std::optional<PeriodicMotion> periodic{};  ///< empty: it has no period
  SectionState state{};                      ///< at forcing phase 0
  VisitedCells cells{};                      ///< of motion without a period
  bool symmetric = false;                    ///< motion without a period visits the cells of its mirror image
  bool floats = false;                       ///< no wall meets a loose mass: it is one of the main mass alone
  bool sticks = false;                       ///< dry friction holds the mass for good, here or at any place of a band
  Side creeps_to = Side::none;               ///< the edge of that band to which the mass creeps

  [[nodiscard]] std::size_t periods() const { return periodic ? periodic->cycle.size() : 0; }
};

/// The motions that the starts of an ensemble, points with equal parameters, end in, in the order in which they are
/// found.
class EnsembleMotions {
 public:
  /// With several starts a motion without a period is looked at for longer before it counts as another one.
  explicit EnsembleMotions(bool has_several_starts = false)
      : longest_look_(has_several_starts ? VisitedCells::longest_look : VisitedCells::long_look) {}

  /// The index of the motion that a point ends in; nothing if that can't be decided. `problem` is that of the point.
  [[nodiscard]] std::optional<std::size_t> motion_of(const point::Problem& problem, const Ending& ending);

  /// Adds a motion that was found before, from its state at forcing phase 0.
  void restore(const point::Problem& problem, const Ending& motion);

  /// The periodic motion that passes a state at forcing phase 0.
  [[nodiscard]] std::optional<std::size_t> passing(const SectionState& state) const;
  /// The mass that friction holds for good.
  [[nodiscard]] std::optional<std::size_t> band() const { return band_; }
  /// The motion without a period in whose cells most of some successive states lie; `floats`: of the main mass alone.
  [[nodiscard]] std::optional<std::size_t> visiting(std::span<const SectionState> states, bool floats) const;

  [[nodiscard]] const std::vector<Motion>& motions() const { return motions_; }

 private:
  std::optional<std::size_t> periodic_of(const point::Problem& problem, const SectionState& state, std::size_t periods);
  std::optional<std::size_t> aperiodic_of(const point::Problem& problem, const SectionState& state);
  std::optional<std::size_t> aperiodic_of(const point::Problem& problem, const SectionState& state, bool floats);
  std::size_t add(Motion motion);

  [[nodiscard]] bool visits_mirror(const point::Problem& problem, const Motion& motion) const;

  std::size_t longest_look_;
  std::vector<Motion> motions_;
  std::multimap<double, std::size_t> by_x_;  ///< of every state of every cycle, the index of the motion
  double largest_ = 0.0;                     ///< size of the periodic motions
  std::optional<std::size_t> band_{};        ///< index of the motion
};

}  // namespace clatter::attractors
