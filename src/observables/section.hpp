#pragma once

#include <algorithm>
#include <boost/math/tools/toms748_solve.hpp>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <tuple>
#include <utility>
#include <vector>

#include "math/number.hpp"
#include "model/displacement_bound.hpp"
#include "observables/observable.hpp"
#include "observables/samples.hpp"

namespace clatter::observables {

/// The states of a motion at one forcing phase in successive periods, its stroboscopic (Poincaré) section; without
/// forcing, its states as it passes the load's equilibrium upward. Of periodic motion these are the states of one
/// period, of a transient those before its end.
class Section {
 public:
  struct Settings {
    std::int64_t section = 0;    ///< states; 0: none
    double section_phase = 0.0;  ///< of the force, rad
  };
  struct Values {
    std::vector<double> section_x{}, section_v{};  ///< shape [section]
  };
  static constexpr std::string_view observed = "[scene]\nf = 1\n\n[observe]\nsection = 500\n";
  static constexpr std::tuple fields{
      Field{Key{"observe",
                "section",
                Kind::integer,
                "0",
                "500",
                "states x, x' at one forcing phase in so many successive periods; 0: none",
                {.low = 0, .high = 1e7}},
            &Settings::section},
      Field{with(observed, of(Quantity::angle, Key{"observe", "section_phase", Kind::number, "0", "1.5708",
                                                   "forcing phase of these states, in rad"})),
            &Settings::section_phase}};

  [[nodiscard]] static bool wanted(const Settings& settings) { return settings.section > 0; }
  [[nodiscard]] static std::string description(const Settings& settings) {
    return "section of " + std::to_string(settings.section) + " states";
  }
  [[nodiscard]] static std::vector<Column<Values>> columns(const Settings& settings) {
    const auto of = [&](const char* name, const char* long_name, std::vector<double> Values::*member,
                        Quantity quantity) {
      return series<Values>(name, long_name, quantity, {"section", static_cast<std::size_t>(settings.section)},
                            [member](const Values& v) -> const std::vector<double>& { return v.*member; });
    };
    return {
        in_observed_frame(of("section_x", "displacement in successive periods", &Values::section_x, Quantity::length)),
        in_observed_frame(of("section_v", "velocity in successive periods", &Values::section_v, Quantity::velocity))};
  }
  [[nodiscard]] static double values_held(const Settings& settings) {
    return 2 * static_cast<double>(settings.section);
  }
  /// Lanes report their states at the forcing phase of the start, and follow no motion beyond the observed time.
  [[nodiscard]] static bool in_lanes(const Settings& settings, const ObservedSpan& span) {
    const bool reaches = span.periodic || span.transient || static_cast<double>(settings.section) <= span.turns;
    return span.scene.oscillator.forcing != 0 && span.has_whole_turns() && reaches &&
           turns_to(settings.section_phase, span.scene) == 0;
  }

  Section(const Settings& settings, const ObservedSpan& span)
      : middle_(equilibrium_of(span.scene.oscillator)),
        periodic_(span.periodic),
        is_absolute_(span.frame.has_value()),
        total_(span.total),
        most_(static_cast<std::size_t>(settings.section)) {
    if (span.scene.oscillator.forcing == 0) return;
    const double turns = turns_to(settings.section_phase, span.scene);
    if (span.periodic || span.transient)
      most_ = std::min(most_, static_cast<std::size_t>(std::max(0.0, std::ceil(span.turns - turns))));
    phase_ = span.scene.start.phase + 2 * pi<double>() * turns;
    samples_.emplace(most_, period_of(span.scene.oscillator), AtImpact::after, span.scene.stops, turns);
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (samples_) return samples_->arc(arc, begin, length);
    find_passages(arc, begin, length);
    bounced_ = false;
  }
  void rest(const motion::Rest& rest) {
    if (samples_) samples_->rest(rest);
  }
  void impact(const motion::Impact& impact) {
    if (samples_) return samples_->impact(impact);
    bounced_ = true;
  }
  /// Takes the state of the steady response, whose period is that of the force.
  bool response(const ObservedSpan& span, double) {
    const PhasePoint response = response_at(span.scene.oscillator, std::sin(phase_), std::cos(phase_));
    take({middle_ + response.x}, {response.v});
    return true;
  }
  /// Takes states that were found elsewhere, in place of those of the flights.
  void take(std::vector<double> x, std::vector<double> v) {
    samples_.reset();
    x.resize(std::min(x.size(), most_)), v.resize(x.size());
    values_ = {std::move(x), std::move(v)};
  }

  /// Whether all states have been seen; under a force they may lie beyond the observed time of motion without a period.
  [[nodiscard]] bool is_complete() const { return !samples_ || samples_->is_complete(); }

  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    if (samples_) {
      samples_->finish(x, v, span.total, span.periodic);
      values_ = {std::move(samples_->displacement()), std::move(samples_->velocity())};
    }
    if (span.frame) add(*span.frame);
    return std::move(values_);
  }

 private:
  /// Of an arc, times the natural frequency: zeros of a decaying rotation are at least pi apart.
  static constexpr double longest_piece = 3.0;

  /// Adds what a frame moves: at the phase of a section the same in each period, else at the time of each passage.
  void add(const FrameMotion& frame) {
    const SineCosine<double> at_phase = frame.by_force(std::sin(phase_), std::cos(phase_));
    for (std::size_t i = 0; i < values_.section_x.size(); ++i) {
      const SineCosine<double> theta = frame.is_forced() ? at_phase : frame.at(times_[i]);
      values_.section_x[i] += frame.displacement(theta), values_.section_v[i] += frame.velocity(theta);
    }
  }

  /// From the forcing phase of the start to another one, in turns, 0 ... 1.
  [[nodiscard]] static double turns_to(double phase, const Scene& scene) {
    const double turns = (phase - scene.start.phase) / (2 * pi<double>()), part = turns - std::floor(turns);
    return part < 1 - 4 * epsilon<double>() ? part : 0.0;
  }

  /// Adds the states in which an arc without force passes the load's equilibrium upward: in each piece at most one.
  template <class A>
  void find_passages(const A& arc, double begin, double length) {
    const auto from_middle = [&](double s) { return arc.at(s).x - middle_; };
    const motion::Motion<double> start = arc.start();
    if (start.x == middle_ && start.v > 0 && !bounced_) add(begin, start);
    const bool rotates = arc.constants().rotates();
    const double turn = rotates ? length : turning_point(arc, 0.0, length);
    const bool around_another =
        arc.constants().stop.side != Side::none;  // in contact it goes round another equilibrium
    double s = 0.0, before = start.x - middle_;
    while (s < length) {
      const double end = s < turn ? turn : length, piece = longest_piece / arc.constants().natural;
      double next = rotates ? std::min(end, s + piece) : end;
      if (rotates && around_another) next = turning_point(arc, s, next);
      const double after = from_middle(next);
      if (before < 0 && after > 0) {
        const double above = root_of(from_middle, s, next, before, after);
        add(begin + above, arc.at(above));
      } else if (before < 0 && after == 0 && next < length) {
        add(begin + next, arc.at(next));
      }
      s = next, before = after;
    }
  }
  /// The one instant between two others at which an arc turns back, else the later one.
  template <class A>
  static double turning_point(const A& arc, double low, double high) {
    const auto velocity = [&](double s) { return arc.at(s).v; };
    const double first = velocity(low), last = velocity(high);
    return first * last < 0 ? root_of(velocity, low, high, first, last) : high;
  }
  /// The end of a bracket of a root, on the side of `high` (Alefeld et al. 1995).
  template <class Function>
  static double root_of(const Function& function, double low, double high, double at_low, double at_high) {
    std::uintmax_t iterations = 100;
    return boost::math::tools::toms748_solve(function, low, high, at_low, at_high,
                                             boost::math::tools::eps_tolerance<double>(), iterations)
        .second;
  }
  /// The end of a period is its beginning: a passage there counts once.
  void add(double time, const motion::Motion<double>& m) {
    if (values_.section_x.size() == most_ || (periodic_ && time >= (1 - same_instant) * total_ && begins_here_)) return;
    begins_here_ = begins_here_ || time <= same_instant * total_;
    values_.section_x.push_back(m.x), values_.section_v.push_back(m.v);
    if (is_absolute_) times_.push_back(time);
  }
  static constexpr double same_instant = 1e-9;  ///< of the period

  double middle_;  ///< the equilibrium
  bool periodic_, is_absolute_;
  double total_;
  std::size_t most_;
  double phase_ = 0.0;                ///< of the force
  std::optional<Samples> samples_{};  ///< under a force
  Values values_{};
  std::vector<double> times_{};  ///< of passages without a force, tau
  bool bounced_ = false;         ///< the arc begins with an impact
  bool begins_here_ = false;     ///< the observed time begins with a passage
};

}  // namespace clatter::observables
