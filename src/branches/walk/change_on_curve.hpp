#pragma once

#include <optional>

#include "branches/walk/halt_change.hpp"

namespace clatter::branches {

/// The end of a curve under dry friction: its halts change there, one of them comes to a stop, or an impact loses its
/// speed.
struct ChangeOnCurve {
  SpecialKind kind;
  CurvePoint at;
  std::optional<std::size_t> event{};  ///< that comes to a stop, or has no speed
};
/// Within a step of a walk: the motion on it is followed to where the first of the changes that its violations show is
/// exact, whatever it is beyond. Nothing if halts don't end the curve.
[[nodiscard]] std::optional<ChangeOnCurve> change_on_curve(const Equations& builder, const OrbitEquations& walked,
                                                           const Walk& walk, double step, const Narrowed& between);

}  // namespace clatter::branches
