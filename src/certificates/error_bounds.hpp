#pragma once

#include <array>
#include <complex>
#include <vector>

#include "certificates/certificate.hpp"
#include "certificates/recorded_motion.hpp"
#include "point/point.hpp"

namespace clatter::certificates {

constexpr double of_state = 1e-12;       ///< error of the state at the start over the size of the motion
constexpr double of_arithmetic = 1e-13;  ///< of each later one: some dozens of roundings
constexpr double of_chatter = 1e-9;      ///< of the time that a chatter takes
constexpr double of_multiplier = 1e-9;

/// Whether the errors of a certificate are small beside the size of its motion and the forcing period, so that it says
/// something.
[[nodiscard]] bool tells(const Certificate& certificate, double size, double forcing_period);

/// How far the numbers of a motion in double may be off: a small share of its size, as much of it as the motion
/// stretches. An estimate, not a proof: to prove is up to the verifier.
class ErrorBounds {
 public:
  /// Of a motion from the start of a problem at a time on; `periodic`: its state is one that returns.
  ErrorBounds(const point::Problem& problem, const RecordedMotion& motion, const point::PointResult& result,
              double time, bool periodic);

  /// Claims an event of the motion that follows another, null if it is the first.
  [[nodiscard]] ClaimedEvent claimed(const RecordedEvent& event, const ClaimedEvent* before) const;
  /// Whether a periodic motion is alone, so that its start is known.
  [[nodiscard]] bool know_the_start() const { return of_start_ < 1e10; }
  /// Of x and of v at the start.
  [[nodiscard]] double of_start() const { return of_state * size_ * of_start_; }
  /// Whether the errors of a motion's claims are small beside it, so that they say something.
  [[nodiscard]] bool tell(const Certificate& certificate) const { return tells(certificate, size_, forcing_period_); }
  [[nodiscard]] ClaimedEnd claimed_end(const RecordedMotion& motion) const;
  [[nodiscard]] Claimed claimed_extremum(double x) const;
  /// Of motion that rests both are 0.
  [[nodiscard]] std::vector<ClaimedMultiplier> claimed(const std::array<std::complex<double>, 2>& multipliers) const;

 private:
  struct StateError {
    double x, v;
  };
  /// Of a state after a path since the event before, by the derivative of the motion and the rounding so far.
  [[nodiscard]] StateError error_after(const motion::Jacobian<double>& derivative,
                                       const std::array<double, 2>& rounding, double path) const;
  [[nodiscard]] double time_error(double time) const;
  [[nodiscard]] double place_of(const RecordedEvent& event) const;
  [[nodiscard]] double acceleration(const RecordedEvent& event) const;
  [[nodiscard]] ClaimedEvent claimed_contact(const RecordedEvent& event, double since) const;
  [[nodiscard]] ClaimedEvent claimed_stay(const RecordedEvent& event, const ClaimedEvent* before) const;
  /// Of a stick or a reversal, the velocity of a slip being 0.
  [[nodiscard]] ClaimedEvent claimed_turn(const RecordedEvent& event) const;
  [[nodiscard]] double chatter_error(const RecordedEvent& event, const ClaimedEvent* before) const;
  [[nodiscard]] double release_error(const RecordedEvent& event, double x, double x_error) const;
  [[nodiscard]] double push_at(double time, double x) const;
  [[nodiscard]] double stiffness_at(double x) const;

  Oscillator oscillator_;
  Friction friction_;
  Stops stops_;
  double phase_, begin_, forcing_period_;
  double size_, of_start_, stretching_;  ///< S, error of the start over 1e-12 S, largest norm of the derivative
};

}  // namespace clatter::certificates
