#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>

namespace clatter {
inline namespace model {

enum class Side : std::int8_t { lower = -1, none = 0, upper = 1 };

/// Index of a stop in results: 0 the lower, 1 the upper one.
[[nodiscard]] constexpr std::size_t index_of(Side side) { return side == Side::upper ? 1 : 0; }

/// +1 at the upper stop, -1 at the lower one.
[[nodiscard]] constexpr int sign_of(Side side) { return static_cast<int>(side); }

/// The two rigid stops and the share of its speed that the mass keeps at each (eq. 4): x'+ = -R x'-.
struct Stops {
  double lower = -std::numeric_limits<double>::infinity();  ///< position of the lower stop; -inf: none
  double upper = std::numeric_limits<double>::infinity();   ///< position of the upper stop; +inf: none
  double restitution_lower = 1.0;                           ///< R of the lower stop, 0 ... 1
  double restitution_upper = 1.0;                           ///< R of the upper stop, 0 ... 1
};

}  // namespace model
}  // namespace clatter
