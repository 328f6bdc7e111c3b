#pragma once

#include <tuple>

#include "motion/event.hpp"

namespace clatter::motion {

/// Several observers of one motion, each told in turn.
template <class... Observers>
class Together {
 public:
  explicit Together(Observers&... observers) : all_(observers...) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    std::apply([&](auto&... observer) { (observer.arc(arc, begin, length), ...); }, all_);
  }
  void event(const Event& event) {
    std::apply([&](auto&... observer) { (observer.event(event), ...); }, all_);
  }

 private:
  std::tuple<Observers&...> all_;
};

}  // namespace clatter::motion
