#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "bench/transient.hpp"
#include "sweep/sweep.hpp"

namespace clatter::bench {

/// A general solver at a tolerance.
using Solver = std::function<Transient(const point::Problem&)>;

/// The number of points of a sweep at which a solver is wrong, and its error at the others.
struct Verdict {
  std::size_t wrong = 0;    ///< extrema of x, or x or x' at the end, are off by more than a thousandth of |xs|
  double error = 0.0;       ///< the largest unless it is wrong, over |xs|
  std::size_t through = 0;  ///< the mass goes deeper into a stop than that; includes points that don't count as wrong
};

/// clatter's exact motions in a sweep of transients, with which solvers are compared.
///
/// If rounding decides the motion at the end, nothing can be compared there: that is so if the motion never becomes
/// periodic, or a displacement of 1e-13 at the start changes the end by more than 1e-6. Such a point is compared over
/// its beginning only, 10 * 2 pi, in which a displacement grows a hundredfold at most.
class Reference {
 public:
  explicit Reference(const sweep::Sweep& sweep);

  /// The verdict on a solver that made `runs` of the points; points of which only the beginning is compared run again.
  [[nodiscard]] Verdict judge(const Solver& solver, const std::vector<Transient>& runs) const;

  [[nodiscard]] std::size_t undetermined() const;  ///< points that are compared over their beginning only

 private:
  sweep::Sweep whole_, beginning_;
  std::vector<Transient> at_end_, early_;
  std::vector<bool> determined_;
};

}  // namespace clatter::bench
