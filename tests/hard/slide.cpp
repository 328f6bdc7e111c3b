#include "hard/slide.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>
#include <utility>

#include "hard/first_fall.hpp"

namespace clatter::hard {
namespace {

using Real = SlideEvent::Real;
using Kind = SlideEvent::Kind;

/// What ends a flight.
enum class End : std::uint8_t { none, stop_ahead, still, force_gone, left, force_back };

class Slide {
 public:
  Slide(const Scene& scene, Real duration, Real rounding)
      : scene_(scene), end_(duration), rounding_(rounding), anchor_(scene.start.displacement) {
    v_ = scene.start.velocity;
    const Side around = soft_stop_beyond(scene.stops, scene.start.displacement);
    if (around != Side::none) enter(around, Real(scene.start.displacement) - position(around));
    pressed_ = around != Side::none && force() > 0;
    run_.lowest = run_.highest = x();
  }

  SlideRun run(std::size_t most_events) {
    std::size_t phases = 0;
    while (time_ < end_ && run_.events.size() < most_events && ++phases < most_phases) {
      if (v_ != 0) ahead_ = v_ > 0 ? Side::upper : Side::lower;
      if (v_ == 0 && !released_ && stand()) continue;
      slip();
    }
    run_.completed = !(time_ < end_);
    run_.x = x(), run_.v = v_;
    return std::move(run_);
  }

 private:
  static constexpr Real pi = std::numbers::pi_v<Real>;
  static constexpr Real still = 1e-16L;                   ///< rebounds are as slow, in units of the fastest speed
  static constexpr std::size_t most_phases = 20'000'000;  ///< flights are cut into Taylor steps

  [[nodiscard]] Real x() const { return anchor_ + y_; }
  [[nodiscard]] Real angle(Real time) const { return Real(scene_.oscillator.frequency) * time + scene_.start.phase; }
  [[nodiscard]] Real position(Side side) const { return side == Side::upper ? scene_.stops.upper : scene_.stops.lower; }
  [[nodiscard]] Real kappa(Side side) const {
    return side == Side::upper ? scene_.stops.stiffness_upper : scene_.stops.stiffness_lower;
  }
  /// Damping ratio of a soft stop.
  [[nodiscard]] Real zeta(Side side) const {
    return side == Side::upper ? scene_.stops.damping_upper : scene_.stops.damping_lower;
  }
  /// Half the factor of the velocity in the force of a soft stop.
  [[nodiscard]] Real damper(Side side) const { return zeta(side) * std::sqrt(kappa(side)); }
  [[nodiscard]] bool is_rigid(Side side) const { return !is_soft(scene_.stops, side); }
  [[nodiscard]] bool is_on_rigid(Side side) const { return is_rigid(side) && y_ == 0 && anchor_ == position(side); }

  /// The force by which the soft stop around pushes the mass back.
  [[nodiscard]] Real force() const { return sign_of(within_) * (kappa(within_) * y_ + 2 * damper(within_) * v_); }
  /// The constant forces on a mass at rest, friction excepted.
  [[nodiscard]] Real constant_push() const {
    const Real spring = within_ == Side::none ? 0 : kappa(within_) * y_;
    return Real(scene_.oscillator.load) - Real(scene_.oscillator.stiffness) * x() - spring;
  }
  [[nodiscard]] Real push() const { return constant_push() + scene_.oscillator.forcing * std::sin(angle(time_)); }

  // A mass at rest.

  /// Whether friction or a rigid stop keeps the mass from going to a side.
  [[nodiscard]] bool is_held(Side side) const {
    return is_on_rigid(side) || sign_of(side) * push() <= Real(scene_.friction.static_level);
  }
  /// Holds the mass as long as it is held; false: it goes at once.
  bool stand() {
    if (within_ != Side::none) pressed_ = true;
    if (!is_held(Side::lower) || !is_held(Side::upper)) {
      ahead_ = push() > 0 ? Side::upper : Side::lower;
      return false;
    }
    const Side on = is_on_rigid(Side::lower) ? Side::lower : is_on_rigid(Side::upper) ? Side::upper : Side::none;
    Real until = end_;
    for (const Side side : {Side::lower, Side::upper})
      if (const auto release = on == side ? std::nullopt : release_of(side); release && *release < until)
        until = *release, ahead_ = side, released_ = true;
    run_.events.push_back({on == Side::none ? Kind::stick : Kind::rest, on, time_, 0, until, x(), braked_});
    if (on == Side::none) run_.stuck += until - time_;
    time_ = until;
    return true;
  }
  /// The instant at which the push to a side passes the static level on its way up, from now on.
  [[nodiscard]] std::optional<Real> release_of(Side side) const {
    const Real most = std::abs(Real(scene_.oscillator.forcing));
    const Real level = Real(scene_.friction.static_level) - sign_of(side) * constant_push();
    if (!(level < most)) return std::nullopt;
    const bool turned = sign_of(side) * scene_.oscillator.forcing < 0;
    const Real now = angle(time_) + (turned ? pi : 0);  // the push rises with the sine of this angle
    Real trough = 2 * pi * std::floor((now + pi / 2) / (2 * pi)) - pi / 2;
    if (now > trough + pi) trough += 2 * pi;
    Real low = std::max(now, trough), high = trough + pi;
    for (int i = 0; i < 100; ++i) {
      const Real middle = (low + high) / 2;
      (most * std::sin(middle) > level ? high : low) = middle;
    }
    return time_ + (low - now) / Real(scene_.oscillator.frequency);
  }

  // A mass in motion.

  /// One Taylor step of a slip, or less if it ends before.
  void slip() {
    const Real step = std::min(end_ - time_, 1 / rate());
    const Series y = series(step), slope = derivative_of(y);
    const auto [end, u] = first_end(y, slope, step);
    const Real from = x();
    time_ = end == End::none && step == end_ - time_ ? end_ : time_ + u * step;
    if (end != End::none || u > 0) y_ = value_of(y, u), v_ = value_of(slope, u) / step;
    released_ = balanced_ = false, braked_ = 0;
    run_.rubbed += Real(scene_.friction.kinetic) * std::abs(x() - from);
    conclude(end);
    run_.lowest = std::min(run_.lowest, x()), run_.highest = std::max(run_.highest, x());
    run_.fastest = std::max(run_.fastest, std::abs(v_));
  }
  void conclude(End end) {
    if (end == End::stop_ahead) meet();
    if (end == End::still) turn();
    if (end == End::force_gone) separate();
    if (end == End::left) leave();
    if (end == End::force_back) {
      pressed_ = balanced_ = true;
      run_.events.push_back({Kind::renewal, within_, time_, v_});
    }
  }

  /// The fastest that the motion changes.
  [[nodiscard]] Real rate() const {
    const auto& o = scene_.oscillator;
    return std::max(
        {std::sqrt(std::abs(stiffness())), 2 * damping(), o.forcing == 0 ? Real(0) : Real(o.frequency), Real(0.01)});
  }
  [[nodiscard]] Real damping() const { return scene_.oscillator.damping + (pressed_ ? damper(within_) : 0); }
  [[nodiscard]] Real stiffness() const { return scene_.oscillator.stiffness + (pressed_ ? kappa(within_) : 0); }

  /// The offset from the anchor over a step, by powers of its part that has passed. A mass that friction has let go
  /// begins with the difference between its two levels.
  [[nodiscard]] Series series(Real step) const {
    const auto& o = scene_.oscillator;
    const Real mu = scene_.friction.kinetic, pull = o.load - Real(o.stiffness) * anchor_ - sign_of(ahead_) * mu;
    const Real sine = std::sin(angle(time_)), cosine = std::cos(angle(time_));
    const std::array<Real, 4> derivatives{sine, cosine, -sine, -cosine};
    Series c{y_, v_ * step};
    Real forcing = o.forcing;  // times (nu step)^n / n!
    for (std::size_t n = 0; n + 2 < series_terms; ++n) {
      const Real forced = forcing * derivatives[n % 4] + (n == 0 ? pull : 0);
      c[n + 2] = (step * step * (forced - stiffness() * c[n]) - 2 * damping() * step * Real(n + 1) * c[n + 1]) /
                 Real((n + 1) * (n + 2));
      if (n == 0 && released_) c[2] = sign_of(ahead_) * (Real(scene_.friction.static_level) - mu) * step * step / 2;
      forcing *= o.frequency * step / Real(n + 1);
    }
    return c;
  }

  /// The first of all that may end a step, and the part of it until then.
  [[nodiscard]] std::pair<End, Real> first_end(const Series& y, const Series& slope, Real step) const {
    std::pair<End, Real> first{End::none, 1};
    const auto consider = [&](End end, const Series& margin) {
      if (const auto u = first_fall(margin); u && (first.first == End::none || *u < first.second)) first = {end, *u};
    };
    if (within_ == Side::none && std::isfinite(position(ahead_)))
      consider(End::stop_ahead, combined(position(ahead_) - anchor_, y, slope, -sign_of(ahead_), 0));
    if (within_ != Side::none) {
      const int in = sign_of(within_);
      Series push = combined(0, y, slope, in * kappa(within_), in * 2 * damper(within_) / step);
      if (balanced_) push[0] = 0;
      if (pressed_) consider(End::force_gone, push);
      if (!pressed_) consider(End::left, combined(0, y, slope, in, 0));
      for (Real& term : push) term = -term;
      if (!pressed_) consider(End::force_back, push);
    }
    consider(End::still, combined(0, y, slope, 0, sign_of(ahead_)));
    return first;
  }
  /// The series of a sign times a distance, plus multiples of offset and slope.
  [[nodiscard]] Series combined(Real distance, const Series& y, const Series& slope, Real of_offset,
                                Real of_slope) const {
    Series margin{};
    for (std::size_t k = 0; k < series_terms; ++k) margin[k] = of_offset * y[k] + of_slope * slope[k];
    margin[0] += sign_of(ahead_) * distance;
    return margin;
  }

  void meet() {
    anchor_ = position(ahead_), y_ = 0;
    if (sign_of(ahead_) * v_ < 0) v_ = 0;
    if (is_rigid(ahead_)) return strike();
    if (v_ != 0) run_.events.push_back({Kind::touch, ahead_, time_, v_});
    enter(ahead_, 0);
    pressed_ = true;
  }
  void strike() {
    run_.events.push_back({Kind::impact, ahead_, time_, v_});
    run_.fastest = std::max(run_.fastest, std::abs(v_));
    v_ *= -Real(ahead_ == Side::upper ? scene_.stops.restitution_upper : scene_.stops.restitution_lower);
    if (std::abs(v_) <= still * run_.fastest) v_ = 0;
  }
  /// The end of a slip: a reversal, unless the mass is held.
  void turn() {
    v_ = 0;
    y_ += std::min(rounding_ * std::abs(x()), Real(1e-6) * std::abs(y_));
    if (within_ != Side::none) pressed_ = true;
    const Real rub = sign_of(ahead_) * Real(scene_.friction.kinetic);
    braked_ = push() - rub;
    if (is_held(Side::lower) && is_held(Side::upper)) return;
    run_.events.push_back({Kind::reversal, Side::none, time_, 0, 0, x(), braked_, push() + rub});
  }
  void enter(Side side, Real offset) { within_ = side, anchor_ = position(side), y_ = offset; }
  void separate() {
    pressed_ = false, balanced_ = true;
    run_.events.push_back({Kind::separation, within_, time_, v_});
    if (zeta(within_) == 0) leave();
  }
  void leave() { y_ = 0, within_ = Side::none, pressed_ = balanced_ = false; }

  const Scene scene_;
  const Real end_;       ///< of the run, tau
  const Real rounding_;  ///< of places at which the velocity falls to 0
  Real time_ = 0;
  Real anchor_;               ///< the place that the offset counts from: keeps the digits of short flights
  Real y_ = 0;                ///< offset
  Real v_ = 0;                ///< velocity
  Side ahead_ = Side::none;   ///< the side to which the mass moves
  Side within_ = Side::none;  ///< the soft stop beyond whose position the mass is; then the anchor is there
  bool pressed_ = false;      ///< that stop pushes the mass
  bool released_ = false;     ///< friction lets the mass go at this instant
  bool balanced_ = false;     ///< the force of the soft stop around is 0 at this instant
  Real braked_ = 0;           ///< acceleration at the end of the last slip
  SlideRun run_;
};

}  // namespace

SlideRun slide(const Scene& scene, Real duration, std::size_t most_events, Real rounding) {
  return Slide(scene, duration, rounding).run(most_events);
}

}  // namespace clatter::hard
