#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "certificates/certificate.hpp"
#include "certificates/recorded_motion.hpp"
#include "point/point.hpp"

namespace clatter::certificates {

/// Why a point has no certificate, besides its status.
enum class Without : std::uint8_t {
  none,           ///< it has one
  status,         ///< its motion has no period, or the point has failed
  force,          ///< periodic without a force
  family,         ///< one of many periodic motions side by side: a multiplier is 1 to rounding
  graze,          ///< the smallest change of the motion decides whether it meets a stop
  cut_chatter,    ///< it ends within a chatter
  rounding,       ///< the motion stretches rounding so much that its events aren't known
  no_such_claim,  ///< a special point of a kind, or of a motion, that the format has no claim of
};

/// A point that was run anew.
struct CertifiedPoint {
  steady::Status status = steady::Status::unresolved;
  double periods = 0.0;  ///< of periodic motion, in those of the force
  std::string word{};    ///< of periodic motion
  point::End end{};      ///< from which the next point of a branch starts
  Without without = Without::status;
  std::optional<Certificate> certificate{};
};

/// States what is claimed of a periodic motion that starts with `result.end`, from its period, extrema, multipliers,
/// word and symmetry.
[[nodiscard]] CertifiedPoint certified_period(const point::Problem& problem, const point::PointResult& result);

/// Runs a point, and states what is claimed of its motion.
[[nodiscard]] CertifiedPoint certified(const point::Problem& problem, point::ThreadScratch& scratch);

}  // namespace clatter::certificates
