#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <optional>
#include <type_traits>

#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/walls.hpp"
#include "observables/energy/quadrature.hpp"
#include "observables/observable.hpp"

namespace clatter::observables {

/// The energy that friction takes from a loose mass that slides to one side beside an arc, per unit of the main mass.
template <class Flight>
[[nodiscard]] double rubbed_by(const LooseMass& loose, const Flight& flight, double length) {
  if (loose.friction == 0) return 0.0;
  return loose.friction * std::abs(flight.at(length).offset - flight.start().offset);
}
/// The impulse of a wall on a loose mass that moves with the main one along an arc, per unit of the main mass. Friction
/// carries as much of the force as it can, the wall the rest.
template <class A>
[[nodiscard]] double impulse_of_wall(const LooseMass& loose, Side wall, const A& main, double length) {
  const double sign = sign_of(wall), first = main.start().v;
  if (loose.friction_static == 0) return loose.ratio * std::abs(loose.load * length - (main.at(length).v - first));
  const auto force = [&](double s) { return sign * loose.ratio * (loose.load - main.at(s).a) - loose.friction_static; };
  const auto over = [&](double from, double to) {
    const double gained = main.at(to).v - main.at(from).v;
    return sign * loose.ratio * (loose.load * (to - from) - gained) - loose.friction_static * (to - from);
  };
  double sum = 0.0;
  for_each_panel(length, pace_of(main.constants()), 0.125, [&](double middle_of_piece, double half) {
    double from = middle_of_piece - half, to = middle_of_piece + half;
    const bool begins = force(from) > 0, ends = force(to) > 0;
    double low = from, high = to;
    for (int halves = 0; begins != ends && halves < 60; ++halves) {
      const double middle = (low + high) / 2;
      (force(middle) > 0) == begins ? low = middle : high = middle;
    }
    if (begins && !ends) to = low;
    if (!begins && ends) from = high;
    if (begins || ends) sum += over(from, to);
  });
  return sum;
}

/// What soft walls take of the energy of both masses, and store (eq. 74), per unit of the main mass.
class SoftWalls {
 public:
  explicit SoftWalls(const LooseMass& loose)
      : walls_{motion::soft_wall_at<double>(loose, Side::lower), motion::soft_wall_at<double>(loose, Side::upper)},
        are_soft_(has_soft_wall(loose)) {}

  /// Beside an arc: adds to what each wall has taken, and to its impulse.
  template <class L>
  void arc(const L& loose, double length, std::array<double, 2>& lost, std::array<double, 2>& impulse) {
    if (!are_soft_) return;
    const double before = stored_at(loose, 0.0), after = stored_at(loose, length);
    if (!begin_) begin_ = before;
    end_ = after;
    if constexpr (requires { loose.coupling(); }) {
      const motion::SoftStop<double>& wall = loose.coupling().wall;
      const std::size_t side = index_of(wall.side);
      if (!loose.coupling().pushes) return void(lost[side] += before - after);  // as the wall relaxes
      over_panel<20>(length / 2, length / 2, [&](double s, double weight) {
        const motion::Motion<double> z = loose.at(s);
        lost[side] += weight * 2 * wall.damping * z.v * z.v;
        impulse[side] += weight * wall.force(wall.into(z.offset), wall.into(z.v));
      });
    } else if constexpr (std::is_same_v<L, motion::Pressed>) {  // by friction alone, as the walls are soft
      for (const motion::SoftStop<double>& wall : walls_)
        if (const double depth = wall.into(loose.place - wall.position); wall.side != Side::none && depth > 0)
          impulse[index_of(wall.side)] += length * wall.force(depth, 0.0);
    }
  }
  [[nodiscard]] double growth() const { return end_ - begin_.value_or(end_); }  ///< of what they store

 private:
  /// The energy of the springs, which follow the mass; between the walls 0.
  template <class L>
  [[nodiscard]] double stored_at(const L& loose, double s) const {
    if constexpr (requires { loose.coupling(); })
      return stored_by(loose.coupling().wall, loose.at(s).offset);
    else if constexpr (std::is_same_v<L, motion::Pressed>)
      return stored_by(walls_[0], loose.place - walls_[0].position) +
             stored_by(walls_[1], loose.place - walls_[1].position);
    return 0.0;
  }
  [[nodiscard]] static double stored_by(const motion::SoftStop<double>& wall, double offset) {
    const double depth = wall.side == Side::none ? 0.0 : std::max(0.0, wall.into(offset));
    return wall.side == Side::none ? 0.0 : wall.stiffness * depth * depth / 2;
  }

  std::array<motion::SoftStop<double>, 2> walls_;  ///< [wall]
  bool are_soft_;
  std::optional<double> begin_{};  ///< stored when it was seen first
  double end_ = 0.0;
};

/// The energy ledger of a main mass and a loose one, per unit of the main mass (eq. 74): its energy is
/// (x'^2 + k x^2 + eps y'^2)/2, in the frame of a base that is shaken, whose inertial forces on both masses do work.
class LooseEnergy {
 public:
  explicit LooseEnergy(const ObservedSpan& span)
      : oscillator_(span.scene.oscillator),
        loose_(span.scene.loose),
        rule_(loose_),
        walls_(loose_),
        frame_(span.scene.shaking, oscillator_, span.theta),
        total_(span.total) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (!(length > 0)) return;  // before an impact at the very beginning
    see_main(arc, begin, length);
    if constexpr (motion::Housed<A>) see_loose(arc, arc.loose, begin, length);
  }
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind != Kind::strike && event.kind != Kind::press) return;
    lose(event.side, event.before, event.after);
    loose_v_ = event.main.after + event.after;
  }

  /// The terms of the ledger, the observed time ending with displacement x and velocity v.
  struct Ledger {
    double work = 0.0, damped = 0.0, rubbed = 0.0, growth = 0.0;
    std::array<double, 2> lost{}, impulse{};  ///< [wall]

    [[nodiscard]] double residual() const { return work - damped - rubbed - lost[0] - lost[1] - growth; }
  };
  [[nodiscard]] Ledger finish(double x, double v) {
    see_begin(x, v);
    const double growth = energy(x, v, loose_v_, frame_end()) -
                          (begin_ ? energy(begin_->x, begin_->v, begin_loose_.value_or(0.0), frame_begin()) : 0.0);
    return {work_, damped_, rubbed_, growth + walls_.growth(), lost_, impulse_};
  }
  [[nodiscard]] double evaluations() const { return evaluations_; }  ///< of arcs

 private:
  template <class A>
  void see_main(const A& arc, double begin, double length) {
    see_begin(arc.start().x, arc.start().v);
    const bool is_carrying = arc.constants().carried != 0;
    over(pace_of(arc.constants()), length, [&](double s, double weight) {
      const motion::Motion<double> m = arc.at(s);
      const Frame b = frame_at(m.sine, m.cosine, begin + s);
      const double v = m.v - b.v;
      const double force = oscillator_.load + oscillator_.forcing * arc.constants().drive(m).sine -
                           oscillator_.stiffness * b.x - 2 * oscillator_.damping * b.v - b.a;
      work_ += weight * force * v;
      damped_ += weight * 2 * oscillator_.damping * v * v;
      if (is_carrying) work_ += weight * loose_.ratio * (loose_.load - b.a) * v;
    });
  }
  template <class A, class Loose>
  void see_loose(const A& main, const Loose& loose, double begin, double length) {
    see_begin_of_loose(loose.velocity(0.0));
    const double frequency = std::max(frame_.frequency(), 1.0);
    over(Pace{frequency, frequency}, length, [&](double s, double weight) {
      const auto [sine, cosine] = main.phase_after(s);
      const Frame b = frame_at(sine, cosine, begin + s);
      work_ += weight * loose_.ratio * (loose_.load - b.a) * (loose.velocity(s) - b.v);
    });
    loose_v_ = loose.velocity(length), rubbed_ += rubbed_by(loose_, loose, length);
    walls_.arc(loose, length, lost_, impulse_);
  }
  template <class A>
  void see_loose(const A& main, const motion::Pressed& loose, double, double length) {
    const double first = main.start().v, last = main.at(length).v;
    see_begin_of_loose(first);
    if (loose.wall != Side::none) impulse_[index_of(loose.wall)] += impulse_of_wall(loose_, loose.wall, main, length);
    loose_v_ = last;
    walls_.arc(loose, length, lost_, impulse_);
  }

  /// Displacement, velocity and acceleration of a base.
  struct Frame {
    double x = 0.0, v = 0.0, a = 0.0;
  };
  struct Place {
    double x, v;
  };

  [[nodiscard]] bool is_shaken() const { return frame_.amplitude() != 0; }
  [[nodiscard]] Frame frame_of(const SineCosine<double>& theta) const {
    return {frame_.displacement(theta), frame_.velocity(theta), frame_.acceleration(theta)};
  }
  [[nodiscard]] Frame frame_at(double sine, double cosine, double time) const {
    if (!is_shaken()) return {};
    return frame_of(frame_.is_forced() ? frame_.by_force(sine, cosine) : frame_.at(time));
  }
  [[nodiscard]] Frame frame_begin() const { return is_shaken() ? frame_of(frame_.at(0.0)) : Frame{}; }
  [[nodiscard]] Frame frame_end() const { return is_shaken() ? frame_of(frame_.at(total_)) : Frame{}; }

  [[nodiscard]] double energy(double x, double v, double loose_v, const Frame& b) const {
    const double X = x - b.x, V = v - b.v, Y = loose_v - b.v;
    return (V * V + oscillator_.stiffness * X * X + loose_.ratio * Y * Y) / 2;
  }
  void see_begin(double x, double v) {
    if (!begin_) begin_ = Place{x, v};
  }
  void see_begin_of_loose(double v) {
    if (!begin_loose_) begin_loose_ = v;
  }
  /// An impact: its impulse from z', as the velocities of the main mass differ by less than their digits if the loose
  /// one is very light.
  void lose(Side side, double before, double after) {
    lost_[index_of(side)] += rule_.loss(before, after);
    impulse_[index_of(side)] += rule_.share() * std::abs(before - after);
  }
  /// Gauss-Legendre quadrature by panels in which nothing turns by more than a few radians.
  template <class Add>
  void over(const Pace& pace, double length, const Add& add) {
    evaluations_ += over_panels<20>(length, pace, 2, add);
  }

  Oscillator oscillator_;
  LooseMass loose_;
  motion::WallRule<double> rule_;
  SoftWalls walls_;
  FrameMotion frame_;
  double total_;
  std::optional<Place> begin_{};         ///< of the main mass
  std::optional<double> begin_loose_{};  ///< y'
  double loose_v_ = 0.0;                 ///< y', where it was seen last
  double work_ = 0.0, damped_ = 0.0, rubbed_ = 0.0, evaluations_ = 0.0;
  std::array<double, 2> lost_{}, impulse_{};  ///< [wall]
};

/// What a loose mass adds to the ledger of a main mass with stops or friction (eq. 74): the work of its load, the
/// losses on the walls, and its energy.
class LooseShare {
 public:
  explicit LooseShare(const LooseMass& loose) : loose_(loose), rule_(loose), walls_(loose) {}

  template <class A>
  void arc(const A& arc, double length) {
    if constexpr (motion::Housed<A>)
      if (length > 0) see(arc, arc.loose, length);
  }
  /// Tells whether it is one of a loose mass.
  bool event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.kind != Kind::strike && event.kind != Kind::press)
      return event.kind == Kind::hold || event.is_of_soft_wall();
    if (!begin_) begin_ = event.main.before + event.before;
    lost_[index_of(event.side)] += rule_.loss(event.before, event.after);
    impulse_[index_of(event.side)] += rule_.share() * std::abs(event.before - event.after);
    end_ = event.main.after + event.after;
    return true;
  }

  [[nodiscard]] const std::array<double, 2>& lost() const { return lost_; }        ///< [wall]
  [[nodiscard]] const std::array<double, 2>& impulse() const { return impulse_; }  ///< [wall]
  [[nodiscard]] double rubbed() const { return rubbed_; }                          ///< lost to friction in the housing
  /// Of a period the work is rounding alone.
  [[nodiscard]] double work() const { return loose_.ratio * loose_.load * way_; }
  [[nodiscard]] double growth() const {
    return loose_.ratio * (end_ - begin_.value_or(0.0)) * (end_ + begin_.value_or(0.0)) / 2 + walls_.growth();
  }

 private:
  template <class A, class Flight>
  void see([[maybe_unused]] const A& main, const Flight& loose, double length) {
    const double from = loose.velocity(0.0);
    if (!begin_) begin_ = from;
    end_ = loose.velocity(length), rubbed_ += rubbed_by(loose_, loose, length);
    if constexpr (requires { loose.coupling(); })
      way_ += (loose.at(length).offset - loose.start().offset) + (main.at(length).offset - main.start().offset);
    else
      way_ += (from + end_) / 2 * length;
    walls_.arc(loose, length, lost_, impulse_);
  }
  template <class A>
  void see(const A& main, const motion::Pressed& loose, double length) {
    const motion::Motion<double>&from = main.start(), to = main.at(length);
    if (!begin_) begin_ = from.v;
    if (loose.wall != Side::none) impulse_[index_of(loose.wall)] += impulse_of_wall(loose_, loose.wall, main, length);
    end_ = to.v, way_ += to.offset - from.offset;
    walls_.arc(loose, length, lost_, impulse_);
  }

  LooseMass loose_;
  motion::WallRule<double> rule_;
  SoftWalls walls_;
  std::optional<double> begin_{};             ///< y'
  double end_ = 0.0, way_ = 0.0;              ///< y', and by how much y grows
  double rubbed_ = 0.0;                       ///< the loss by friction in the housing
  std::array<double, 2> lost_{}, impulse_{};  ///< [wall]
};

}  // namespace clatter::observables
