#pragma once

#include <memory>
#include <tuple>
#include <type_traits>

#include "motion/arc.hpp"
#include "motion/coupled_arc.hpp"
#include "motion/event.hpp"
#include "motion/housed_arc.hpp"
#include "motion/polynomial_in_housing.hpp"
#include "motion/relative_arc.hpp"
#include "stepping/stop_frame.hpp"

/// Observers as the loops of machines with more than rigid stops see them. Those are long, and each observer has a type
/// of its own: a loop that calls any of them through a pointer is compiled once for all. Beside an event there the call
/// takes next to no time.
namespace clatter::stepping {

/// A reference to an observer of any type, to which arcs of some types are shown.
template <class... Arcs>
class AnyObserver {
 public:
  template <class Observer>
  explicit AnyObserver(Observer& observer) : observer_(std::addressof(observer)), calls_(&calls_of<Observer>) {}

  template <class A>
  void arc(const A& arc, double begin, double length) const {
    static_assert((std::is_same_v<A, Arcs> || ...), "the method names the types of its arcs");
    std::get<ShowArc<A>>(calls_->arcs)(observer_, arc, begin, length);
  }
  void event(const motion::Event& event) const { calls_->event(observer_, event); }

 private:
  template <class A>
  using ShowArc = void (*)(void*, const A&, double, double);
  struct Calls {
    std::tuple<ShowArc<Arcs>...> arcs;
    void (*event)(void*, const motion::Event&);
  };
  template <class Observer, class A>
  static void show_arc(void* observer, const A& arc, double begin, double length) {
    static_cast<Observer*>(observer)->arc(arc, begin, length);
  }
  template <class Observer>
  static void show_event(void* observer, const motion::Event& event) {
    static_cast<Observer*>(observer)->event(event);
  }
  template <class Observer>
  static constexpr Calls calls_of{{&show_arc<Observer, Arcs>...}, &show_event<Observer>};

  void* observer_;
  const Calls* calls_;
};

/// The effects of all arcs of any stiffness: of the mass alone, in contact with a soft stop, with a loose mass, or
/// held.
inline constexpr Effects any_rotation{.damping = Damping::light, .forcing = Forcing::regular, .stiffness = true};
inline constexpr Effects any_resonance{.damping = Damping::light, .forcing = Forcing::secular, .stiffness = true};
inline constexpr Effects any_decay{.damping = Damping::heavy, .forcing = Forcing::regular, .stiffness = true};

/// The arcs of a method: of the main mass, and of a loose one beside it.
template <class N>
struct ExactArcs {
  using Number = N;
  template <Effects Of>
  using Main = motion::Arc<Number, Of>;
  template <Effects Of>
  using Loose = motion::RelativeArc<Number, Of>;
};
struct DenseArcs {
  using Number = double;
  template <Effects Of>
  using Main = motion::PolynomialArc<Of>;
  template <Effects Of>
  using Loose = motion::PolynomialInHousing<Of>;
};

namespace detail {

template <class Arcs, Effects... of>
using MainObserver = AnyObserver<typename Arcs::template Main<of>...>;
template <class Arcs, Effects... of>
using MovingStopsObserver = AnyObserver<typename Arcs::template Main<of>..., ArcOverBase<typename Arcs::Number, of>...>;
template <class Arcs, Effects... of>
using HousingObserver = AnyObserver<
    motion::HousedArc<typename Arcs::template Main<of>, typename Arcs::template Loose<of>>...,
    motion::HousedArc<typename Arcs::template Main<of>, motion::Pressed>...,
    motion::HousedArc<motion::CoupledArc<typename Arcs::Number>, motion::CoupledInHousing<typename Arcs::Number>>>;

template <class Arcs, Effects E>
[[nodiscard]] constexpr auto observer_of() {
  if constexpr (E.loose && !E.soft)
    return std::type_identity<HousingObserver<Arcs, any_resonance, any_decay>>();
  else if constexpr (E.loose)
    return std::type_identity<HousingObserver<Arcs, any_rotation, any_resonance, any_decay>>();
  else if constexpr (E.own_motion)
    return std::type_identity<MovingStopsObserver<Arcs, any_rotation, any_resonance, any_decay>>();
  else if constexpr (E.soft)
    return std::type_identity<MainObserver<Arcs, any_rotation, any_resonance, any_decay>>();
  else
    return std::type_identity<MainObserver<Arcs, E.arc()>>();
}

}  // namespace detail

/// Any observer of the arcs that a method has for the effects in E.
template <class Arcs, Effects E>
using ObserverOf = typename decltype(detail::observer_of<Arcs, E>())::type;

}  // namespace clatter::stepping
