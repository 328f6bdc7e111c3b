#pragma once

#include <optional>
#include <string>
#include <vector>

#include "attractors/ensemble_motions.hpp"

namespace clatter::attractors {

/// A motion that is followed while the parameters change. Periodic motion is followed by continuation: Newton's method
/// from the state before, in steps so short that the first iteration nearly is the last, as long as the motion
/// attracts and its word and its period stay the same. Its section lies in the middle of the longest flight, so that no
/// impact passes it on the way. Motion without a period is followed to the one that its state ends in.
class TrackedMotion {
 public:
  /// A motion that was found at the parameters of `problem`.
  TrackedMotion(const point::Problem& problem, const Motion& motion);

  /// Follows it to the parameters of the next problem. Returns false if it ends on the way, or attracts no more; it
  /// can't be followed any further then.
  [[nodiscard]] bool follow(const point::Problem& next);

  /// Which of the motions at these parameters it has become; nothing if no start ends in it.
  [[nodiscard]] std::optional<std::size_t> among(const EnsembleMotions& motions) const;

  [[nodiscard]] bool is_periodic() const { return periods_ > 0; }

 private:
  [[nodiscard]] bool follow_periodic(const point::Problem& to);
  [[nodiscard]] bool correct(const point::Problem& problem);
  [[nodiscard]] bool move_section(const point::Problem& problem, const Round& round);

  point::Problem at_;         ///< the parameters that it has been followed to
  SectionState state_;        ///< at the section
  double phase_turns_ = 0.0;  ///< forcing phase of the section, in turns, 0 ... 1
  std::size_t periods_ = 0;   ///< 0: it has no period
  std::string word_{};
  double size_ = 0.0;
  bool symmetric_ = false;              ///< of motion without a period
  bool sticks_ = false;                 ///< friction holds the mass for good
  Side creeps_to_ = Side::none;         ///< the edge of the band in which friction holds the mass
  bool floats_ = false;                 ///< no wall meets the loose mass
  bool lost_ = false;                   ///< it couldn't be brought to its section
  std::vector<SectionState> states_{};  ///< of motion without a period at phase 0, at these parameters
};

}  // namespace clatter::attractors
