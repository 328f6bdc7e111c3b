#pragma once

#include <array>
#include <optional>
#include <utility>
#include <variant>

#include "motion/first_crossing.hpp"

namespace clatter::motion {

/// The oscillators that the mass belongs to while it is in contact with soft stops (eq. 51). Their damping and
/// resonance are of a class of their own, which only the scene's numbers decide.
template <class Number>
class SoftContact {
 public:
  SoftContact() = default;
  template <Effects E, class Given>
  SoftContact(const ArcConstants<Number, E>& free, const BasicStops<Given>& stops) {
    for (const Side side : {Side::lower, Side::upper})
      if (is_soft(stops, side))
        of_stop_[index_of(side)].emplace(constants_for(free, soft_stop_at<Number>(stops, side)));
  }

  /// Calls `function(constants)` with those of motion in contact with the soft stop on a side.
  template <class Function>
  decltype(auto) with_constants(Side side, Function&& function) const {
    return std::visit(std::forward<Function>(function), *of_stop_[index_of(side)]);
  }

 private:
  template <Damping damping, Forcing forcing>
  using Of = ArcConstants<Number, Effects{.damping = damping, .forcing = forcing, .stiffness = true}>;
  using Any = std::variant<Of<Damping::light, Forcing::regular>, Of<Damping::light, Forcing::secular>,
                           Of<Damping::heavy, Forcing::regular>>;

  template <Effects E>
  [[nodiscard]] static Any constants_for(const ArcConstants<Number, E>& free, const SoftStop<Number>& stop) {
    const Oscillator pressed{.damping = static_cast<double>(free.h + stop.damping),
                             .forcing = static_cast<double>(free.f),
                             .frequency = static_cast<double>(free.nu),
                             .stiffness = static_cast<double>(free.k + stop.stiffness),
                             .shape = {.waveform = free.shape.waveform}};
    if (!rotates(pressed)) return Of<Damping::heavy, Forcing::regular>::in_contact(free, stop);
    if (forcing_of(pressed) == Forcing::secular) return Of<Damping::light, Forcing::secular>::in_contact(free, stop);
    return Of<Damping::light, Forcing::regular>::in_contact(free, stop);
  }

  std::array<std::optional<Any>, 2> of_stop_;  ///< [stop]
};

/// In place of it if no stop in reach is soft.
struct NoSoftContact {
  template <class Constants, class Given>
  NoSoftContact(const Constants&, const BasicStops<Given>&) {}
};

}  // namespace clatter::motion
