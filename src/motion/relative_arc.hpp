#pragma once

#include <algorithm>

#include "motion/contact.hpp"

namespace clatter::motion {

/// The beginning of a flight of a loose mass in its housing.
template <class Number>
struct RelativeStart {
  Number origin{};  ///< the place z that the offset counts from: the wall that it has left, or 0
  Number offset{};  ///< z less that
  Number w{};       ///< z'
  Number v{};       ///< y'
};

/// Motion of a loose mass in its housing, z = y - x, while the main mass moves along an arc and y'' is constant (eq.
/// 68). A polynomial of degree 2 and an arc differ by sign alone in all derivatives beyond the second, so the bounds of
/// arcs hold, and contacts with walls are found and proved like those with stops. Motions are those of z; their free
/// parts are those of the main mass.
template <class N, Effects E>
class RelativeArc {
 public:
  using Number = N;
  static constexpr Effects effects = E;

  RelativeArc(const Arc<Number, E>& main, const RelativeStart<Number>& from, const Number& load)
      : main_(main), from_(from), load_(load), start_(seen(main.start(), from.offset, from.w)) {}

  [[nodiscard]] const ArcConstants<Number, E>& constants() const { return main_.constants(); }
  [[nodiscard]] const Motion<Number>& start() const { return start_; }
  [[nodiscard]] const Number& anchor() const { return from_.origin; }
  [[nodiscard]] const Arc<Number, E>& main() const { return main_; }  ///< of the main mass
  [[nodiscard]] const Number& load() const { return load_; }          ///< y''

  /// Motion a time s >= 0 after the start; for short times by the series of the main mass, which keeps the relative
  /// accuracy of the offset and of z'.
  [[nodiscard]] Motion<Number> at(const Number& s) const {
    if (s * constants().rate <= Number(0.25)) return near(start_, s);
    const Motion<Number> m = main_.at(s);
    return seen(m, from_.offset + ((from_.v + load_ * s / 2) * s - (m.offset - main_.start().offset)),
                velocity(s) - m.v);
  }
  /// Motion a short time d after `m`, an instant of this arc.
  [[nodiscard]] Motion<Number> near(const Motion<Number>& m, const Number& d) const {
    if (!(d > 0)) return m;
    const Motion<Number> main = main_at(m);
    const FreeMotion<Number> bend = main_.bend(main, d);
    return seen(main_.near(main, d), m.offset + ((m.v + m.a * d / 2) * d - bend.x), m.v + m.a * d - bend.v);
  }

  /// The same motion from a time s after the start on.
  [[nodiscard]] RelativeArc from(const Number& s) const {
    const Motion<Number> m = at(s);
    return {
        Arc<Number, E>(constants(), main_.at(s), main_.anchor()), {from_.origin, m.offset, m.v, velocity(s)}, load_};
  }

  /// y' a time s after the start.
  [[nodiscard]] Number velocity(const Number& s) const { return from_.v + load_ * s; }
  /// y at the start.
  [[nodiscard]] Number place() const { return start_.x + main_.start().x; }

  /// Motion of the main mass at the same instant.
  [[nodiscard]] Motion<Number> main_at(const Motion<Number>& m) const {
    const auto& c = constants();
    Motion<Number> main = m;
    const FreeMotion<Number> response = c.response_at({m.sine, m.cosine});
    main.x = c.equilibrium + (m.free_x + response.x), main.v = m.free_v + response.v;
    main.offset = main.x - main_.anchor(), main.a = load_ - m.a;
    return main;
  }

 private:
  [[nodiscard]] Motion<Number> seen(Motion<Number> m, const Number& offset, const Number& w) const {
    m.offset = offset, m.x = from_.origin + offset, m.v = w, m.a = load_ - m.a;
    return m;
  }

  Arc<Number, E> main_;
  RelativeStart<Number> from_;
  Number load_;
  Motion<Number> start_;
};

/// Whether a loose mass stays between two places of its housing: its parabola, less all that the main mass can reach.
template <class Number, Effects E>
[[nodiscard]] bool stays_between(const RelativeArc<Number, E>& arc, const Motion<Number>& here, const Number& time,
                                 const Number& lower, const Number& upper) {
  using std::max, std::min;
  const Motion<Number> main = arc.main_at(here);
  const Number y = here.x + main.x, v = here.v + main.v, end = y + (v + arc.load() * time / 2) * time;
  Number low = min(y, end), high = max(y, end);
  if (v * (v + arc.load() * time) < 0) {
    const Number turn = y - v * v / (2 * arc.load());
    low = min(low, turn), high = max(high, turn);
  }
  const Number far = reach(arc.constants(), here, time), middle = arc.constants().equilibrium;
  return lower < low - (middle + far) && high - (middle - far) < upper;
}

/// Nothing of the energy of a motion in a housing is conserved.
template <class Number, Effects E>
[[nodiscard]] bool conserves_energy(const RelativeArc<Number, E>&) {
  return false;
}

}  // namespace clatter::motion
