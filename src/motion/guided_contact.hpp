#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>

#include "motion/contact.hpp"

namespace clatter::motion {

/// Finds the first contact of an arc in numbers with more digits than double has, where double can prove it: on the
/// rounded arc it searches for the first contact with stops that are moved inwards, by far more than rounding. The arc
/// meets none before, and if it arrives so fast that it doesn't turn back on the way left, the stop itself is met
/// there. Then only the instant is computed in more digits, by Newton's method, which takes one or two evaluations of
/// the arc in place of some twenty. Grazes, flights without speed at their beginning, and contacts at the horizon are
/// left to `next_contact`.
template <class Number, Effects E>
class GuidedContact {
 public:
  GuidedContact(const ArcConstants<Number, E>& constants, const BasicStops<Number>& stops)
      : constants_(ArcConstants<double, E>::of(in_double(constants.h), in_double(constants.f), in_double(constants.nu),
                                               in_double(constants.load), in_double(constants.k),
                                               with_numbers<double>(constants.shape))),
        stops_(stops) {
    guided_stops_.lower = in_double(stops.lower), guided_stops_.upper = in_double(stops.upper);
  }

  /// The first contact, or the horizon; nothing if double doesn't prove it.
  [[nodiscard]] std::optional<Crossing<Number>> first(const Arc<Number, E>& arc, const Number& horizon) const {
    const Arc<double, E> guide(constants_, rounded(arc.start()), in_double(arc.anchor()));
    if (!(constants_.k > 0) || constants_.f == 0) return std::nullopt;
    if (const double inwards = 1e-11 * size(guide); is_clear(guide, inwards))
      return within(arc, guide, inwards, in_double(horizon), horizon);
    // a low flight from a stop: over a short time its displacement has a rounding of its own size
    const double height = height_of(guide), shortly = 0.25 / constants_.rate;
    if (!(height > 0) || !(in_double(horizon) <= shortly || returns_within(guide, shortly))) return std::nullopt;
    return within(arc, guide, 1e-9 * height, std::min(in_double(horizon), shortly), horizon);
  }

 private:
  [[nodiscard]] static double in_double(const Number& y) { return static_cast<double>(y); }
  [[nodiscard]] static Motion<double> rounded(const Motion<Number>& m) {
    return {in_double(m.offset), in_double(m.x),    in_double(m.v),
            in_double(m.a),      in_double(m.sine), in_double(m.cosine)};
  }
  [[nodiscard]] static double closing(std::size_t i, double y) { return i == 1 ? y : -y; }
  [[nodiscard]] double size(const Arc<double, E>& guide) const {
    const double force = std::abs(constants_.f) / std::max(constants_.k, constants_.nu * constants_.nu);
    return std::abs(guide.start().x) + std::abs(guide.start().v) / constants_.rate + std::abs(constants_.equilibrium) +
           constants_.response.amplitude + 16 * force;  // at resonance, which has no amplitude, within a period
  }

  /// Whether a flight begins so far from the stops, or so fast, that it may be searched between stops that are moved
  /// inwards by a distance.
  [[nodiscard]] bool is_clear(const Arc<double, E>& guide, double inwards) const {
    constexpr double far = 1e4;
    if (!(inwards * far < guided_stops_.upper - guided_stops_.lower)) return false;
    const Motion<double>& start = guide.start();
    const GapRule<Arc<double, E>> rule(guide, guided_stops_);
    for (std::size_t i = 0; i < 2; ++i) {
      const double v = closing(i, start.v), pull = closing(i, start.a) + constants_.rate * std::abs(start.v);
      if (rule.of(i, start) > far * inwards) continue;
      if (!(v < 0 && v * v > 2 * far * inwards * std::max(pull, 0.0))) return false;
    }
    return true;
  }
  /// The height of a flight that begins on a stop, which presses back; 0 of any other.
  [[nodiscard]] double height_of(const Arc<double, E>& guide) const {
    const Motion<double>& start = guide.start();
    const double stop = start.v > 0 ? guided_stops_.lower : guided_stops_.upper;
    if (guide.anchor() != stop || start.offset != 0 || !(start.v * start.a < 0)) return 0.0;
    return start.v * start.v / (2 * std::abs(start.a));
  }
  [[nodiscard]] static bool returns_within(const Arc<double, E>& guide, double time) {
    return 4 * std::abs(guide.start().v) < time * std::abs(guide.start().a);
  }

  /// The first contact up to a time, which is that of the horizon unless it comes before.
  [[nodiscard]] std::optional<Crossing<Number>> within(const Arc<Number, E>& arc, const Arc<double, E>& guide,
                                                       double inwards, double time, const Number& horizon) const {
    BasicStops<double> moved = guided_stops_;
    moved.lower += inwards, moved.upper -= inwards;
    const Crossing<double> met = next_contact(guide, moved, time);
    if (!met.resolved) return std::nullopt;
    if (met.side == Side::none) {
      if (time < in_double(horizon)) return std::nullopt;
      return Crossing<Number>{2, Side::none, horizon, arc.at(horizon), 1};
    }
    const double speed = closing(met.margin, met.motion.v), left = inwards / speed;
    const double bend = std::abs(met.motion.a) + constants_.rate * std::abs(met.motion.v);
    const bool goes_on = speed > 0 && left * bend <= 1e-3 * speed && left * constants_.rate <= 1e-3;
    if (!goes_on || !(met.elapsed + 4 * left < time)) return std::nullopt;
    return polished(arc, met.margin, met.elapsed + left, 2 * left);
  }

  /// The contact near an instant, no more than `most` away, to all digits.
  [[nodiscard]] std::optional<Crossing<Number>> polished(const Arc<Number, E>& arc, std::size_t i, double near,
                                                         double most) const {
    using std::abs;
    constexpr int most_evaluations = 4;
    const GapRule<Arc<Number, E>> rule(arc, stops_);
    const Number sign(i == 1 ? 1 : -1);
    Number elapsed(near);
    for (int evaluations = 1; evaluations <= most_evaluations; ++evaluations) {
      Motion<Number> m = arc.at(elapsed);
      const auto higher = arc.constants().derivatives(m);
      const Number gap = rule.of(i, m) * sign, inverse = 1 / m.v;
      Number more = gap * inverse;
      const double rough = in_double(more), bend = std::abs(rough * in_double(m.a * inverse));
      if (!(bend <= 1e-3) || !(std::abs(in_double(elapsed) + rough - near) <= most)) return std::nullopt;
      const Number half_a = m.a / 2, sixth = higher.d3 / 6, small = higher.d4 / 24;
      for (int step = 0; step < 6; ++step) {  // each gains the digits of `bend`
        const Number nearer = (gap - more * more * (half_a + more * (sixth + more * small))) * inverse;
        if (nearer == more) break;
        more = nearer;
      }
      elapsed += more;
      if (!(std::abs(rough) * constants_.rate <= 1e-13 && bend <= 1e-9)) continue;
      m.v += more * (m.a + more * (3 * sixth + more * (4 * small)));
      m.a += more * (higher.d3 + more * (12 * small));
      m.offset += gap;
      Crossing<Number> contact = rule.at(i, elapsed, m);
      contact.evaluations = evaluations;
      return contact;
    }
    return std::nullopt;
  }

  ArcConstants<double, E> constants_;
  BasicStops<double> guided_stops_{};
  BasicStops<Number> stops_;
};

}  // namespace clatter::motion
