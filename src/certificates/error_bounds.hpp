#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <complex>
#include <cstddef>
#include <vector>

#include "certificates/certificate.hpp"
#include "certificates/recorded_motion.hpp"
#include "motion/known_soft_stops.hpp"
#include "point/point.hpp"
#include "scene/phased_force.hpp"

namespace clatter::certificates {

constexpr double of_state = 1e-12;       ///< error of the state at the start over the size of the motion
constexpr double of_arithmetic = 1e-13;  ///< of each later one: some dozens of roundings
constexpr double of_chatter = 1e-9;      ///< of the time that a chatter takes
constexpr double of_multiplier = 1e-9;

/// How far the numbers of a motion of n numbers in double may be off: a small share of its size, as much of it as the
/// motion stretches. An estimate, not a proof: to prove is up to the verifier.
template <std::size_t n>
class Bounds {
 public:
  /// Whether an event of one mass ends the time for which something holds the other one.
  [[nodiscard]] bool is_cut(const ClaimedEvent& held, const ClaimedEvent& event) const {
    const bool lasts = held.kind == motion::Event::Kind::rest || held.kind == motion::Event::Kind::stick;
    return lasts && held.of_wall != event.of_wall &&
           std::abs(event.time.value - held.then.value) <= time_error(event.time.value - begin_);
  }
  /// Whether a periodic motion is alone, so that its start is known.
  [[nodiscard]] bool know_the_start() const { return of_start_ < 1e10; }
  /// Of each number at the start.
  [[nodiscard]] double of_start() const { return of_state * size_ * of_start_; }
  [[nodiscard]] Claimed claimed_extremum(double x) const {
    return {x, (of_state * of_start_ + of_arithmetic) * size_ * stretching_};
  }
  /// Whether the errors of a motion's claims are small beside its size and the forcing period, so that they say
  /// something.
  [[nodiscard]] bool tell(const Certificate& certificate) const {
    constexpr double small = 1e-3;
    const auto known = [](const Claimed& claim, double scale) { return claim.error <= small * scale; };
    const auto& end = certificate.end;
    return certificate.x_error <= small * size_ && known(certificate.x_min, size_) && known(certificate.x_max, size_) &&
           (!end || (known(end->x, size_) && known(end->v, size_) && known(end->z, size_) && known(end->w, size_))) &&
           std::ranges::all_of(certificate.events,
                               [&](const ClaimedEvent& event) { return known(event.time, forcing_period_); });
  }

 protected:
  using Map = typename Growth<n>::Map;
  using Sizes = typename Growth<n>::Sizes;

  /// Of a motion from the start of a problem at a time on; `returns`: the norm of (1 - M)^-1 if it is periodic, which
  /// is how far the state that returns moves if the motion is off; else 0.
  Bounds(const point::Problem& problem, const RecordedMotion<n>& motion, double time, double size, double returns)
      : oscillator_(problem.oscillator),
        phase_(problem.start.phase),
        begin_(time),
        forcing_period_(period_of(problem.oscillator)),
        friction_(problem.friction),
        stops_(problem.stops),
        size_(size),
        stretching_(std::max(1.0, Growth<n>::norm(motion.derivative))) {
    // rounding that a part of the period stretches up to its end, though the whole of it may contract
    if (returns > 0) of_start_ = returns * std::max(1.0, of_arithmetic / of_state * largest(motion.rounding));
    for (const RecordedEvent<n>& event : motion.events)
      stretching_ = std::max({stretching_, Growth<n>::norm(event.derivative), largest(event.rounding)});
  }

  [[nodiscard]] double time_error(double time) const {
    return of_arithmetic * (forcing_period_ + std::abs(begin_) + std::abs(time));
  }
  /// Claims a contact whose place is off by so much: the slower it is, the longer that takes. `a` changes the velocity
  /// meanwhile.
  [[nodiscard]] ClaimedEvent claimed_contact(const RecordedEvent<n>& event, double off, double rate, double v_error,
                                             double a) const {
    const double late = off / std::abs(rate) + time_error(event.time);
    const Claimed time{begin_ + event.time, late}, v{event.velocity(), v_error + std::abs(a) * late};
    return {event.kind, event.side, time, v, {}, false, event.of_wall};
  }
  /// That of the main mass, of whose numbers the errors are given: the instant at which x, or x + q v where the force
  /// of a soft stop passes 0, reaches a place.
  [[nodiscard]] ClaimedEvent claimed_contact(const RecordedEvent<n>& event, double x_error, double v_error,
                                             double a) const {
    const bool ends = event.kind == motion::Event::Kind::separation || event.kind == motion::Event::Kind::renewal;
    const double q = ends ? motion::known_soft_stop(stops_, event.side).relaxation() : 0.0;
    return claimed_contact(event, x_error + q * v_error, event.velocity() + q * a, v_error, a);
  }
  [[nodiscard]] PhasedForce<double> force_at(double time) const {
    return clatter::force_at(oscillator_.forcing, oscillator_.shape, oscillator_.frequency * time + phase_);
  }
  /// The acceleration of the main mass at an instant, at which no soft stop pushes.
  [[nodiscard]] double acceleration_at(double time, double x, double v) const {
    return force_at(time).value + constant_force(oscillator_, x) - 2 * oscillator_.damping * v -
           (v > 0   ? friction_.kinetic
            : v < 0 ? -friction_.kinetic
                    : 0.0);
  }
  /// The displacement at an event: where the force of a soft stop is 0, x - position + q v = 0.
  [[nodiscard]] double place_of(const RecordedEvent<n>& event) const {
    using Kind = motion::Event::Kind;
    if (event.side == Side::none) return event.place;
    const double position = event.side == Side::upper ? stops_.upper : stops_.lower;
    if (event.kind != Kind::separation && event.kind != Kind::renewal) return position;
    return position - motion::known_soft_stop(stops_, event.side).relaxation() * event.velocity();
  }
  /// Claims a stick or a reversal, the velocity of a slip being 0: it falls to 0 the later the slower it does. A mass
  /// that turns back is pushed that way, one that sticks may be pushed on by less than the friction.
  [[nodiscard]] ClaimedEvent claimed_turn(const RecordedEvent<n>& event, double x_error, double v_error) const {
    const double push = std::abs(push_at(event.time, event.place)), mu = friction_.kinetic;
    const bool turns = event.kind == motion::Event::Kind::reversal || push >= mu;
    const double late = v_error / (turns ? push + mu : mu - push) + time_error(event.time);
    ClaimedEvent claim{event.kind, Side::none, {begin_ + event.time, late}, {}, {event.place, x_error}};
    if (event.kind == motion::Event::Kind::stick)
      claim.then = {begin_ + event.end(), release_error(event, event.place, x_error)};
    return claim;
  }
  /// The flights of a chatter under a force last S v together, 2 v/(a (1 - R)) without friction (eqs. 24 and 63): its
  /// end is off by the error of its first impact and by that of its speed. If R depends on the speed, they last no
  /// longer than in proportion to that.
  [[nodiscard]] double chatter_error(const RecordedEvent<n>& event, const ClaimedEvent* before,
                                     const Restitution<double>& law, double push, double mu) const {
    const double error = of_chatter * event.length + time_error(event.end());
    if (before == nullptr) return error;
    if (!law.is_constant()) {
      const double v = before->then.value, rebound = std::abs(law.after(v));
      const double grown = std::abs(law.derivative(v)) * before->then.error;
      return error + before->time.error + (rebound > 0 ? event.length * (grown / rebound) : 0.0);
    }
    const double R = law.R;
    const double up = push + mu, down = push - mu;
    const double flights = (1 / up + 1 / std::sqrt(up * down)) / (1 - R * std::sqrt(down / up));
    return error + before->time.error + R * flights * before->then.error;
  }
  /// The force that holds the mass falls to 0 the later the slower it changes, and of a stick the further the spring
  /// has to be overcome (eq. 65); where nothing releases the mass, the end is that of the motion.
  [[nodiscard]] double release_error(const RecordedEvent<n>& event, double x, double x_error) const {
    const double force = std::abs(push_at(event.end(), x)) - friction_.static_level;
    const double largest = std::abs(oscillator_.forcing) + std::abs(oscillator_.load) +
                           std::abs(oscillator_.stiffness * x) + friction_.static_level;
    const double rate = std::abs(oscillator_.frequency * force_at(event.end()).slope);
    if (!(std::abs(force) <= of_chatter * largest)) return time_error(event.end());
    return time_error(event.end()) + (of_state * largest + stiffness_at(x) * x_error) / rate;
  }
  /// The force on a mass at x' = 0, and the stiffness that acts on it, those of a soft stop included.
  [[nodiscard]] double push_at(double time, double x) const {
    double push = force_at(time).value + constant_force(oscillator_, x);
    if (const Side within = soft_stop_beyond(stops_, x); within != Side::none) {
      const auto stop = motion::known_soft_stop(stops_, within);
      push -= stop.stiffness * (x - stop.position);
    }
    return push;
  }
  [[nodiscard]] double stiffness_at(double x) const {
    const Side within = soft_stop_beyond(stops_, x);
    const double k = std::abs(oscillator_.stiffness);
    return within == Side::none ? k : k + motion::known_soft_stop(stops_, within).stiffness;
  }
  [[nodiscard]] static double largest(const Sizes& sizes) { return *std::ranges::max_element(sizes); }

  Oscillator oscillator_;
  double phase_, begin_, forcing_period_;
  Friction friction_;
  Stops stops_;
  double size_, of_start_ = 1.0, stretching_;  ///< S, error of the start over 1e-12 S, largest norm of the derivative
};

/// Of a mass between stops.
class ErrorBounds : public Bounds<2> {
 public:
  ErrorBounds(const point::Problem& problem, const RecordedMotion<2>& motion, const point::PointResult& result,
              double time, bool periodic);

  /// Claims an event of the motion that follows another, null if it is the first.
  [[nodiscard]] ClaimedEvent claimed(const RecordedEvent<2>& event, const ClaimedEvent* before) const;
  [[nodiscard]] ClaimedEnd claimed_end(const RecordedMotion<2>& motion) const;
  /// Of motion that rests both are 0.
  [[nodiscard]] std::vector<ClaimedMultiplier> claimed(const std::array<std::complex<double>, 2>& multipliers) const;

 private:
  struct StateError {
    double x, v;
  };
  /// Of a state after a path since the event before, by the derivative of the motion and the rounding so far.
  [[nodiscard]] StateError error_after(const Map& derivative, const Sizes& rounding, double path) const;
  [[nodiscard]] ClaimedEvent claimed_stay(const RecordedEvent<2>& event, const ClaimedEvent* before) const;
};

}  // namespace clatter::certificates
