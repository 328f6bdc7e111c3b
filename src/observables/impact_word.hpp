#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <tuple>
#include <vector>

#include "model/displacement_bound.hpp"
#include "motion/state.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// The impacts of one period as a word over the stops, L and U, and the symmetry of the motion; for motion that has a
/// period.
class ImpactWord {
 public:
  struct Settings {
    bool word = false;
  };
  struct Values {
    std::string impact_word{}, regime{};  ///< empty: no period, and no impact or no force
    double symmetric = no_value;          ///< 1 or 0; NaN: no period, or the scene isn't symmetric
  };
  static constexpr std::size_t longest = 64;  ///< characters of a word
  static constexpr std::tuple fields{
      Field{Key{"observe", "word", Kind::flag, "false", "true",
                "impacts of one period in order as text (LLU), their number over periods, symmetry of the motion"},
            &Settings::word}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.word; }
  [[nodiscard]] static std::string description(const Settings&) { return "impact words"; }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings&);
  /// Motion without a period has no word; its other results need no flights from the scalar loop.
  [[nodiscard]] static bool in_lanes(const Settings&, const ObservedSpan& span) { return !span.periodic; }

  ImpactWord(const Settings&, const ObservedSpan& span) : periodic_(span.periodic), half_(span.total / 2) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (!periodic_ || !(begin <= half_ && half_ <= begin + length)) return;
    const motion::Motion<double> m = arc.at(half_ - begin);
    halfway_ = {m.x, m.v};
  }
  void rest(const motion::Rest& rest) { see(rest.time, rest.side, 0.0); }
  void impact(const motion::Impact& impact) { see(impact.time, impact.side, impact.before); }
  /// The touch of a soft stop has the letter of an impact.
  void touch(const motion::Touch& touch) {
    if (touch.from_outside) see(touch.time, touch.side, touch.velocity);
  }
  /// The response has no impacts, and turns into its mirror whenever the force does.
  bool response(const ObservedSpan&, double) {
    is_response_ = true;
    return true;
  }

  /// x and v end the period, and so begin it.
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) const;

  /// An impact, or the instant from which on the mass rests on a stop.
  struct Contact {
    double time;
    double before;  ///< velocity before the impact; 0: at rest
    Side side;
  };
  /// The stops of the impacts of one period in order, from the rotation on that sorts first. Impacts that end in rest
  /// are one L* or U*: how many of them were taken says nothing about the motion.
  [[nodiscard]] static std::string word_of(const std::vector<Contact>& contacts);
  /// "n/p": the larger number of impacts on one stop, "inf" if they end in rest, in p forcing periods.
  [[nodiscard]] static std::string regime_of(const std::vector<Contact>& contacts, double periods);

 private:
  static constexpr double same = 1e-6;  ///< relative difference of what counts as the mirror image

  void see(double time, Side side, double before) {
    if (periodic_) contacts_.push_back({time, before, side});
  }
  [[nodiscard]] bool is_mirrored(const ObservedSpan& span, double x, double v) const;

  bool periodic_;
  double half_;                          ///< of the period, in tau
  std::vector<Contact> contacts_{};      ///< in order
  std::optional<PhasePoint> halfway_{};  ///< half a period after its beginning, in flight
  bool is_response_ = false;             ///< the steady response without impacts
};

}  // namespace clatter::observables
