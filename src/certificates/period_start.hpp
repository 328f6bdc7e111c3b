#pragma once

#include <optional>

#include "certificates/recorded_motion.hpp"

namespace clatter::certificates {

/// The instant at which the certificate of a periodic motion begins.
struct PeriodStart {
  double time = 0.0;           ///< tau since a section, 0 ... duration
  Side released = Side::none;  ///< the stop that releases the mass then, so that the state is known; none: in flight
  bool rests_for_ever = false;
};

/// The release from a rest of a periodic motion, if it has one, else the middle of its longest flight, clear of stops.
[[nodiscard]] PeriodStart start_of_period(const RecordedMotion& from_section);

}  // namespace clatter::certificates
