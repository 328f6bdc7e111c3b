#include "attractors/exact_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "model/required_effects.hpp"
#include "stepping/exact.hpp"
#include "stepping/run.hpp"

namespace clatter::attractors {
namespace {

using Contact = observables::ImpactWord::Contact;

/// Records the contacts of a round.
class ContactObserver {
 public:
  template <class A>
  void arc(const A&, double, double) {}
  void rest(const motion::Rest& rest) { add({rest.time, 0.0, rest.side}, rest.time + rest.length); }
  void impact(const motion::Impact& impact) {
    add({impact.time, impact.before, impact.side}, impact.time);
    fastest_ = std::max(fastest_, std::abs(impact.before));
  }

  void touch(const motion::Touch& touch) {
    if (!touch.from_outside) return;
    add({touch.time, touch.velocity, touch.side}, touch.time);
    fastest_ = std::max(fastest_, std::abs(touch.velocity));
  }
  void separate(const motion::Separation& separation) {
    if (!ends_.empty()) ends_.back() = separation.time;
  }

  /// Adds what was seen in a round of that length, in tau.
  void finish(double length, Round& round) {
    double longest = 0.0;
    for (std::size_t i = 0; i < contacts_.size(); ++i) {
      const double next = i + 1 < contacts_.size() ? contacts_[i + 1].time : contacts_[0].time + length;
      if (next - ends_[i] <= longest) continue;
      longest = next - ends_[i];
      round.middle_of_flight =
          std::fmod((ends_[i] + next) / 2, length) / length * static_cast<double>(round.orbit.periods);
    }
    round.fastest = fastest_;
    round.contacts = std::move(contacts_);
  }

 private:
  void add(const Contact& contact, double end) { contacts_.push_back(contact), ends_.push_back(end); }

  std::vector<Contact> contacts_;
  std::vector<double> ends_;  ///< [contact]: the beginning of the flight after it
  double fastest_ = 0.0;
};

/// Calls `function(integrator, state)` with the start of a problem.
template <class Function>
auto with_start(const point::Problem& problem, Function&& function) {
  const Effects effects = required_effects(problem);
  motion::State<double> state;
  state.x = problem.start.displacement, state.v = problem.start.velocity;
  return with_effects(effects, [&]<Effects E>() {
    stepping::Exact<double, E> integrator(problem, stops_in_reach(problem.stops, effects), limits_of(problem));
    return function(integrator, state);
  });
}

}  // namespace

point::Problem started(point::Problem problem, const PhasePoint& state, double phase) {
  problem.start = {state.x, state.v, phase + problem.shaking.lead};
  return problem;
}

std::optional<Round> run_round(const point::Problem& problem, std::size_t periods) {
  return with_start(problem, [&]<class I>(I& integrator, const motion::State<double>& state) -> std::optional<Round> {
    steady::StroboscopicMap<I::effects> map(integrator, problem.time.tolerance);
    ContactObserver contacts;
    const std::optional<steady::Orbit> orbit = map.follow(state, periods, contacts);
    if (!orbit) return std::nullopt;
    Round round{*orbit, {}};
    contacts.finish(static_cast<double>(periods) * integrator.period(), round);
    return round;
  });
}

std::optional<PhasePoint> state_after(const point::Problem& problem, double turns) {
  return with_start(problem, [&]<class I>(I& integrator, motion::State<double> state) -> std::optional<PhasePoint> {
    stepping::NoObserver nobody;
    if (run_for(integrator, state, turns, nobody) != stepping::Outcome::completed) return std::nullopt;
    return PhasePoint{state.x, state.v};
  });
}

std::optional<Sections> run_sections(const point::Problem& problem, std::size_t periods) {
  return with_start(problem, [&]<class I>(I& integrator, motion::State<double> state) -> std::optional<Sections> {
    steady::SectionObserver watch(integrator.stops());
    steady::RepeatFinder repeat(problem.time.tolerance);
    Sections sections;
    while (sections.states.size() < periods && sections.repeats_after == 0) {
      watch.begin_section();
      if (advance_to_section(integrator, state, state.periods, watch) != stepping::Outcome::completed)
        return std::nullopt;
      const double log_area = watch.passage().log_area - 2 * integrator.constants().h * integrator.period();
      sections.log_area += log_area;
      sections.states.push_back({state.x, state.v});
      sections.repeats_after = repeat.add(state.x, state.v, log_area);
    }
    return sections;
  });
}

}  // namespace clatter::attractors
