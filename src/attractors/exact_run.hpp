#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "attractors/section_state.hpp"
#include "motion/loose_tangent.hpp"
#include "observables/contacts/impact_word.hpp"
#include "point/problem.hpp"
#include "steady/map_orbit.hpp"

namespace clatter::attractors {

/// A problem that starts from another state, at another phase of the force or of the shaking (rad).
[[nodiscard]] point::Problem started(point::Problem problem, const SectionState& state, double phase);

/// The problem of a loose mass that no wall meets: that of the main mass alone, unless friction in the housing draws
/// it.
[[nodiscard]] point::Problem floating(point::Problem problem);

/// A motion over some forcing periods with its derivative and its contacts.
struct Round {
  steady::MapOrbit orbit;
  std::vector<observables::ImpactWord::Contact> contacts;  ///< times in tau since the start
  bool meets_walls = false;                                ///< with a loose mass
  double middle_of_flight = 0.0;  ///< of the longest one, forcing periods after the start; a flight may span the end
  double fastest = 0.0;           ///< speed of an impact
  std::vector<SectionState> states{};                 ///< at its sections; the last as computed from the first
  std::optional<motion::LooseJacobian> derivative{};  ///< with a loose mass, of (x, x', y, y')

  [[nodiscard]] SectionState gap() const { return difference(states.front(), states.back()); }
  /// The same of a loose mass that rubs: if it meets no wall it may be anywhere, and its place stays what it is.
  [[nodiscard]] motion::LooseJacobian derivative_in_housing() const;
};

/// The step of Newton's method from the beginning of a round towards a state that it brings back.
[[nodiscard]] SectionState newton_step(const Round& round);

/// The largest modulus of the multipliers of a round.
[[nodiscard]] double spectral_radius(const Round& round);

/// Runs a problem exactly from its start over whole forcing periods, at most RepeatFinder::longest; nothing if it
/// fails. If the states at the sections are given, each period is run from its own.
[[nodiscard]] std::optional<Round> run_round(const point::Problem& problem, std::size_t periods,
                                             std::span<const motion::State<double>> sections = {});

/// The impact word of a round.
[[nodiscard]] std::string word_of(const point::Problem& problem, const Round& round);

/// The state so many forcing periods after the start; nothing if the run fails.
[[nodiscard]] std::optional<SectionState> state_after(const point::Problem& problem, double turns);

/// The states at the forcing phase of the start in successive periods.
struct Sections {
  std::vector<SectionState> states;  ///< after 1, 2, … periods, until the motion repeats
  std::size_t repeats_after = 0;     ///< forcing periods; 0: it doesn't repeat
  bool meets_walls = false;          ///< with a loose mass
  double log_area =
      0.0;  ///< logarithm of the factor by which all of them changed a small area of states; with a loose mass volume
};

/// Runs a problem for so many forcing periods, or until it repeats; nothing if it fails.
[[nodiscard]] std::optional<Sections> run_sections(const point::Problem& problem, std::size_t periods);

}  // namespace clatter::attractors
