#pragma once

#include <optional>
#include <vector>

#include "flow.hpp"

namespace verify {

enum class Kind { impact, touch, separation, renewal, graze, reversal, chatter, rest, stick, press, end };

[[nodiscard]] const char* name_of(Kind kind);

/// The derivative of an event's velocity by the state at the start and by the parameter.
struct Slopes {
  Ball by_x, by_v, by_parameter;
};

/// Something that happens to all motions of a set.
struct Event {
  Kind kind = Kind::end;
  Side side = Side::lower;
  Ball time, v;  ///< v: before an impact; of one on a wall of a loose mass z'
  Ball until;    ///< of a chatter, a rest, a stick or a press
  Ball gap{};    ///< of a graze: the least that is left to the stop, or of its force; below 0 the motion passes through
  Slopes slopes{};
  Ball x{};  ///< of a reversal or a stick: the place
};

/// Whether a stop holds the mass, or a wall the loose mass.
[[nodiscard]] inline bool holds(Kind kind) { return kind == Kind::rest || kind == Kind::press; }
/// Whether an event has an end of its own, `until`.
[[nodiscard]] inline bool lasts(Kind kind) { return holds(kind) || kind == Kind::chatter || kind == Kind::stick; }
[[nodiscard]] inline bool is_of_friction(Kind kind) { return kind == Kind::reversal || kind == Kind::stick; }

/// The state that a motion starts from.
struct Start {
  Ball time;
  Ball x, v;
  bool released = false;  ///< by a stop, at the phase nearest to `time` at which the force that presses falls to 0
  Side side = Side::lower;
  Ball z{}, w{};                  ///< of a loose mass: its place in the housing, and z'
  std::optional<Side> pressed{};  ///< the wall that presses it
};

/// How well the end of a chatter is to be told.
struct ChatterAim {
  double accuracy;  ///< of the time of its end
  double height;    ///< its flights are followed until the others stay within so much of the stop
  Ball latest;      ///< the latest claimed end: of a chatter that goes on the next event shows it
  Ball end;         ///< of the motion
};

/// A stretch of motion without an event, for those who look into it.
struct Stretch {
  Flow::Flight flight;
  Ball length;
};

/// The motion of a set of states from event to event, in proved bounds.
class Followed {
 public:
  Followed() = default;
  Followed(const Followed&) = default;
  Followed(Followed&&) = default;
  Followed& operator=(const Followed&) = delete;
  Followed& operator=(Followed&&) = delete;
  virtual ~Followed() = default;

  /// The next event before a time, or the end there, at which the motion stays.
  virtual Event next(const Ball& end) = 0;
  /// Whether no event is before a time, or at it.
  [[nodiscard]] virtual bool is_clear_until(const Ball& time) const = 0;
  /// Passes the place near a time at which the motion turns without meeting a stop, or a soft stop's force turns
  /// without falling to 0, or at which it is taken to do so: that margin is believed there.
  virtual Event graze(Side side, const Ball& about, const Ball& end) = 0;
  /// The end of the chatter that the last impact began; or, if none ends in time, an event that shows it, or the end of
  /// the motion. Throws Undecided if neither is proved.
  virtual Event finish_chatter(const ChatterAim& aim) = 0;
  /// The rest that begins now, up to its release or to a time.
  virtual Event finish_rest(const Ball& end) = 0;

  [[nodiscard]] virtual bool is_resting() const = 0;
  [[nodiscard]] virtual bool is_sticking() const = 0;
  /// Whether the motion has come to its end, after which nothing happens.
  [[nodiscard]] bool is_at_end() const { return at_end_; }

  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
  /// Places at which the mass was held, and displacements that hold those of the flights of chatters that aren't
  /// followed.
  [[nodiscard]] const std::vector<Ball>& other_places() const { return other_places_; }

 protected:
  std::vector<Stretch> stretches_{};
  std::vector<Ball> other_places_{};
  bool at_end_ = false;
};

}  // namespace verify
