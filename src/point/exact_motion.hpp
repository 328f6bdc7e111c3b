#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "motion/state.hpp"
#include "point/problem.hpp"
#include "steady/observed_time.hpp"
#include "steady/passage_observer.hpp"
#include "stepping/integration.hpp"

namespace clatter::point {

/// An event of a motion.
struct MotionEvent {
  enum class Kind : std::uint8_t {
    impact,      ///< on a rigid stop
    rest,        ///< on a rigid stop begins
    chatter,     ///< its end is summed, or the force within rounding of 0 is waited for: `motion::Rest` not held
    touch,       ///< of a soft stop at its position, where contact begins
    renewal,     ///< of the contact with a soft stop, whose force rises from zero, beyond its position
    separation,  ///< from a soft stop, whose force falls to zero
  };
  Kind kind;
  Side side;
  double time;          ///< tau
  double velocity;      ///< before it; 0 at rest
  double length = 0.0;  ///< of a rest or a chatter's end, tau
  double after = 0.0;   ///< velocity after an impact
};

/// Records a motion by its events and, as the search for steady motion does, by what each forcing period does to it.
class MotionRecorder {
 public:
  explicit MotionRecorder(const Stops& stops) : watch(stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    watch.arc(arc, begin, length);
  }
  void rest(const motion::Rest& rest) {
    add({rest.held ? MotionEvent::Kind::rest : MotionEvent::Kind::chatter, rest.side, rest.time, 0.0, rest.length});
    watch.rest(rest);
  }
  void impact(const motion::Impact& impact) {
    add({MotionEvent::Kind::impact, impact.side, impact.time, impact.before, 0.0, impact.after}), watch.impact(impact);
  }
  void touch(const motion::Touch& touch) {
    add({touch.from_outside ? MotionEvent::Kind::touch : MotionEvent::Kind::renewal, touch.side, touch.time,
         touch.velocity});
    watch.touch(touch);
  }
  void separate(const motion::Separation& separation) {
    watch.separate(separation);
    add({MotionEvent::Kind::separation, separation.side, separation.time, separation.velocity});
  }

  void keep_events() { keeps_events_ = true; }
  /// Keeps them with the derivative of the motion to each from the one before, the first from here.
  void keep_derivatives() { keeps_events_ = keeps_derivatives_ = true, watch.differentiate(); }

  steady::PassageObserver watch;
  std::vector<MotionEvent> events{};                    ///< in order, if they are kept
  std::vector<motion::Jacobian<double>> derivatives{};  ///< of the state before each of them by that before the last

 private:
  void add(const MotionEvent& event) {
    if (keeps_events_) events.push_back(event);
    if (keeps_derivatives_) derivatives.push_back(watch.derivative()), watch.begin_derivative_anew();
  }

  bool keeps_events_ = false, keeps_derivatives_ = false;
};

/// The motion of a problem by the exact method, with the effects that it requires, for those who look at a motion
/// section by section. It is compiled once for each set of effects, whoever asks.
class ExactMotion {
 public:
  [[nodiscard]] static std::unique_ptr<ExactMotion> of(const Problem& problem);
  virtual ~ExactMotion() = default;

  [[nodiscard]] virtual motion::State<double> start() const = 0;
  [[nodiscard]] virtual const Stops& stops() const = 0;  ///< those in reach
  [[nodiscard]] virtual double period()
      const = 0;  ///< of the force, tau; without one that of the spring, 2 pi without either
  [[nodiscard]] virtual double impacts() const = 0;      ///< simulated so far
  [[nodiscard]] virtual double evaluations() const = 0;  ///< of arcs, so far

  /// As the functions of these names in `steady` and `stepping`.
  [[nodiscard]] virtual steady::ObservedTime find_steady() = 0;
  [[nodiscard]] virtual stepping::Outcome advance_to_section(motion::State<double>& state, std::int64_t origin,
                                                             MotionRecorder& recorder) = 0;
  [[nodiscard]] virtual stepping::Outcome run_for(motion::State<double>& state, double turns,
                                                  MotionRecorder& recorder) = 0;
};

}  // namespace clatter::point
