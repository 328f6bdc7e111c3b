#pragma once

#include <type_traits>
#include <utility>

#include "motion/arc_constants.hpp"
#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/soft_stop.hpp"

namespace clatter::support {

/// An arc of the main mass, whatever its effects and its method: each integrator is compiled with one observer, which
/// shows tests such arcs.
class SeenArc {
 public:
  struct Constants {
    const motion::SoftStop<double>& stop;  ///< that the mass is in contact with
    double rate;                           ///< the fastest of the motion's frequencies and decay rates
  };
  virtual ~SeenArc() = default;
  [[nodiscard]] virtual motion::Motion<double> start() const = 0;
  [[nodiscard]] virtual motion::Motion<double> at(double s) const = 0;
  [[nodiscard]] virtual double anchor() const = 0;
  [[nodiscard]] virtual double length() const = 0;  ///< of a step of a general method, in tau; else 0
  [[nodiscard]] virtual Constants constants() const = 0;
};

template <class A>
class SeenArcOf : public SeenArc {
 public:
  explicit SeenArcOf(const A& arc) : arc_(motion::main_of(arc)) {}
  [[nodiscard]] motion::Motion<double> start() const override { return arc_.start(); }
  [[nodiscard]] motion::Motion<double> at(double s) const override { return arc_.at(s); }
  [[nodiscard]] double anchor() const override { return arc_.anchor(); }
  [[nodiscard]] double length() const override {
    if constexpr (requires { arc_.length(); })
      return arc_.length();
    else
      return 0.0;
  }
  [[nodiscard]] Constants constants() const override { return {arc_.constants().stop, arc_.constants().rate}; }

 private:
  const std::remove_cvref_t<decltype(motion::main_of(std::declval<const A&>()))>& arc_;
};
template <class A>
SeenArcOf(const A&) -> SeenArcOf<A>;

/// An observer of any of them.
class AnyObserver {
 public:
  virtual ~AnyObserver() = default;
  virtual void arc(const SeenArc& arc, double begin, double length) = 0;
  virtual void event(const motion::Event& event) = 0;
};

/// An observer of arcs of all kinds that sees these.
template <class Observer>
class Seeing : public AnyObserver {
 public:
  explicit Seeing(Observer& observer) : observer_(observer) {}
  void arc(const SeenArc& arc, double begin, double length) override { observer_.arc(arc, begin, length); }
  void event(const motion::Event& event) override { observer_.event(event); }

 private:
  Observer& observer_;
};

/// Shows it arcs of all kinds; nobody, if there is none.
struct Showing {
  AnyObserver* observer;

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if (observer != nullptr) observer->arc(SeenArcOf(arc), begin, length);
  }
  void event(const motion::Event& event) {
    if (observer != nullptr) observer->event(event);
  }
};

}  // namespace clatter::support
