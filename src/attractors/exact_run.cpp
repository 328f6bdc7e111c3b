#include "attractors/exact_run.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "point/exact_motion.hpp"

namespace clatter::attractors {
namespace {

using motion::Event;

/// Adds the contacts of a round over a time in tau.
void add_contacts(const std::vector<Event>& events, double total, Round& round) {
  std::vector<double> begins, ends;  // of contacts, sticks and reversals: between them the mass flies
  for (const Event& event : events) {
    if (event.kind == Event::Kind::separation && !ends.empty()) ends.back() = event.time;
    if (event.kind == Event::Kind::separation || event.kind == Event::Kind::renewal) continue;
    begins.push_back(event.time), ends.push_back(event.time + event.length);
    if (event.side == Side::none) continue;
    round.contacts.push_back({event.time, event.velocity, event.side});
    round.fastest = std::max(round.fastest, std::abs(event.velocity));
  }
  double longest = 0.0;
  for (std::size_t i = 0; i < ends.size(); ++i) {
    const double next = i + 1 < ends.size() ? begins[i + 1] : begins[0] + total;
    if (next - ends[i] <= longest) continue;
    longest = next - ends[i];
    round.middle_of_flight = std::fmod((ends[i] + next) / 2, total) / total * static_cast<double>(round.orbit.periods);
  }
}

}  // namespace

point::Problem started(point::Problem problem, const PhasePoint& state, double phase) {
  problem.start = {state.x, state.v, phase + problem.shaking.lead};
  return problem;
}

std::optional<Round> run_round(const point::Problem& problem, std::size_t periods,
                               std::span<const motion::State<double>> sections) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  auto orbit = steady::orbit_from(motion->start(), periods, recorder.watch, [&](motion::State<double>& state) {
    const std::int64_t period = state.periods;
    if (!sections.empty()) state = sections[static_cast<std::size_t>(period)], state.periods = period;
    return motion->advance_to_section(state, 0, recorder);
  });
  if (!orbit) return std::nullopt;
  std::ranges::copy(sections, orbit->states.begin());
  Round round{*orbit, {}};
  add_contacts(recorder.events, static_cast<double>(periods) * motion->period(), round);
  return round;
}

std::string word_of(const point::Problem& problem, const Round& round) {
  return observables::ImpactWord::word_of(round.contacts, soft_stop_beyond(problem.stops, round.orbit.states[0].x));
}

std::optional<PhasePoint> state_after(const point::Problem& problem, double turns) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  motion::State<double> state = motion->start();
  if (motion->run_for(state, turns, recorder) != stepping::Outcome::completed) return std::nullopt;
  return PhasePoint{state.x, state.v};
}

std::optional<Sections> run_sections(const point::Problem& problem, std::size_t periods) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  motion::State<double> state = motion->start();
  steady::RepeatFinder repeat(problem.time.tolerance);
  Sections sections;
  while (sections.states.size() < periods && sections.repeats_after == 0) {
    recorder.watch.begin_section();
    if (motion->advance_to_section(state, state.periods, recorder) != stepping::Outcome::completed) return std::nullopt;
    const double log_area = recorder.watch.passage().log_area - 2 * problem.oscillator.damping * motion->period();
    sections.log_area += log_area;
    sections.states.push_back({state.x, state.v});
    sections.repeats_after = repeat.add(state.x, state.v, log_area);
  }
  return sections;
}

}  // namespace clatter::attractors
