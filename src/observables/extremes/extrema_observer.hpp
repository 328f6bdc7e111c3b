#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/bernstein.hpp"
#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "observables/extremes/absolute_arc.hpp"
#include "observables/extremes/extrema.hpp"
#include "observables/extremes/loose_arc.hpp"
#include "observables/extremes/range_search.hpp"
#include "scene/response.hpp"
#include "scene/stops.hpp"

namespace clatter::observables {

class Extrema::Observer {
 public:
  Observer() = default;
  Observer(const Settings&, const ObservedSpan& span) : absolute_(span.frame ? &span : nullptr) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (length > 0) see_main(motion::main_of(arc), begin, length);
    if constexpr (motion::Housed<A>) see_loose(arc.main(), arc.loose, begin, length);
  }
  /// Adds ranges that were found elsewhere.
  void include(const Range& x, const Range& v) {
    x_.include(x.low), x_.include(x.high), v_.include(v.low), v_.include(v.high);
  }
  /// The ranges of the steady response to the force.
  bool response(const ObservedSpan& span, double) {
    const Oscillator& o = span.scene.oscillator;
    const double amplitude =
                     span.frame ? absolute_amplitude(*span.frame, steady_response(o)) : steady_response(o).amplitude,
                 v = o.frequency * amplitude, middle = equilibrium_of(o);
    include({middle - amplitude, middle + amplitude}, {-v, v});
    return true;
  }
  /// In the absolute frame the ends of the arcs before and after an impact have it all.
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind == Kind::strike) z_.include(event.place);
    if (absolute_ != nullptr) {
      if (event.lasts() && !event.has_arc) include_absolute(event);
    } else if (event.kind == Kind::strike) {
      v_.include(event.main.before), v_.include(event.main.after);
    } else if (event.kind == Kind::impact) {
      x_.include(event.place);
      v_.include(event.before + event.stop.velocity), v_.include(event.after + event.stop.velocity);
    } else if (event.lasts() && !event.has_arc) {
      x_.include(event.place), v_.include(0.0);
    }
  }

  /// Cut at the stops, which the end of an arc meets only to rounding, or by time stepping to the length of a step.
  [[nodiscard]] Range displacement(const Stops& stops) const {
    const double moved = absolute_ != nullptr ? absolute_->frame->amplitude() : 0.0;
    return {std::max(x_.low, stops.lower - moved), std::min(x_.high, stops.upper + moved)};
  }
  [[nodiscard]] const Range& velocity() const { return v_; }
  [[nodiscard]] Values finish(const ObservedSpan& span, double x, double v) {
    if (absolute_ != nullptr) include_end(x, v);
    const Range range = displacement(outermost(rigid_ones(span.scene.stops)));
    if (!has_loose_mass(span.scene.loose)) return {range.low, range.high, v_.low, v_.high};
    const LooseMass& loose = span.scene.loose;
    return {range.low,
            range.high,
            v_.low,
            v_.high,
            y_.low,
            y_.high,
            is_soft(loose, Side::lower) ? z_.low : std::max(z_.low, loose.lower),
            is_soft(loose, Side::upper) ? z_.high : std::min(z_.high, loose.upper)};
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs

 private:
  template <Effects E>
  void see_main(const motion::Arc<double, E>& arc, double begin, double length) {
    if (absolute_ == nullptr) return look_at(arc, length);
    look_at(AbsoluteArc(arc, *absolute_->frame, absolute_->scene.stops, begin), length);
  }
  template <motion::Polynomial A>
  void see_main(const A& arc, double begin, double length) {
    ++evaluations_;
    const double part = arc.length() > 0 ? length / arc.length() : 0.0;
    auto offset = arc.offset();
    auto velocity = arc.velocity();
    offset = split_off(offset, part), velocity = split_off(velocity, part);
    if (absolute_ != nullptr) return include_absolute(x_, v_, arc, begin, length, offset, velocity);
    include_polynomial(x_, offset, arc.anchor());
    include_polynomial(v_, velocity);
  }

  template <Effects E>
  void see_loose(const motion::Arc<double, E>&, const motion::RelativeArc<double, E>& arc, double begin,
                 double length) {
    if (!(length > 0)) return;
    look_at_place(z_, arc, length);
    const LooseArc loose(arc);
    if (absolute_ == nullptr) return look_at_place(y_, loose, length);
    look_at_place(y_, AbsoluteArc(loose, *absolute_->frame, Stops{}, begin), length);
  }
  template <motion::Polynomial A, motion::Polynomial L>
  void see_loose(const A& main, const L& arc, double begin, double length) {
    if (!(length > 0)) return;
    auto place = arc.offset();
    const auto way = arc.way();
    include_polynomial(z_, split_off(place, length / arc.length()), arc.anchor());
    include_loose(main, begin, length, way, arc.anchor());
  }
  /// While a wall presses it, a loose mass moves with the main mass.
  template <motion::Polynomial A>
  void see_loose(const A& main, const motion::Pressed& loose, double begin, double length) {
    z_.include(loose.place);
    if (length > 0) include_loose(main, begin, length, main.offset(), loose.place);
  }
  template <Effects E>
  void see_loose(const motion::Arc<double, E>& main, const motion::Pressed& loose, double begin, double length) {
    z_.include(loose.place);
    if (!(length > 0)) return;
    if (absolute_ == nullptr) return look_at_place(y_, main, length, loose.place);
    look_at_place(y_, AbsoluteArc(main, *absolute_->frame, Stops{}, begin), length, loose.place);
  }

  template <class A>
  void look_at(const A& arc, double length) {
    const auto see = [this](const motion::Motion<double>& m) { x_.include(m.x), v_.include(m.v); };
    RangeSearch search(arc, length, see);
    search.exceed(DisplacementOnArc{}, x_);
    search.exceed(VelocityOnArc{}, v_);
    evaluations_ += search.evaluations();
  }
  /// Of displacements alone, of something that is `apart` from that which moves along the arc.
  template <class A>
  void look_at_place(Range& range, const A& arc, double length, double apart = 0.0) {
    Range on_arc{range.low - apart, range.high - apart};
    const auto see = [&](const motion::Motion<double>& m) { on_arc.include(m.x), range.include(m.x + apart); };
    RangeSearch search(arc, length, see);
    search.exceed(DisplacementOnArc{}, on_arc);
    evaluations_ += search.evaluations();
  }

  /// The displacement of a loose mass over a part of a step: a polynomial, `apart` from the anchor of the main mass.
  template <motion::Polynomial A, std::size_t size>
  void include_loose(const A& main, double begin, double length, std::array<double, size> way, double apart) {
    ++evaluations_;
    way = split_off(way, length / main.length());
    if (absolute_ == nullptr) return include_polynomial(y_, way, main.anchor() + apart);
    Range speeds;  // aren't asked for
    include_absolute(y_, speeds, main, begin, length, way, way, apart);
  }

  /// A relative state in the absolute frame.
  void include_absolute(double x, double v, const SineCosine<double>& theta) {
    x_.include(x + absolute_->frame->displacement(theta)), v_.include(v + absolute_->frame->velocity(theta));
  }
  /// At rest the mass moves with the stop: it turns back where that does. The arc before a rest or a chatter ends with
  /// the velocity before its impact, not with that of its beginning; the arc after it begins with that of its end.
  void include_absolute(const motion::Event& rest) {
    const FrameMotion& frame = *absolute_->frame;
    include_absolute(rest.place, rest.before, frame.at(rest.time));
    for (int quarter = 0; quarter < 4; ++quarter)
      if (frame.passes(quarter, rest.time, rest.length))
        include_absolute(rest.place, 0.0, sine_cosine_of_turns(quarter / 4.0));
  }
  /// The end of the observed time, by its part of a forcing period, as a long time costs its phase digits. A mass that
  /// nothing moves in the moving frame moves with it for ever, not only for the period that is observed.
  void include_end(double x, double v) {
    const FrameMotion& frame = *absolute_->frame;
    const double part = absolute_->turns - std::floor(absolute_->turns);
    include_absolute(x, v,
                     frame.at(frame.is_forced() ? part * 2 * pi<double>() / frame.frequency() : absolute_->total));
    if (!absolute_->stands_still) return;
    for (int quarter = 0; quarter < 4; ++quarter) include_absolute(x, v, sine_cosine_of_turns(quarter / 4.0));
  }
  /// Polynomials, by pieces of a sixty-fourth of a radian, over which the frame is one, too, to rounding.
  template <motion::Polynomial A, std::size_t size>
  void include_absolute(Range& x, Range& v, const A& arc, double begin, double length, std::array<double, size> offset,
                        std::array<double, size> velocity, double apart = 0.0) {
    const FrameMotion& frame = *absolute_->frame;
    const auto theta = [&](double s) {
      if (!frame.is_forced()) return frame.at(begin + s);
      const auto [sine, cosine] = arc.phase_after(s);
      return frame.by_force(sine, cosine);
    };
    const double pieces = std::max(1.0, std::ceil(64 * frame.frequency() * length)), step = length / pieces;
    SineCosine<double> left = theta(0.0);
    for (double piece = 0; piece < pieces; ++piece) {
      const SineCosine<double> right = theta((piece + 1) * step);
      const double part = 1 / (pieces - piece);
      include_polynomial(x, sum(split_off(offset, part), frame_over<0>(step, left, right)), arc.anchor() + apart);
      include_polynomial(v, sum(split_off(velocity, part), frame_over<1>(step, left, right)));
      left = right;
    }
  }
  /// Displacement (order 0) or velocity (order 1) of the frame over a step.
  template <int order>
  [[nodiscard]] Bernstein<double> frame_over(double step, const SineCosine<double>& left,
                                             const SineCosine<double>& right) const {
    const auto y = [&](int derivative, const SineCosine<double>& theta) {
      const FrameMotion& frame = *absolute_->frame;
      const std::array values{frame.displacement(theta), frame.velocity(theta), frame.acceleration(theta),
                              frame.jerk(theta)};
      return values[static_cast<std::size_t>(order + derivative)];
    };
    return hermite(
        HermiteData<double>::over(step, {y(0, left), y(1, left), y(2, left), y(0, right), y(1, right), y(2, right)}));
  }
  template <std::size_t size>
  [[nodiscard]] static std::array<double, size> sum(std::array<double, size> a, const Bernstein<double>& b) {
    const auto raised = raised_to<size - 1>(b);
    for (std::size_t i = 0; i < size; ++i) a[i] += raised[i];
    return a;
  }
  [[nodiscard]] static double absolute_amplitude(const FrameMotion& frame, const Response<double>& relative) {
    const double at_zero = relative.displacement(0.0, 1.0) + frame.displacement(frame.by_force(0.0, 1.0));
    const double at_quarter = relative.displacement(1.0, 0.0) + frame.displacement(frame.by_force(1.0, 0.0));
    return norm(at_zero, at_quarter);
  }

  const ObservedSpan* absolute_ = nullptr;  ///< if the absolute motion is observed
  Range x_, v_;
  Range y_, z_;  ///< of a loose mass
  double evaluations_ = 0.0;
};

}  // namespace clatter::observables
