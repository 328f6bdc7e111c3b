#include "hard/carry.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "hard/first_fall.hpp"

namespace clatter::hard {
namespace {

using Real = CarryEvent::Real;
using Kind = CarryEvent::Kind;

/// A series by powers of a part u of its step.
[[nodiscard]] Series shortened(Series p, Real u) {
  Real power = 1;
  for (Real& term : p) term *= power, power *= u;
  return p;
}

/// The product of two series, integrated over 0 ... u.
[[nodiscard]] Real integral_of_product(const Series& p, const Series& q, Real u) {
  const Series a = shortened(p, u), b = shortened(q, u);
  Real sum = 0;
  for (std::size_t degree = 2 * series_terms - 1; degree-- > 0;) {
    Real term = 0;
    for (std::size_t i = degree < series_terms ? 0 : degree - series_terms + 1; i < series_terms && i <= degree; ++i)
      term += a[i] * b[degree - i];
    sum += term / Real(degree + 1);
  }
  return sum * u;
}

/// Takes the values that a series has at all zeros of its slope within an interval, and at its end. Where it changes
/// by no more than rounding, the value in the middle stands for all.
void take_extremes(Range& range, const Series& p, const Series& slope, Real low, Real high) {
  const Real middle = low + (high - low) / 2, radius = (high - low) / 2;
  const Series near = detail::about(slope, middle);
  const Real others = detail::tail(near, 1, radius);
  range.take(value_of(p, high));
  if (std::abs(near[0]) > others) return;
  if (radius * (std::abs(near[0]) + others) <= 1e-18L * detail::tail(p, 0, 1)) return range.take(value_of(p, middle));
  take_extremes(range, p, slope, low, middle);
  take_extremes(range, p, slope, middle, high);
}

class Carry {
 public:
  Carry(const CarryScene& scene, Real duration, Real rounding, bool observes)
      : s_(scene), end_(duration), rounding_(rounding), observes_(observes), x_(scene.x), v_(scene.v), w_(scene.w) {
    const bool on_upper = scene.z == scene.upper, on_lower = scene.z == scene.lower;
    side_ = on_upper ? 1 : on_lower ? -1 : 0;
    anchor_ = scene.z;
    take_state();
    if (side_ * w_ > 0) strike();
    run_.struck = 0, run_.stored = -energy();
  }

  CarryRun run(std::size_t most_events) {
    std::size_t steps = 0, idle = 0;
    while (time_ < end_ && run_.events.size() < most_events && ++steps < most_steps && idle < 50) {
      const Real before = time_;
      if (!stand()) fly();
      idle = time_ > before ? 0 : idle + 1;
    }
    run_.completed = !(time_ < end_);
    run_.x = x_, run_.v = v_, run_.z = z(), run_.w = w_;
    run_.stored += energy();
    return std::move(run_);
  }

 private:
  static constexpr Real still = 1e-16L;  ///< rebounds are as slow, in units of the fastest
  static constexpr std::size_t most_steps = 20'000'000;

  [[nodiscard]] Real z() const { return anchor_ + q_; }
  [[nodiscard]] Real eps() const { return s_.loose_mass; }
  [[nodiscard]] Real wall(int side) const { return side > 0 ? s_.upper : s_.lower; }
  [[nodiscard]] Real energy() const {
    const Real k = s_.stiffness, y_speed = v_ + w_;
    return (v_ * v_ + k * x_ * x_ + eps() * y_speed * y_speed) / 2;
  }

  /// A step's length. At 1 over the fastest rate the terms of a series fall faster than 2^n/n!, and those beyond the
  /// last are below 1e-20 of the first.
  [[nodiscard]] Real step() const {
    const bool forced = s_.forcing != 0 || s_.base_amplitude != 0;
    const Real rate = std::max({std::sqrt(std::abs(Real(s_.stiffness))), 2 * Real(s_.damping),
                                forced ? Real(s_.frequency) : Real(0), Real(0.01)});
    return std::min(end_ - time_, 1 / rate);
  }
  /// The force on the main mass, spring and damper excepted, by powers of the part of a step that has passed.
  [[nodiscard]] Series force(Real step) const {
    const Real angle = Real(s_.frequency) * time_ + Real(s_.phase), b = s_.base_amplitude;
    const Real of_sine = s_.forcing + b * Real(s_.stiffness), of_cosine = 2 * b * Real(s_.damping) * s_.frequency;
    const Real here = of_sine * std::sin(angle) + of_cosine * std::cos(angle);
    const Real slope = of_sine * std::cos(angle) - of_cosine * std::sin(angle);
    const std::array<Real, 4> derivatives{here, slope, -here, -slope};
    Series force{};
    Real factor = 1;  // (nu step)^n / n!
    for (std::size_t n = 0; n < series_terms; ++n) {
      force[n] = factor * derivatives[n % 4];
      factor *= s_.frequency * step / Real(n + 1);
    }
    force[0] += s_.load;
    return force;
  }
  /// The series of x if the moving mass is this and such a constant force is added.
  [[nodiscard]] Series main_series(const Series& force, Real step, Real mass, Real added) const {
    Series x{x_, v_ * step};
    for (std::size_t n = 0; n + 2 < series_terms; ++n) {
      const Real pushed = step * step * (force[n] + (n == 0 ? added : 0) - Real(s_.stiffness) * x[n]);
      const Real damped = 2 * Real(s_.damping) * step * Real(n + 1) * x[n + 1];
      x[n + 2] = (pushed - damped) / (mass * Real((n + 1) * (n + 2)));
    }
    return x;
  }
  /// The series of the way from the anchor, if the loose mass flies beside such a motion of the main one.
  [[nodiscard]] Series relative_series(const Series& x, Real step) const {
    Series q{q_, w_ * step};
    for (std::size_t n = 2; n < series_terms; ++n) q[n] = -x[n];
    q[2] = released_ ? 0 : q[2] + Real(s_.loose_load) * step * step / 2;
    return q;
  }

  // The wall takes the loose mass along.

  /// Whether a mass on its wall and as fast would go into it, by the first derivative that isn't 0.
  [[nodiscard]] bool is_pressed(Real step) const {
    const Series q = relative_series(main_series(force(step), step, 1, 0), step);
    const auto* const first = std::find_if(q.begin(), q.end(), [](Real term) { return term != 0; });
    return first == q.end() || side_ * *first > 0;
  }
  /// Carries the mass as long as it is pressed; false: it flies.
  bool stand() {
    if (side_ == 0 || q_ != 0 || w_ != 0 || !is_pressed(step())) return false;
    CarryEvent event{Kind::carried, side_, time_, 0, time_, x_, v_, v_};
    for (bool ends = false; !ends && time_ < end_;) {
      const Real step = this->step();
      const Series pushes = force(step), x = main_series(pushes, step, 1 + eps(), eps() * Real(s_.loose_load));
      Series press{};
      for (std::size_t n = 0; n + 2 < series_terms; ++n)
        press[n] = -side_ * x[n + 2] * Real((n + 1) * (n + 2)) / (step * step);
      press[0] = released_ ? 0 : press[0] + side_ * Real(s_.loose_load);
      if (time_ == event.time) event.pressing = (1 + eps()) * press[0];
      const auto fall = first_fall(press);
      ends = fall.has_value();
      const Real late = ends ? late_release(press, step, *fall, event.time) : 0;
      pass(pushes, x, nullptr, step, fall.value_or(1) + late);
      released_ = ends;
    }
    event.until = time_;
    run_.events.push_back(event);
    return true;
  }

  /// The part of a step by which rounding delays a release.
  [[nodiscard]] Real late_release(const Series& press, Real step, Real u, Real since) const {
    if (rounding_ == 0) return 0;
    const Real pulls = std::abs(Real(s_.forcing)) + std::abs(Real(s_.load)) + std::abs(Real(s_.loose_load)) +
                       std::abs(Real(s_.stiffness) * x_) + std::abs(2 * Real(s_.damping) * v_);
    const Real latest = std::min(1e-6L * (u + (time_ - since) / step), (end_ - time_) / step - u);
    return std::min(rounding_ * pulls / std::abs(value_of(derivative_of(press), u)), latest);
  }

  // It flies.

  /// One Taylor step of a flight, or less if a wall is met before.
  void fly() {
    const Real step = this->step();
    const Series pushes = force(step), x = main_series(pushes, step, 1, 0), q = relative_series(x, step);
    int met = 0;
    Real u = 1;
    for (const int side : {1, -1}) {
      if (!std::isfinite(wall(side))) continue;
      Series room{};
      for (std::size_t n = 0; n < series_terms; ++n) room[n] = -side * q[n];
      room[0] += side * (wall(side) - anchor_);
      if (const auto fall = first_fall(room); fall && (met == 0 || *fall < u)) met = side, u = *fall;
    }
    if (met != 0) u += late(q, step, u);
    pass(pushes, x, &q, step, u);
    released_ = false;
    if (met == 0) return;
    side_ = met, anchor_ = wall(met), q_ = 0;
    if (side_ * w_ < 0) w_ = 0;
    strike();
  }
  /// The part of a step by which rounding delays an impact.
  [[nodiscard]] Real late(const Series& q, Real step, Real u) const {
    const Real height = std::max(height_, std::abs(value_of(q, u / 2)));
    const Real off = std::min(rounding_ * std::abs(x_), 1e-6L * height), w = value_of(derivative_of(q), u) / step;
    const Real latest = std::min(1e-6L * (u + (time_ - struck_) / step), (end_ - time_) / step - u);
    return off == 0 ? 0 : std::min(off / (std::abs(w) * step), latest);
  }
  void strike() {
    struck_ = time_, height_ = 0;
    const Real R = s_.restitution, pushed = eps() * (1 + R) / (1 + eps()) * w_;
    run_.events.push_back({Kind::impact, side_, time_, w_, time_, x_, v_, v_ + pushed});
    run_.struck += eps() / (1 + eps()) * (1 - R * R) * w_ * w_ / 2;
    v_ += pushed;
    w_ *= -R;
    if (std::abs(w_) <= still * run_.fastest) w_ = 0;
    take_state();
  }

  /// Goes on to a part of a step; q: the series of a flight, none if the loose mass is carried.
  void pass(const Series& pushes, const Series& x, const Series* q, Real step, Real u) {
    const Series slope = derivative_of(x);
    if (observes_) observe(pushes, x, slope, q, step, u);
    if (q != nullptr) {
      height_ = std::max({height_, std::abs(value_of(*q, u / 2)), std::abs(value_of(*q, u))});
      if (u > 0) q_ = value_of(*q, u), w_ = value_of(derivative_of(*q), u) / step;
    }
    if (u > 0) x_ = value_of(x, u), v_ = value_of(slope, u) / step;
    time_ = u == 1 && step == end_ - time_ ? end_ : time_ + u * step;
    take_state();
  }
  void observe(const Series& pushes, const Series& x, const Series& slope, const Series* q, Real step, Real u) {
    take_extremes(run_.of_x, x, slope, 0, u);
    Series y = x;
    if (q != nullptr) {
      for (std::size_t n = 0; n < series_terms; ++n) y[n] += (*q)[n];
      Range range;
      take_extremes(range, *q, derivative_of(*q), 0, u);
      run_.of_z.take(anchor_ + range.least), run_.of_z.take(anchor_ + range.greatest);
    }
    y[0] += anchor_;
    take_extremes(run_.of_y, y, derivative_of(y), 0, u);
    const Real way = value_of(y, u) - value_of(y, 0);
    run_.work += integral_of_product(pushes, slope, u) + eps() * Real(s_.loose_load) * way;
    run_.damped += 2 * Real(s_.damping) * integral_of_product(slope, slope, u) / step;
  }
  void take_state() {
    run_.of_x.take(x_), run_.of_z.take(z()), run_.of_y.take(x_ + z());
    run_.fastest = std::max(run_.fastest, std::abs(w_));
    run_.fastest_main = std::max(run_.fastest_main, std::abs(v_));
  }

  const CarryScene s_;
  const Real end_;       ///< of the run, tau
  const Real rounding_;  ///< of places, in parts of x
  const bool observes_;  ///< extremes and energies
  Real time_ = 0;
  Real x_, v_;             ///< of the main mass
  Real anchor_;            ///< the place that the way of the loose mass counts from: keeps the digits of short flights
  Real q_ = 0, w_;         ///< the way from there, and z'
  int side_ = 0;           ///< the wall at the anchor; 0: none
  Real struck_ = 0;        ///< time of the last impact
  Real height_ = 0;        ///< the farthest way from the anchor since then
  bool released_ = false;  ///< at this instant the wall neither pushes nor would have to pull
  CarryRun run_;
};

}  // namespace

CarryRun carry(const CarryScene& scene, Real duration, std::size_t most_events) {
  return Carry(scene, duration, 0, true).run(most_events);
}
CarryRun carry_events(const CarryScene& scene, Real duration, std::size_t most_events, Real rounding) {
  return Carry(scene, duration, rounding, false).run(most_events);
}

}  // namespace clatter::hard
