#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string>
#include <string_view>

#include "certificates/certificate.hpp"
#include "certificates/recorded_motion.hpp"
#include "point/point.hpp"

namespace clatter::certificates {

/// Why a point has no certificate, besides its status.
enum class Without : std::uint8_t {
  none,            ///< it has one
  status,          ///< its motion has no period, or the point has failed
  force,           ///< periodic without a force
  family,          ///< one of many periodic motions side by side: a multiplier is 1 to rounding
  graze,           ///< the smallest change of the motion decides whether it meets a stop
  cut_chatter,     ///< it ends within a chatter
  rounding,        ///< the motion stretches rounding so much that its events aren't known
  soft_wall,       ///< a loose mass has a soft wall, which certificates don't state
  force_shape,     ///< a force that is no sine
  stop_motion,     ///< stops that move by themselves
  law_of_speed,    ///< a chatter, or a special point, under a restitution that depends on the speed, without a claim
  loose_friction,  ///< a loose mass that rubs on its housing chatters there, or stops beside a main mass that is held
  both_held,       ///< a stop or friction holds the main mass while a wall presses the loose one
  one_instant,     ///< two events come within rounding of each other
  no_such_claim,   ///< a special point of a kind, or of a motion, that the format has no claim of
};

/// A point with a certificate of its motion, or the reason why it has none.
struct CertifiedPoint {
  steady::Status status = steady::Status::unresolved;
  Without without = Without::status;
  std::optional<Certificate> certificate{};
  std::string differs{};  ///< a result that isn't that of the file, or of the run that it claims; empty: none
};

/// The result of a run at a point, as far as a certificate states it, in computed units.
struct KnownResult {
  steady::Status status = steady::Status::unresolved;
  double periods = 0.0;                                                    ///< forcing periods observed
  std::string word{};                                                      ///< without sticks; empty: not observed
  double x_min = std::numeric_limits<double>::quiet_NaN(), x_max = x_min;  ///< NaN: not observed
  point::End end{};

  KnownResult() = default;
  KnownResult(const point::Problem& problem, const point::PointResult& result);
};

/// States what is claimed of a periodic motion that starts with `result.end`, from its period, extrema, multipliers,
/// word and symmetry.
[[nodiscard]] CertifiedPoint certified_period(const point::Problem& problem, const point::PointResult& result);

/// States what is claimed of the motion at a point that a run has found, a periodic one from the end of the run on.
[[nodiscard]] CertifiedPoint certified(const point::Problem& problem, const KnownResult& known,
                                       point::ThreadScratch& scratch);

}  // namespace clatter::certificates
