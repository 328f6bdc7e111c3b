#pragma once

#include "motion/event.hpp"

namespace clatter::support {

/// Shows a motion to an observer that has a function for each kind of event that it asks for: `impact`, `touch` (also
/// of a contact that is renewed), `separate`, `rest` (all times on a stop, and sticks), `reversal`; of a loose mass
/// `strike`, `press` and `hold`.
template <class Watcher>
class Told {
 public:
  explicit Told(Watcher& watcher) : watcher_(watcher) {}

  template <class A>
  void arc(const A& arc, double begin, double length) {
    if constexpr (requires { watcher_.arc(arc, begin, length); }) watcher_.arc(arc, begin, length);
  }
  void event(const motion::Event& event) { tell(watcher_, event); }

  static void tell(Watcher& watcher, const motion::Event& event) {
    using Kind = motion::Event::Kind;
    switch (event.kind) {
      case Kind::impact:
        if constexpr (requires { watcher.impact(event); }) watcher.impact(event);
        break;
      case Kind::touch:
      case Kind::renewal:
        if constexpr (requires { watcher.touch(event); }) watcher.touch(event);
        break;
      case Kind::separation:
        if constexpr (requires { watcher.separate(event); }) watcher.separate(event);
        break;
      case Kind::rest:
      case Kind::chatter:
      case Kind::stick:
        if constexpr (requires { watcher.rest(event); }) watcher.rest(event);
        break;
      case Kind::reversal:
        if constexpr (requires { watcher.reversal(event); }) watcher.reversal(event);
        break;
      case Kind::strike:
        if constexpr (requires { watcher.strike(event); }) watcher.strike(event);
        break;
      case Kind::press:
        if constexpr (requires { watcher.press(event); }) watcher.press(event);
        break;
      case Kind::hold:
        if constexpr (requires { watcher.hold(event); }) watcher.hold(event);
        break;
      case Kind::wall_touch:
      case Kind::wall_renewal:
      case Kind::wall_separation:
        if constexpr (requires { watcher.soft_wall(event); }) watcher.soft_wall(event);
        break;
    }
  }

 private:
  Watcher& watcher_;
};

}  // namespace clatter::support
