#pragma once

#include <cstdint>
#include <limits>
#include <optional>

#include "dynamics/reach.hpp"
#include "integrators/settle_forced.hpp"
#include "lanes/seat.hpp"
#include "sweep/crew.hpp"

namespace clatter {

/// A point in a lane: what it is, how far its motion is known, and the scalar kernel that helps it.
class Crew::Member {
 public:
  explicit Member(const Task& task);
  Member(const Member&) = delete;
  Member& operator=(const Member&) = delete;

  [[nodiscard]] const Task& task() const { return task_; }

  /// What is known at the start, of a transient all of it; else takes a lane to settle in.
  [[nodiscard]] std::optional<Observed> begin(Lanes& lanes, std::size_t lane);
  /// What is known at the section that the lane has passed.
  [[nodiscard]] std::optional<Observed> at_section(const Lanes& lanes, std::size_t lane);
  [[nodiscard]] Observed failure(Outcome outcome) const;

  /// Notes what is to be observed, and whether lanes can do it.
  [[nodiscard]] bool can_observe(const Observed& observed);
  void begin_to_observe(Lanes& lanes, std::size_t lane);
  /// Takes note of a section that was passed under observation; whether the observed time is over.
  [[nodiscard]] bool ends(Lanes& lanes, std::size_t lane);

  /// Takes a stuck lane on by the scalar kernel: by two steps, or to the next section.
  [[nodiscard]] Outcome help(Lanes& lanes, std::size_t lane);
  /// Whether the scalar kernel alone would be quicker, or has to observe.
  [[nodiscard]] bool needs_no_lane() const { return gives_up_ || helped_ > 64 + 2 * sections_; }

  /// Whether so many impacts that the lane has met are too many; the point has failed then.
  [[nodiscard]] bool has_spent_budget(double impacts);
  /// The share done of all that the point may come to.
  [[nodiscard]] double share(const Lanes& lanes, std::size_t lane) const;

  void add_impacts(double impacts) { impacts_ += impacts; }    ///< that a lane met
  [[nodiscard]] PointResult result(Workshop& workshop) const;  ///< observed by the scalar kernel
  [[nodiscard]] PointResult result(const Lanes& lanes, std::size_t lane, Workshop& workshop) const;

 private:
  static constexpr Effects effects = kernels::complete(Damping::light, Forcing::regular);
  using Kernel = Exact<double, effects>;
  static constexpr std::int64_t longest_quiet = 15;  ///< sections

  void skip_impact_at_start();
  void finish_period(Lanes& lanes, std::size_t lane, double part);
  [[nodiscard]] bool has_seen_all(const Lanes& lanes, std::size_t lane);
  void coast(Lanes& lanes, std::size_t lane) const;
  [[nodiscard]] Instant section(const Lanes& lanes, std::size_t lane) const;
  [[nodiscard]] double x_of(const Lanes& lanes, std::size_t lane, double y) const;

  Task task_;
  Kernel exact_;
  double
      log_area_;  ///< logarithm of the area that an impact leaves, on the stop that takes less: which it is isn't known
  std::optional<SteadySearch<effects>> search_{};  ///< a transient needs none
  Observed observed_{};
  std::optional<Kernel> settled_{};                                ///< the scalar kernel before lanes began to observe
  double settled_impacts_ = 0.0;                                   ///< that lanes had met until then
  State<double> helped_to_{};                                      ///< where the scalar kernel left the lane
  double helped_left_ = std::numeric_limits<double>::quiet_NaN();  ///< its time to the next section then
  std::int64_t sections_ = 0, helped_ = 0;
  std::int64_t quiet_ = 0;        ///< sections that the lane passes without a report before the next one
  double impacts_ = 0.0;          ///< that lanes have met, once the member has left them
  double section_impacts_ = 0.0;  ///< of lane and scalar kernel, up to the last section
  bool observing_ = false;
  bool coasts_ = false;    ///< no stop can be met under observation any more
  bool gives_up_ = false;  ///< it rested under observation, or failed: only the scalar kernel tells what comes of it
};

}  // namespace clatter
