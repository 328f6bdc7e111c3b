#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "certificates/certificate.hpp"
#include "certificates/recorded_motion.hpp"
#include "point/point.hpp"

namespace clatter::certificates {

constexpr double of_state = 1e-12;       ///< error of the state at the start over the size of the motion
constexpr double of_arithmetic = 1e-13;  ///< of each later one: some dozens of roundings
constexpr double of_chatter = 1e-9;      ///< of the time that a chatter takes
constexpr double of_multiplier = 1e-9;

/// How far the numbers of a motion of n numbers in double may be off: a small share of its size, as much of it as the
/// motion stretches. An estimate, not a proof: to prove is up to the verifier.
template <std::size_t n>
class Bounds {
 public:
  /// Whether a periodic motion is alone, so that its start is known.
  [[nodiscard]] bool know_the_start() const { return of_start_ < 1e10; }
  /// Of each number at the start.
  [[nodiscard]] double of_start() const { return of_state * size_ * of_start_; }
  [[nodiscard]] Claimed claimed_extremum(double x) const {
    return {x, (of_state * of_start_ + of_arithmetic) * size_ * stretching_};
  }
  /// Whether the errors of a motion's claims are small beside its size and the forcing period, so that they say
  /// something.
  [[nodiscard]] bool tell(const Certificate& certificate) const {
    constexpr double small = 1e-3;
    const auto known = [](const Claimed& claim, double scale) { return claim.error <= small * scale; };
    const auto& end = certificate.end;
    return certificate.x_error <= small * size_ && known(certificate.x_min, size_) && known(certificate.x_max, size_) &&
           (!end || (known(end->x, size_) && known(end->v, size_) && known(end->z, size_) && known(end->w, size_))) &&
           std::ranges::all_of(certificate.events,
                               [&](const ClaimedEvent& event) { return known(event.time, forcing_period_); });
  }

 protected:
  using Map = typename Growth<n>::Map;
  using Sizes = typename Growth<n>::Sizes;

  /// Of a motion from the start of a problem at a time on; `returns`: the norm of (1 - M)^-1 if it is periodic, which
  /// is how far the state that returns moves if the motion is off; else 0.
  Bounds(const point::Problem& problem, const RecordedMotion<n>& motion, double time, double size, double returns)
      : oscillator_(problem.oscillator),
        phase_(problem.start.phase),
        begin_(time),
        forcing_period_(period_of(problem.oscillator)),
        size_(size),
        stretching_(std::max(1.0, Growth<n>::norm(motion.derivative))) {
    // rounding that a part of the period stretches up to its end, though the whole of it may contract
    if (returns > 0) of_start_ = returns * std::max(1.0, of_arithmetic / of_state * largest(motion.rounding));
    for (const RecordedEvent<n>& event : motion.events)
      stretching_ = std::max({stretching_, Growth<n>::norm(event.derivative), largest(event.rounding)});
  }

  [[nodiscard]] double time_error(double time) const {
    return of_arithmetic * (forcing_period_ + std::abs(begin_) + std::abs(time));
  }
  [[nodiscard]] static double largest(const Sizes& sizes) { return *std::ranges::max_element(sizes); }

  Oscillator oscillator_;
  double phase_, begin_, forcing_period_;
  double size_, of_start_ = 1.0, stretching_;  ///< S, error of the start over 1e-12 S, largest norm of the derivative
};

/// Of a mass between stops.
class ErrorBounds : public Bounds<2> {
 public:
  ErrorBounds(const point::Problem& problem, const RecordedMotion<2>& motion, const point::PointResult& result,
              double time, bool periodic);

  /// Claims an event of the motion that follows another, null if it is the first.
  [[nodiscard]] ClaimedEvent claimed(const RecordedEvent<2>& event, const ClaimedEvent* before) const;
  [[nodiscard]] ClaimedEnd claimed_end(const RecordedMotion<2>& motion) const;
  /// Of motion that rests both are 0.
  [[nodiscard]] std::vector<ClaimedMultiplier> claimed(const std::array<std::complex<double>, 2>& multipliers) const;

 private:
  struct StateError {
    double x, v;
  };
  /// Of a state after a path since the event before, by the derivative of the motion and the rounding so far.
  [[nodiscard]] StateError error_after(const Map& derivative, const Sizes& rounding, double path) const;
  [[nodiscard]] double place_of(const RecordedEvent<2>& event) const;
  [[nodiscard]] double acceleration(const RecordedEvent<2>& event) const;
  [[nodiscard]] ClaimedEvent claimed_contact(const RecordedEvent<2>& event, double since) const;
  [[nodiscard]] ClaimedEvent claimed_stay(const RecordedEvent<2>& event, const ClaimedEvent* before) const;
  /// Of a stick or a reversal, the velocity of a slip being 0.
  [[nodiscard]] ClaimedEvent claimed_turn(const RecordedEvent<2>& event) const;
  [[nodiscard]] double chatter_error(const RecordedEvent<2>& event, const ClaimedEvent* before) const;
  [[nodiscard]] double release_error(const RecordedEvent<2>& event, double x, double x_error) const;
  [[nodiscard]] double push_at(double time, double x) const;
  [[nodiscard]] double stiffness_at(double x) const;

  Friction friction_;
  Stops stops_;
};

}  // namespace clatter::certificates
