#pragma once

#include <vector>

#include "certificates/error_bounds.hpp"
#include "point/point.hpp"

namespace clatter::certificates {

/// Of a main mass and a loose one.
class HousingBounds : public Bounds<4> {
 public:
  HousingBounds(const point::Problem& problem, const RecordedMotion<4>& motion, const point::PointResult& result,
                double time, bool periodic);

  /// Claims an event of the motion that follows another, null if it is the first.
  [[nodiscard]] ClaimedEvent claimed(const RecordedEvent<4>& event, const ClaimedEvent* before) const {
    HousingBounds beside = *this;  // a loose mass that slides draws the main one along (eq. 80)
    beside.oscillator_.load += event.rubbing, beside.loose_.load -= event.rubbing / loose_.ratio;
    return beside.claimed_by_load(event, before);
  }
  [[nodiscard]] ClaimedEnd claimed_end(const RecordedMotion<4>& motion) const;
  /// The largest change of a multiplier among some small changes of the derivative of a period.
  [[nodiscard]] std::vector<ClaimedMultiplier> claimed_multipliers(const RecordedMotion<4>& motion,
                                                                   const point::PointResult& result) const;

 private:
  /// Of (x, x', z, z') by the derivative of the motion and the rounding so far.
  [[nodiscard]] Sizes error_after(const Map& derivative, const Sizes& rounding) const;
  /// The main mass at an event, and its acceleration before it; `pressed`: that of both masses as one.
  [[nodiscard]] static motion::Event::Main main_at(const RecordedEvent<4>& event);
  [[nodiscard]] double acceleration(const RecordedEvent<4>& event, double time, bool pressed = false) const;
  [[nodiscard]] double acceleration(const RecordedEvent<4>& event, bool pressed = false) const {
    return acceleration(event, event.time, pressed);
  }
  [[nodiscard]] ClaimedEvent claimed_by_load(const RecordedEvent<4>& event, const ClaimedEvent* before) const;
  /// Claims that friction turns a loose mass, or holds it, in its housing.
  [[nodiscard]] ClaimedEvent claimed_in_housing(const RecordedEvent<4>& event, const ClaimedEvent* before) const;
  /// Claims a chatter, a press or a rest.
  [[nodiscard]] ClaimedEvent claimed_stay(const RecordedEvent<4>& event, const ClaimedEvent* before) const;
  /// Of the end of a press.
  [[nodiscard]] double release_error(const RecordedEvent<4>& event) const;

  LooseMass loose_;
  double duration_;
};

/// Newton's step from the start of a period to the state that a motion returns to, or nothing if there is none; z and
/// z' stay as they are if a wall presses the loose mass.
[[nodiscard]] std::optional<MachineState> step_to_return(const MachineState& start, const RecordedMotion<4>& motion);

}  // namespace clatter::certificates
