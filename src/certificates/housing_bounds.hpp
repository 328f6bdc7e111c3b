#pragma once

#include <vector>

#include "certificates/certificate.hpp"
#include "certificates/housing_motion.hpp"
#include "point/point.hpp"

namespace clatter::certificates {

/// How far the numbers of a motion with a loose mass in double may be off, as `ErrorBounds` of one without.
class HousingBounds {
 public:
  HousingBounds(const point::Problem& problem, const HousingMotion& motion, const point::PointResult& result,
                double time, bool periodic);

  /// Claims an event of the motion that follows another, null if it is the first.
  [[nodiscard]] ClaimedEvent claimed(const HousingEvent& event, const ClaimedEvent* before) const;
  [[nodiscard]] ClaimedEnd claimed_end(const HousingMotion& motion) const;
  [[nodiscard]] Claimed claimed_extremum(double x) const;
  /// The largest change of a multiplier among some small changes of the derivative of a period.
  [[nodiscard]] std::vector<ClaimedMultiplier> claimed_multipliers(const HousingMotion& motion,
                                                                   const point::PointResult& result) const;
  [[nodiscard]] bool know_the_start() const;
  [[nodiscard]] double of_start() const;
  [[nodiscard]] bool tell(const Certificate& certificate) const;

 private:
  /// Of (x, x', z, z') by the derivative of the motion and the rounding so far.
  [[nodiscard]] HousingGrowth::Sizes error_after(const HousingGrowth::Map& derivative,
                                                 const HousingGrowth::Sizes& rounding) const;
  [[nodiscard]] double time_error(double time) const;
  [[nodiscard]] double acceleration(const HousingEvent& event) const;
  [[nodiscard]] ClaimedEvent claimed_impact(const HousingEvent& event) const;
  [[nodiscard]] double release_error(const HousingEvent& event) const;

  Oscillator oscillator_;
  LooseMass loose_;
  double phase_, begin_, forcing_period_, duration_;
  double size_, of_start_ = 1.0, stretching_ = 1.0;
};

/// Newton's step from the start of a period to the state that a motion returns to, or nothing if there is none; z and
/// z' stay as they are if a wall presses the loose mass.
[[nodiscard]] std::optional<HousingState> step_to_return(const HousingState& start, const HousingMotion& motion);

}  // namespace clatter::certificates
