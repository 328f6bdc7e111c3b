#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>

#include "integrators/settle_forced.hpp"
#include "lanes/seat.hpp"
#include "sweep/point.hpp"

namespace clatter {

/// The points that one thread runs side by side in SIMD lanes. A lane whose point is done takes the next one; what the
/// lanes' kernel leaves undone, chatter, rest and grazes, the scalar kernel does for a short time. What a point gives
/// depends neither on its lane nor on its neighbours.
class Crew {
 public:
  Crew(VisitLanes visit, Workshop& workshop);
  ~Crew();

  /// The next point, one that fits into lanes; nothing: there are no more.
  using Next = std::function<std::optional<Task>()>;
  using Take = std::function<void(const Task&, PointResult&&)>;

  /// Runs all points that `next` gives.
  void run(const Next& next, const Take& take);

  [[nodiscard]] const Lanes& lanes() const { return lanes_; }

 private:
  class Seat;

  void fill(std::size_t lane, const Next& next, const Take& take);
  void finish(std::size_t lane, const Observed& observed, const Next& next, const Take& take);
  void help(std::size_t lane, const Next& next, const Take& take);
  void look(std::size_t lane, const Next& next, const Take& take);

  VisitLanes visit_;
  Workshop& workshop_;
  Lanes lanes_{};
  std::array<std::unique_ptr<Seat>, Row::width> seats_;
};

}  // namespace clatter
