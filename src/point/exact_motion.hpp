#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "motion/event.hpp"
#include "motion/loose_tangent.hpp"
#include "point/problem.hpp"
#include "scene/displacement_bound.hpp"
#include "steady/observed_time.hpp"
#include "steady/passage_observer.hpp"
#include "stepping/integration.hpp"

namespace clatter::point {

/// Records a motion by its events and, as the search for steady motion does, by what each forcing period does to it.
class MotionRecorder {
 public:
  explicit MotionRecorder(const Stops& stops) : watch(stops) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    watch.arc(arc, begin, length);
    if (loose) [[unlikely]] {
      if (keeps_derivatives_) note_stop(arc, begin);
      loose->arc(arc, begin, length);
      if (!keeps_derivatives_) return;
      const motion::Motion<double> end = arc.at(length);
      main_ = {end.x, end.v, end.v}, rubbing_ = static_cast<double>(arc.constants().rubbing);
      if constexpr (motion::Housed<A>)
        if constexpr (requires { arc.loose.load(); }) slowing_ = arc.loose.load() - end.a;
    }
  }
  /// An event of a loose mass is kept as one of a mass between stops, a press as the hold that it begins.
  void event(const motion::Event& event) {
    was_sliding_ = false;
    if (event.kind != motion::Event::Kind::press) add(event.in_housing());
    watch.event(event);
    if (loose) loose->event(event);
  }

  void keep_events() { keeps_events_ = true; }
  /// Keeps them with the derivative of the motion to each from the one before, the first from here; of a time on a wall
  /// to its end, and with the main mass there. A loose mass that friction stops in its housing, of which no event
  /// tells, is kept as a reversal there.
  void keep_derivatives() { keeps_events_ = keeps_derivatives_ = true, watch.differentiate(); }

  steady::PassageObserver watch;
  std::optional<motion::LooseTangent> loose{};             ///< the derivative with a loose mass, if it is asked for
  std::vector<motion::Event> events{};                     ///< in order, if they are kept
  std::vector<motion::Jacobian<double>> derivatives{};     ///< of the state before each of them by that before the last
  std::vector<motion::LooseJacobian> loose_derivatives{};  ///< in place of them with a loose mass

 private:
  /// Friction has stopped a loose mass if it slid, and it now begins with z' = 0, or moves with the main one.
  template <class A>
  void note_stop(const A& arc, double begin) {
    bool slides = false, begins_still = false;
    double place = 0.0;
    if constexpr (motion::Housed<A>) {
      place = motion::place_at(arc.loose, 0.0);
      if constexpr (requires { arc.loose.load(); })
        slides = arc.constants().rubbing != 0, begins_still = arc.loose.at(0.0).v == 0;
      else
        begins_still = true;
    }
    if (was_sliding_ && begins_still)
      add({.kind = motion::Event::Kind::reversal,
           .time = begin,
           .place = place,
           .a_before = slowing_,
           .main = main_,
           .of_wall = true});
    was_sliding_ = slides;
  }
  void add(const motion::Event& event) {
    if (keeps_events_) events.push_back(event);
    if (keeps_derivatives_ && loose) [[unlikely]] {
      loose_derivatives.push_back(loose->map()), loose->begin_anew();
      if (event.lasts())
        events.back().main = main_;
      else
        events.back().rubbing = rubbing_;
    } else if (keeps_derivatives_) {
      derivatives.push_back(watch.derivative()), watch.begin_derivative_anew();
    }
  }

  bool keeps_events_ = false, keeps_derivatives_ = false;
  motion::Event::Main main_{};            ///< at the end of the last arc
  double rubbing_ = 0.0, slowing_ = 0.0;  ///< the friction of a loose mass on it, and z'' at its end
  bool was_sliding_ = false;              ///< beside it the loose mass slid, and no event has come since
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
  /// As `steady::CycleEnds` does.
  [[nodiscard]] virtual stepping::Outcome begin_cycle(motion::State<double>& state) = 0;
  [[nodiscard]] virtual stepping::Outcome end_cycle(motion::State<double>& state, std::int64_t origin,
                                                    MotionRecorder& recorder) = 0;
};

}  // namespace clatter::point
