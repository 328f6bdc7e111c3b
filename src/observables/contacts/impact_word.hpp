#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <tuple>
#include <vector>

#include "observables/observable.hpp"
#include "scene/stops.hpp"

namespace clatter::observables {

/// The impacts of one period as a word over the stops, L and U, and the symmetry of the motion; for motion that has a
/// period.
struct ImpactWord {
  struct Settings {
    bool word = false;
    bool word_sticks = false;
    bool word_walls = false;  ///< with it: walls of a loose mass are told from stops
  };
  struct Values {
    std::string impact_word{}, regime{};  ///< empty: no period; of the regime also no force
    double symmetric = no_value;          ///< 1 or 0; NaN: no period, or the scene isn't symmetric
  };
  static constexpr std::size_t longest = 64;           ///< characters of a word
  static constexpr std::string_view no_contact = "-";  ///< the word of motion that meets no stop
  static constexpr std::string_view stuck = "(S)";     ///< of a mass that friction holds for good, beside other motions
  static constexpr std::tuple fields{Field{Key{"observe", "word", Kind::flag, "false", "true",
                                               "impacts of one period in order, e.g. LLU (L lower, U upper stop), "
                                               "their number over periods, symmetry of the motion"},
                                           &Settings::word},
                                     Field{with("[scene]\nfriction = 0.2\n\n[observe]\nword = true\n",
                                                Key{"observe", "word_sticks", Kind::flag, "false", "true",
                                                    "with word: a letter S for each time in which dry friction holds "
                                                    "the mass away from rigid stops"}),
                                           &Settings::word_sticks}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.word; }
  [[nodiscard]] static std::string description(const Settings&) { return "impact words"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&);
  /// Motion without a period has no word; its other results need no flights from the scalar loop.
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan& span) { return !span.periodic; }

  /// An impact, or the instant from which on the mass rests on a stop.
  struct Contact {
    double time;
    double before;            ///< velocity before the impact; 0: at rest
    Side side;                ///< none: dry friction holds the mass
    bool is_of_wall = false;  ///< of a loose mass, beside stops
  };
  /// The stops of the impacts of one period in order, from the rotation on that sorts first. Impacts that end in rest
  /// are one L* or U*: how many of them were taken says nothing about the motion. Motion without impacts stays on a
  /// stop, (L) or (U), if the mass rests there or `within` is the soft stop that it is beyond; else it meets none. The
  /// walls of a loose mass beside stops are l and u.
  [[nodiscard]] static std::string word_of(const std::vector<Contact>& contacts, Side within = Side::none);
  /// "n/p": the larger number of impacts on one stop, "inf" if they end in rest, in p forcing periods.
  [[nodiscard]] static std::string regime_of(const std::vector<Contact>& contacts, double periods);

  class Observer;  ///< in impact_word_observer.hpp
};

}  // namespace clatter::observables
