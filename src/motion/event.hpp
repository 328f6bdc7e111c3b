#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "scene/stops.hpp"

namespace clatter::motion {

/// An event of a motion, or a time for which something holds it, as observers are told of it and as it is recorded.
struct Event {
  enum class Kind : std::uint8_t {
    impact,      ///< on a rigid stop
    rest,        ///< on a rigid stop
    chatter,     ///< its summed end, or a part of that if a section cuts it; or a force within rounding of 0 is waited
                 ///< for: too low to be told from rest
    touch,       ///< of a soft stop at its position, where contact begins
    renewal,     ///< of the contact with a soft stop, whose force rises from zero, beyond its position
    separation,  ///< from a soft stop, whose force falls to zero
    stick,       ///< away from rigid stops: friction alone holds the mass
    reversal,    ///< of a slip: the velocity falls to 0 and changes its sign at once
    strike,      ///< of a loose mass on a wall of its housing
    press,       ///< a loose mass comes to rest on a wall; the rest of its chatter is lost at once
    hold,        ///< a wall presses a loose mass, or friction holds it, so that it moves with the main mass
    wall_touch,  ///< of a loose mass at the place of a soft wall, where contact begins
    wall_renewal,     ///< of its contact with a soft wall, whose force rises from zero, beyond its place
    wall_separation,  ///< of it from a soft wall, whose force falls to zero
  };
  /// The word for a kind.
  [[nodiscard]] static constexpr std::string_view word(Kind kind) {
    constexpr std::array<std::string_view, 14> words{
        "impact",   "rest",   "chatter", "touch", "renewal",    "separation",   "stick",
        "reversal", "strike", "press",   "hold",  "wall touch", "wall renewal", "wall separation"};
    return words[static_cast<std::size_t>(kind)];
  }
  /// The motion of a stop by itself at an event on it.
  struct StopMotion {
    double velocity = 0.0, acceleration = 0.0;
  };
  /// The main mass at an event of a loose one: its displacement, and its velocities on both sides.
  struct Main {
    double place = 0.0, before = 0.0, after = 0.0;
  };

  Kind kind = Kind::impact;
  Side side = Side::none;  ///< the stop, or the wall; none: friction alone holds or turns a mass
  double time = 0.0;       ///< tau since observation began; of a time that lasts its beginning
  double before = 0.0;   ///< velocity before it, of a loose mass z', of a stop that moves by itself relative to it; of
                         ///< a chatter at its beginning
  double length = 0.0;   ///< of what lasts, tau
  double after = 0.0;    ///< velocity after it, likewise; of a chatter at its end
  double place = 0.0;    ///< displacement, of a loose mass z; on a stop or a wall that of these
  double turns = 0.0;    ///< of a contact: forcing periods since the section before it, 0 ... 1
  bool held = true;      ///< of what lasts: at rest; false: a chatter, or a force within rounding of 0 is waited for
  bool has_arc = false;  ///< of what lasts: an arc shows it, too, since a loose mass, or the stop, moves meanwhile
  double carried = 0.0;  ///< of a rest and a stick: the loose mass, over the main one, that it carries meanwhile
  double rubbing = 0.0;  ///< of these: the friction of a loose mass that slides meanwhile
  double a_before = 0.0, a_after = 0.0;  ///< of a reversal: the accelerations, between which friction makes it jump
  Main main{};                           ///< of a strike and a press
  StopMotion stop{};                     ///< of the stop of a contact or a rest
  bool of_wall = false;                  ///< of a loose mass, but told as one of a mass between stops

  [[nodiscard]] double end() const { return time + length; }
  [[nodiscard]] bool is_stick() const { return kind == Kind::stick; }
  /// Whether it is a time, not an instant.
  [[nodiscard]] bool lasts() const {
    return kind == Kind::rest || kind == Kind::chatter || kind == Kind::stick || kind == Kind::hold;
  }
  /// Whether it is one of a loose mass with a soft wall.
  [[nodiscard]] bool is_of_soft_wall() const {
    return kind == Kind::wall_touch || kind == Kind::wall_renewal || kind == Kind::wall_separation;
  }
  /// Whether a contact begins or ends with it, with speed.
  [[nodiscard]] bool is_contact() const { return !lasts() && kind != Kind::reversal && kind != Kind::press; }
  /// With which the mass comes to it; 0 where it stays, in a chatter, too.
  [[nodiscard]] double velocity() const { return lasts() ? 0.0 : before; }
  [[nodiscard]] double speed() const { return std::abs(velocity()); }

  /// An event of a loose mass as one of a mass between stops, which its walls are: a strike as an impact, one with a
  /// soft wall as that with a soft stop, a hold as a rest, by friction alone as a stick. Others are as they are.
  [[nodiscard]] Event in_housing() const {
    Event same = *this;
    if (kind == Kind::strike) same.kind = Kind::impact;
    if (kind == Kind::wall_touch) same.kind = Kind::touch;
    if (kind == Kind::wall_renewal) same.kind = Kind::renewal;
    if (kind == Kind::wall_separation) same.kind = Kind::separation;
    if (kind == Kind::hold)  // the arc is that of the main mass
      same.kind = side == Side::none ? Kind::stick : Kind::rest, same.has_arc = false;
    same.of_wall = same.kind != kind;
    return same;
  }
  /// A strike as the impact of the main mass that it is. Others are as they are.
  [[nodiscard]] Event of_main() const {
    if (kind != Kind::strike) return *this;
    return {Kind::impact, side, time, main.before, 0.0, main.after, main.place, turns};
  }
};

}  // namespace clatter::motion
