#include "attractors/exact_run.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "motion/linear_maps.hpp"
#include "point/exact_motion.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/contraction.hpp"

namespace clatter::attractors {
namespace {

using motion::Event;

/// Sections of motion that may repeat, as the search for steady motion takes them.
class Repeats {
 public:
  Repeats(const point::Problem& problem)
      : has_loose_mass_(has_loose_mass(problem.loose)),
        beyond_contact_(problem, period_of(problem.oscillator)),
        of_mass_(problem.time.tolerance),
        of_both_(problem.time.tolerance) {}

  [[nodiscard]] std::size_t add(const SectionState& state, double log_area, const steady::Passage& passage) {
    const auto [x, v, z, w] = beyond_contact_({state.x, state.v, state.z, state.w});
    if (has_loose_mass_) return of_both_.add(x, {v, z, w}, log_area, {passage.size, passage.loose_size});
    return of_mass_.add(x, v, log_area, passage.size);
  }

 private:
  bool has_loose_mass_;
  steady::BeyondContact beyond_contact_;
  steady::RepeatFinder of_mass_;
  steady::BasicRepeatFinder<3> of_both_;
};

/// Adds the contacts of a round over a time in tau. Words tell walls from stops if there may be both.
void add_contacts(const std::vector<Event>& events, double total, bool has_both, Round& round) {
  std::vector<double> begins, ends;  // of contacts, sticks and reversals: between them the mass flies
  for (const Event& event : events) {
    if (event.kind == Event::Kind::separation && !ends.empty()) ends.back() = event.time;
    if (event.kind == Event::Kind::separation || event.kind == Event::Kind::renewal) continue;
    begins.push_back(event.time), ends.push_back(event.time + event.length);
    if (event.side == Side::none) continue;
    round.contacts.push_back({event.time, event.velocity(), event.side, has_both && event.of_wall});
    round.meets_walls = round.meets_walls || event.of_wall;
    round.fastest = std::max(round.fastest, event.speed());
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

point::Problem started(point::Problem problem, const SectionState& state, double phase) {
  problem.start = {state.x, state.v, phase + problem.shaking.lead};
  problem.loose.place = state.z, problem.loose.velocity = state.w;
  return problem;
}

point::Problem floating(point::Problem problem) {
  if (has_loose_friction(problem.loose)) return problem;
  problem.loose = {};
  problem.given.reset();  // which has it
  return problem;
}

std::optional<Round> run_round(const point::Problem& problem, std::size_t periods,
                               std::span<const motion::State<double>> sections) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  recorder.keep_events();
  if (has_loose_mass(problem.loose)) recorder.loose.emplace(problem);
  motion::State<double> start = motion->start();
  if (sections.empty() && motion->begin_cycle(start) != stepping::Outcome::completed) return std::nullopt;
  auto orbit = steady::orbit_from(start, periods, recorder.watch, [&](motion::State<double>& state) {
    const std::int64_t period = state.periods;
    if (!sections.empty()) state = sections[static_cast<std::size_t>(period)], state.periods = period;
    const stepping::Outcome outcome = motion->advance_to_section(state, 0, recorder);
    const bool ends =
        outcome == stepping::Outcome::completed && sections.empty() && period + 1 == static_cast<std::int64_t>(periods);
    return ends ? motion->end_cycle(state, 0, recorder) : outcome;
  });
  if (!orbit) return std::nullopt;
  std::ranges::copy(sections, orbit->states.begin());
  Round round{*orbit, {}};
  for (std::size_t i = 0; i <= periods; ++i) round.states.push_back(section_of(problem, orbit->states[i]));
  if (recorder.loose) round.derivative = recorder.loose->map();
  add_contacts(recorder.events, static_cast<double>(periods) * motion->period(), has_events_of_its_own(problem), round);
  return round;
}

motion::LooseJacobian Round::derivative_in_housing() const {
  motion::LooseJacobian map = *derivative;
  if (!meets_walls) map[2] = map[0];
  return map;
}

SectionState newton_step(const Round& round) {
  if (!round.derivative) {
    const motion::Perturbation step = steady::newton_step(round.orbit.derivative(), round.orbit.gap());
    return {step.x, step.v};
  }
  SectionState gap = round.gap();
  if (!round.meets_walls) gap.z = 0;
  const auto step =
      motion::change_of_fixed_point(round.derivative_in_housing(), {gap.x, gap.v, gap.x + gap.z, gap.v + gap.w});
  const motion::LooseState<double>& loose = round.orbit.states[round.orbit.periods].loose;
  if (loose.pressed && loose.place == 0) return {step[0], step[1], gap.z, gap.w};  // it stays on its wall
  return {step[0], step[1], round.meets_walls ? step[2] - step[0] : 0, loose.pressed ? 0 : step[3] - step[1]};
}

double spectral_radius(const Round& round) {
  return round.derivative ? std::abs(motion::multipliers_of(round.derivative_in_housing())[0])
                          : steady::spectral_radius(round.orbit.derivative());
}

std::string word_of(const point::Problem& problem, const Round& round) {
  const motion::State<double>& first = round.orbit.states[0];
  const Side within = move_by_themselves(problem.stops) ? first.within : soft_stop_beyond(problem.stops, first.x);
  return observables::ImpactWord::word_of(round.contacts, within);
}

std::optional<SectionState> state_after(const point::Problem& problem, double turns) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  motion::State<double> state = motion->start();
  if (motion->run_for(state, turns, recorder) != stepping::Outcome::completed) return std::nullopt;
  return section_of(problem, state);
}

std::optional<Sections> run_sections(const point::Problem& problem, std::size_t periods) {
  const auto motion = point::ExactMotion::of(problem);
  point::MotionRecorder recorder(motion->stops());
  motion::State<double> state = motion->start();
  Repeats repeat(problem);
  Sections sections;
  while (sections.states.size() < periods && sections.repeats_after == 0) {
    recorder.watch.begin_section();
    if (motion->advance_to_section(state, state.periods, recorder) != stepping::Outcome::completed) return std::nullopt;
    const double log_area = recorder.watch.passage().log_area - 2 * problem.oscillator.damping * motion->period();
    sections.log_area += log_area;
    sections.meets_walls = sections.meets_walls || recorder.watch.passage().meets_wall;
    sections.states.push_back(section_of(problem, state));
    sections.repeats_after = repeat.add(sections.states.back(), log_area, recorder.watch.passage());
  }
  return sections;
}

}  // namespace clatter::attractors
