#pragma once

#include <optional>
#include <vector>

#include "hard/cases.hpp"
#include "math/fifty_digits.hpp"
#include "point/exact_motion.hpp"

namespace clatter::hard {

/// An event of a run in 50 digits. Rests and chatters are whole, however many sections cut them.
struct ExactEvent {
  using Kind = motion::Event::Kind;

  Kind kind = Kind::impact;
  Side side = Side::none;
  FiftyDigits time{};      ///< tau since the start
  FiftyDigits velocity{};  ///< before it; 0 of a rest and a chatter
  FiftyDigits until{};     ///< of a rest and a chatter: its end, tau
  bool low = false;        ///< an impact from which on a run in double sums the chatter
};

/// A run in 50 digits, no number of which is rounded to double.
struct ExactRun {
  std::vector<ExactEvent> events{};
  FiftyDigits x{}, v{};                         ///< at the end
  std::optional<FiftyDigits> x_min{}, x_max{};  ///< of the run; nothing if they aren't looked for
};

/// Runs a case in 50 digits. Of a chatter it lists the impacts that a run in double lists. Throws std::runtime_error if
/// the run isn't completed, or ends within a summed chatter.
[[nodiscard]] ExactRun exact_run(const Case& one);

/// A case that meets no stop, by the closed form of its only flight, without extrema: 10^7 periods one by one take
/// hours.
[[nodiscard]] ExactRun exact_flight(const Case& one);

}  // namespace clatter::hard
