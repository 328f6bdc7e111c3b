#pragma once

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "lanes/seat.hpp"
#include "sweep/point.hpp"

namespace clatter {

/// The points that one thread runs side by side in SIMD lanes: first until their motion is known, then, in other lanes,
/// to observe it. A lane whose point is done takes the next one; what the lanes' kernel leaves undone, chatter, rest
/// and grazes, the scalar kernel does for a short time. What a point gives depends neither on its lane nor on its
/// neighbours.
class Crew {
 public:
  /// The next point, one that fits into lanes; nothing: there are no more.
  using Next = std::function<std::optional<Task>()>;
  using Take = std::function<void(const Task&, PointResult&&)>;

  Crew(const Visits& visits, Workshop& workshop, Next next, Take take);
  ~Crew();
  Crew(const Crew&) = delete;
  Crew& operator=(const Crew&) = delete;

  /// Runs all points that `next` gives, and lets `take` have their results.
  void run();

  /// Lanes times steps that were to be proved free of contact, and times contacts that were looked for.
  [[nodiscard]] double proved() const { return settling_.lanes.proved + observing_.lanes.proved; }
  [[nodiscard]] double refined() const { return settling_.lanes.refined + observing_.lanes.refined; }

 private:
  class Member;
  struct Bench {
    Lanes lanes{};
    std::array<std::unique_ptr<Member>, Row::width> members;
    std::size_t taken = 0;
  };

  void visit(Bench& bench, VisitLanes kernel);
  void take_stock();
  void help(Bench& bench, std::size_t lane);
  void look(Bench& bench);
  void look(Bench& bench, std::size_t lane);
  void fill();
  void settle_next(std::size_t lane);
  void observe_next(std::size_t lane);
  void settled(std::unique_ptr<Member> member);
  [[nodiscard]] std::unique_ptr<Member> leave(Bench& bench, std::size_t lane, double impacts);

  Visits visits_;
  Workshop& workshop_;
  Next next_;
  Take take_;
  Bench settling_, observing_;
  std::vector<std::unique_ptr<Member>> waiting_;  ///< to be observed; as many as there are lanes, at most some more
  bool exhausted_ = false;                        ///< there are no more points
  std::uint64_t visits_made_ = 0;
};

}  // namespace clatter
