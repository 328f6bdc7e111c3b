#include "support/course.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>

#include "integrators/settle.hpp"
#include "numbers/fifty_digits.hpp"

namespace clatter {
namespace {

struct Recorder {
  std::vector<Event>& events;

  template <class A>
  void arc(const A&, double, double) {}
  void rest(const Rest& rest) {
    events.push_back({rest.held ? Event::Kind::rest : Event::Kind::chatter, rest.side, rest.time, 0.0, rest.length});
  }
  void impact(const Impact& impact) {
    events.push_back({Event::Kind::impact, impact.side, impact.time, std::abs(impact.before), 0.0});
  }
};

template <class Number>
Course run_in(const Scene& scene, double duration) {
  return with_effects(required_effects(scene.oscillator), [&]<Effects effects>() {
    Course course;
    Exact<Number, effects> integrator(scene);
    State<Number> state;
    state.x = scene.start.displacement, state.v = scene.start.velocity;
    Recorder recorder{course.events};
    course.outcome = run_for(integrator, state, Number(Number(duration) / integrator.period()), recorder);
    course.x = static_cast<double>(state.x), course.v = static_cast<double>(state.v);
    course.impacts = integrator.impacts(), course.evaluations = integrator.evaluations();
    return course;
  });
}

/// One rest per stay on a stop: a section cuts a rest in two, whose ends meet.
std::vector<Event> with_rests_joined(const std::vector<Event>& events) {
  std::vector<Event> joined;
  for (const Event& event : events) {
    if (event.kind == Event::Kind::rest && !joined.empty() && joined.back().kind == Event::Kind::rest)
      joined.back().length = event.time + event.length - joined.back().time;
    else
      joined.push_back(event);
  }
  return joined;
}

std::string text(const Event& event) {
  static const char* const names[] = {"impact", "chatter", "rest"};
  std::ostringstream out;
  out << names[static_cast<int>(event.kind)] << " on " << (event.side == Side::upper ? "upper" : "lower") << " stop at "
      << std::setprecision(17) << event.time;
  return out.str();
}

}  // namespace

Course course_of(const Scene& scene, double duration) { return run_in<double>(scene, duration); }
Course reference_of(const Scene& scene, double duration) { return run_in<FiftyDigits>(scene, duration); }

Deviation deviation(const Course& course, const Course& reference) {
  const auto events = with_rests_joined(course.events), expected = with_rests_joined(reference.events);
  Deviation result;
  std::size_t j = 0;
  for (const Event& event : events) {
    if (event.kind == Event::Kind::chatter)  // the reference goes on for a while
      while (j < expected.size() && expected[j].kind == Event::Kind::impact) ++j;
    if (event.kind == Event::Kind::chatter && j == expected.size() && &event == &events.back()) {
      ++result.chatters;  // the run ends before the reference has completed it
      continue;
    }
    if (j == expected.size() || expected[j].kind != event.kind || expected[j].side != event.side) {
      result.difference = text(event) + " against " + (j == expected.size() ? "nothing" : text(expected[j]));
      return result;
    }
    const Event& other = expected[j++];
    if (event.kind == Event::Kind::chatter) {
      ++result.chatters;
      result.time = std::max(result.time, std::abs(event.time + event.length - other.time - other.length));
      continue;
    }
    result.time = std::max({result.time, std::abs(event.time - other.time),
                            std::abs(event.time + event.length - other.time - other.length)});
    result.speed = std::max(result.speed, std::abs(event.speed - other.speed));
    ++(event.kind == Event::Kind::rest ? result.rests : result.impacts);
  }
  result.same_events = j == expected.size();
  if (!result.same_events) result.difference = "nothing against " + text(expected[j]);
  return result;
}

std::string configuration_of(const Scene& s, double duration) {
  std::ostringstream out;
  out << std::setprecision(17) << "[scene]\nh = " << s.oscillator.damping << "\nf = " << s.oscillator.forcing
      << "\nnu = " << s.oscillator.frequency << "\nload = " << s.oscillator.load << "\nphase = " << s.start.phase
      << "\nx0 = " << s.start.displacement << "\nv0 = " << s.start.velocity << "\nstop_lower = " << s.stops.lower
      << "\nstop_upper = " << s.stops.upper << "\nR_lower = " << s.stops.restitution_lower
      << "\nR_upper = " << s.stops.restitution_upper << "\n[time]\nmode = \"transient\"\nduration = " << duration
      << "\n[observe]\nimpact_log = true\n";
  return out.str();
}

}  // namespace clatter
