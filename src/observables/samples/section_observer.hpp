#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

#include "math/number.hpp"
#include "observables/samples/bracketed_root.hpp"
#include "observables/samples/housing_samples.hpp"
#include "observables/samples/samples.hpp"
#include "observables/samples/section.hpp"
#include "scene/displacement_bound.hpp"

namespace clatter::observables {

class Section::Observer {
 public:
  Observer(const Settings& settings, const ObservedSpan& span)
      : middle_(equilibrium_of(span.scene.oscillator)),
        periodic_(span.periodic),
        is_absolute_(span.frame.has_value()),
        total_(span.total),
        most_(static_cast<std::size_t>(settings.section)) {
    if (!is_driven(span.scene.oscillator)) return;
    const double turns = turns_to(settings.section_phase, span.scene);
    if (span.periodic || span.transient)
      most_ = std::min(most_, static_cast<std::size_t>(std::max(0.0, std::ceil(span.turns - turns))));
    phase_ = span.scene.start.phase + 2 * pi<double>() * turns;
    samples_.emplace(most_, period_of(span.scene.oscillator), AtImpact::after, span.scene.stops, turns);
    if (has_loose_mass(span.scene.loose))
      loose_.emplace(most_, period_of(span.scene.oscillator), AtImpact::after, span.scene.loose, turns);
  }

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if constexpr (motion::Housed<A>)
      if (loose_) loose_->arc(arc, begin, length);
    if (samples_) return samples_->arc(motion::main_of(arc), begin, length);
    find_passages(arc, begin, length);
    bounced_ = false;
  }
  void event(const motion::Event& event) {
    if (loose_) loose_->event(event);
    if (samples_) return samples_->event(event.of_main());
    bounced_ = bounced_ || event.of_main().kind == motion::Event::Kind::impact;
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
    if (loose_) {
      loose_->finish(span.total, span.periodic);
      values_.section_z = std::move(loose_->place()), values_.section_w = std::move(loose_->velocity());
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
      const SineCosine<double> theta = times_.empty() ? at_phase : frame.at(times_[i]);
      values_.section_x[i] += frame.displacement(theta), values_.section_v[i] += frame.velocity(theta);
    }
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
        const double above = bracketed_root(from_middle, s, next, before, after);
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
    return first * last < 0 ? bracketed_root(velocity, low, high, first, last) : high;
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
  double phase_ = 0.0;                     ///< of the force
  std::optional<Samples> samples_{};       ///< under a force
  std::optional<HousingSamples> loose_{};  ///< under a force, of a loose mass
  Values values_{};
  std::vector<double> times_{};  ///< of passages without a force, tau
  bool bounced_ = false;         ///< the arc begins with an impact
  bool begins_here_ = false;     ///< the observed time begins with a passage
};

}  // namespace clatter::observables
