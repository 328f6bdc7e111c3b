#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "attractors/exact_run.hpp"
#include "motion/event.hpp"
#include "scene/scene.hpp"

namespace clatter::branches {

using motion::Event;

/// Whether the mass is in contact with a soft stop after an event.
[[nodiscard]] constexpr bool presses(Event::Kind kind) {
  return kind == Event::Kind::touch || kind == Event::Kind::renewal;
}

/// Whether the mass halts at an event: dry friction ends a slip, and the velocity is 0.
[[nodiscard]] constexpr bool halts(Event::Kind kind) {
  return kind == Event::Kind::stick || kind == Event::Kind::reversal;
}

/// Whether an event is one of a soft stop, at which its contact with the mass begins or ends.
[[nodiscard]] constexpr bool is_of_soft_stop(Event::Kind kind) {
  return presses(kind) || kind == Event::Kind::separation;
}

/// Whether restitution changes the velocity: on a rigid stop, or on a wall of a housing.
[[nodiscard]] constexpr bool is_impact(Event::Kind kind) {
  return kind == Event::Kind::impact || kind == Event::Kind::strike;
}

/// An event of a periodic motion by the numbers that its equations solve for. An `Event` has others: its time in tau,
/// which depends on the frequency, and all that follows from these, such as the velocity after it.
struct OrbitEvent {
  Side side = Side::none;  ///< the stop or the wall; of a halt the side that the mass slips to next
  double phase = 0.0;      ///< forcing phase, rad, growing from event to event
  double before = 0.0;     ///< velocity before it, at a wall z'
  Event::Kind kind = Event::Kind::impact;
  double rest = 0.0;   ///< forcing phase, rad, for which the mass rests on the stop from then on
  double place = 0.0;  ///< of a halt: displacement from `SceneNumbers::middle`
  /// The other one of two masses before it: at a strike the main mass, its displacement from `SceneNumbers::middle` and
  /// its velocity; at any other event the loose one, its place from `SceneNumbers::middle_of_walls`, and z'.
  struct Other {
    double place = 0.0, before = 0.0;
  };
  Other other{};
  /// The soft stop, or none, that the main mass is in contact with from a halt on, or from a strike on, if that changes
  /// it: it takes away the force of a damper, or brings it.
  std::optional<Side> contact{};

  /// The unknown beside the phase: the velocity before the event, or the place of a halt.
  [[nodiscard]] double coordinate() const { return halts(kind) ? place : before; }
  [[nodiscard]] double& coordinate() { return halts(kind) ? place : before; }
  /// The side that the mass moves to after it, under dry friction up to the next event.
  [[nodiscard]] Side heading() const { return halts(kind) || kind == Event::Kind::touch ? side : opposite(side); }
  /// The soft stop beyond whose position the mass halts; none: between the stops.
  [[nodiscard]] Side held_by() const { return contact.value_or(Side::none); }

  /// Whether it is one of a loose mass, on a wall of its housing.
  [[nodiscard]] bool is_of_wall() const { return kind == Event::Kind::strike; }
  /// Whether it is a contact from outside: an impact, or a touch.
  [[nodiscard]] bool is_contact() const { return is_impact(kind) || kind == Event::Kind::touch; }
  /// Whether it is a letter of the impact word: an impact, a touch, or a graze of a soft stop.
  [[nodiscard]] bool is_letter() const { return is_contact() || (kind == Event::Kind::separation && before == 0); }
};

/// Letters of words beside those of stops.
struct WordLetters {
  bool sticks = false;  ///< one for each stick
  bool walls = true;    ///< walls of a loose mass have letters of their own; false: those of stops, as it has no stops
};

/// A periodic motion by its events. A motion that is its own mirror image half a period later is kept as that half,
/// so that the loss of its symmetry and its fold are told apart.
struct Orbit {
  std::vector<OrbitEvent> events;
  int half_turns = 2;         ///< half forcing periods after which the events begin again, mirrored if so said
  bool mirrored = false;      ///< then half_turns is odd
  Side pressed = Side::none;  ///< the soft stop that the mass is in contact with, if it has no event on stops

  [[nodiscard]] std::size_t size() const { return events.size(); }
  [[nodiscard]] bool rests() const;  ///< on a stop, once in a period or more often
  [[nodiscard]] bool next_is_rest(std::size_t i) const { return i + 1 < size() && events[i + 1].rest > 0; }
  [[nodiscard]] bool meets_soft_stop() const;
  [[nodiscard]] bool halts() const;  ///< by dry friction, away from rigid stops
  /// Whether all that it does is to halt, between the stops.
  [[nodiscard]] bool is_of_free_halts() const;
  [[nodiscard]] bool meets_walls() const;
  [[nodiscard]] bool meets_stops() const;  ///< any event is one of the main mass
  /// The soft stop that the mass is in contact with just after event i = 0, 1, ..., size() - 1.
  [[nodiscard]] Side pressed_after(std::size_t i) const;
  /// Whether the motion is a solution without the event i, which grazes, too.
  [[nodiscard]] bool changes_nothing(std::size_t i) const;
  [[nodiscard]] double advance() const;       ///< of the forcing phase, rad
  [[nodiscard]] double period_ratio() const;  ///< period in forcing periods
  /// Whether the flight after event i ends in the mirror image of the first one.
  [[nodiscard]] bool ends_mirrored(std::size_t i) const { return mirrored && i + 1 == size(); }
  /// Event i = 0, 1, ...: from number size on it is one of the first again, half a period or a period later.
  [[nodiscard]] OrbitEvent event(std::size_t i) const;
  /// The side that the mass moves to before event i, under dry friction.
  [[nodiscard]] Side heading_before(std::size_t i) const;

  [[nodiscard]] Orbit from_event(std::size_t i) const;  ///< this motion, with event i as its first
  [[nodiscard]] Orbit whole() const;                    ///< both halves, if one is kept
  [[nodiscard]] Orbit mirror_image() const;             ///< half a forcing period later
  [[nodiscard]] Orbit repeated(int times) const;        ///< of the whole, as if it repeated only after so many periods
  /// One of its repetitions, if it repeats sooner; kept as a half, if it can be.
  [[nodiscard]] Orbit half_if_same(double tolerance, bool symmetric_scene) const;
  [[nodiscard]] Orbit with(const OrbitEvent& event, std::size_t after) const;
  [[nodiscard]] Orbit with_kind(std::size_t i, Event::Kind kind) const;  ///< event i is another one
  [[nodiscard]] Orbit without(std::size_t i) const;  ///< motion without events has the force's period
  /// The motion in one repetition of what is left without event i, which has no speed: a motion over many periods that
  /// grazes in one of them grazes in all.
  [[nodiscard]] Orbit once_with_graze(std::size_t i, bool symmetric_scene) const;

  /// As `ImpactWord` gives it.
  [[nodiscard]] std::string word(const WordLetters& letters = {}) const;
  [[nodiscard]] std::string regime(const WordLetters& letters = {}) const;
};

/// The motion of a run between rigid stops over whole forcing periods from a phase on, in rad.
[[nodiscard]] Orbit orbit_of(const attractors::Round& round, double nu, double phase = 0.0);

}  // namespace clatter::branches
