#include "certificates/certified_point.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <utility>

#include "certificates/certified_in_housing.hpp"
#include "certificates/claims.hpp"
#include "certificates/error_bounds.hpp"
#include "certificates/recorded_motion.hpp"

namespace clatter::certificates {
namespace {

using point::PointResult;
using point::Problem;
using Kind = motion::Event::Kind;

/// The instant at which the certificate of a periodic motion begins.
struct PeriodStart {
  double time = 0.0;           ///< tau since a section, 0 ... duration
  Side released = Side::none;  ///< the stop that releases the mass then, so that the state is known; none: in flight
  bool rests_for_ever = false;
};

/// Whether the mass flies free of the stops after an event.
bool begins_flight(const RecordedEvent<2>& event) { return event.kind != Kind::touch && event.kind != Kind::renewal; }

/// The rest that ends in a release before the section or at it; of several the first.
std::optional<PeriodStart> release_of(const RecordedMotion<2>& motion) {
  const double same = 1e-12 * motion.duration;
  const auto& events = motion.events;
  const auto rest = std::ranges::find_if(events, &RecordedEvent<2>::is_rest);
  if (rest == events.end()) return std::nullopt;
  if (rest->end() < motion.duration - same) return PeriodStart{rest->end(), rest->side};
  if (rest->time <= same) return PeriodStart{.time = 0.0, .released = Side::none, .rests_for_ever = true};
  return PeriodStart{0.0, rest->side};
}

/// The release from a rest of a periodic motion, if it has one, else the middle of its longest flight, clear of stops.
PeriodStart start_of_period(const RecordedMotion<2>& from_section) {
  if (const auto release = release_of(from_section)) return *release;
  const auto& events = from_section.events;
  double longest = 0.0, middle = 0.0;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const double next = i + 1 < events.size() ? events[i + 1].time : events[0].time + from_section.duration;
    if (!begins_flight(events[i]) || next - events[i].end() <= longest) continue;
    longest = next - events[i].end(), middle = (events[i].end() + next) / 2;
  }
  return {std::fmod(middle, from_section.duration)};
}

/// A problem that observes what a certificate claims, and nothing else.
Problem observed(Problem problem) {
  problem.observe = {};
  problem.observe.extrema = true;
  if (problem.time.mode == steady::Mode::steady) problem.observe.stability = problem.observe.word = true;
  if (!has_loose_mass(problem.loose)) return problem;
  problem.observe.frame = Frame::absolute;  // in which it is computed
  problem.observe.word_walls = problem.observe.word && has_events_of_its_own(problem);
  return problem;
}

Problem from(Problem problem, double x, double v, double phase) {
  problem.start = {x, v, phase};
  return problem;
}

bool is_cut(const RecordedMotion<2>& motion) {
  return !motion.events.empty() && motion.events.back().kind == Kind::chatter &&
         motion.events.back().end() >= motion.duration * (1 - 1e-12);
}

void certify_transient(const Problem& problem, const PointResult& result, CertifiedPoint& point) {
  if (has_loose_mass(problem.loose)) return certify_transient_in_housing(problem, result, point);
  auto motion = recorded(problem, problem.time.duration / period_of(problem.oscillator));
  if (!motion || is_cut(*motion)) {
    point.without = motion ? Without::cut_chatter : Without::rounding;
    return;
  }
  certify_run<ErrorBounds>(problem, std::move(*motion), result, point);
}

/// The problem of a periodic motion that begins `start.time` after a section.
std::optional<Problem> begun(const Problem& section, const PeriodStart& start) {
  const double turns = start.time / period_of(section.oscillator), part = turns - std::floor(turns);
  const double phase = section.start.phase + 2 * pi<double>() * part;
  if (start.released != Side::none)
    return from(section, start.released == Side::upper ? section.stops.upper : section.stops.lower, 0.0, phase);
  const auto way = recorded(section, turns);
  return way ? std::optional(from(section, way->end.x, way->end.v, phase)) : std::nullopt;
}

/// Whether a motion returns to its start.
bool returns(const Problem& start, const RecordedMotion<2>& motion) {
  constexpr double same = 1e-7;
  const double x = start.start.displacement, v = start.start.velocity;
  return std::abs(motion.end.x - x) + std::abs(motion.end.v - v) <= same * (std::abs(x) + std::abs(v));
}

/// Newton's step to the start that a motion returns to; false if it is none.
bool step_to_return(Start& start, const RecordedMotion<2>& motion) {
  const auto& m = motion.derivative;
  const double x = motion.end.x - start.displacement, v = motion.end.v - start.velocity;
  const double determinant = (1 - m[0]) * (1 - m[3]) - m[1] * m[2];
  const double by_x = ((1 - m[3]) * x + m[1] * v) / determinant, by_v = (m[2] * x + (1 - m[0]) * v) / determinant;
  constexpr double small = 1e-7;  // else rounding makes it
  const double size = std::abs(start.displacement) + std::abs(start.velocity);
  if (!(std::abs(by_x) + std::abs(by_v) <= small * size) || (by_x == 0 && by_v == 0)) return false;
  start.displacement += by_x, start.velocity += by_v;
  return true;
}

/// States what is claimed of a period that begins at a time after a section, with the start of its problem.
void certify_from(const Problem& at_start, const PeriodStart& start, const RecordedMotion<2>& motion,
                  double section_phase, const PointResult& result, CertifiedPoint& point) {
  const double time = std::fmod(start.time, period_of(at_start.oscillator));
  certify_period<ErrorBounds>(
      at_start, time, motion, section_phase, result, point, [&](Certificate& certificate, const ErrorBounds& bounds) {
        const auto multiplier = [&](std::size_t i) {
          return std::complex<double>(result.multiplier_re[i], result.multiplier_im[i]);
        };
        const bool rests = start.released != Side::none || start.rests_for_ever;
        certificate.released = start.released;
        certificate.period->multipliers =
            rests ? std::vector<ClaimedMultiplier>(2) : bounds.claimed({multiplier(0), multiplier(1)});
      });
}

/// Certifies, in 50 digits, periodic motion in which double loses its way from one rest to the next. From a release
/// there is one motion alone, so it is this one if this rests there.
void certify_from_release(const Problem& section, const PointResult& result, CertifiedPoint& point) {
  for (const auto& [side, rests] : {std::pair(Side::lower, "L*"), std::pair(Side::upper, "U*")}) {
    if (result.impact_word.find(rests) == std::string::npos) continue;
    PeriodStart start{.released = side};
    const auto motion = recorded_from_release(section, side, result.observed_turns, start.time);
    const auto at_start = motion ? begun(section, start) : std::nullopt;
    if (at_start) return certify_from(*at_start, start, *motion, section.start.phase, result, point);
  }
}

void certify_in_double(const Problem& section, const PointResult& result, CertifiedPoint& point) {
  const auto whole = recorded(section, result.observed_turns);
  if (!whole) return;
  const PeriodStart start = start_of_period(*whole);
  auto at_start = begun(section, start);
  if (!at_start) return;
  auto motion = recorded(*at_start, result.observed_turns, start.released);
  if (!motion || !returns(*at_start, *motion)) return;
  if (start.released == Side::none && step_to_return(at_start->start, *motion))
    motion = recorded(*at_start, result.observed_turns);
  if (motion) certify_from(*at_start, start, *motion, section.start.phase, result, point);
}

void certify_periodic(const Problem& problem, const PointResult& result, CertifiedPoint& point) {
  if (has_loose_mass(problem.loose)) return certify_periodic_in_housing(problem, result, point);
  point.without = Without::rounding;
  const Problem section = from(problem, result.end.displacement, result.end.velocity, result.end.phase);
  certify_in_double(section, result, point);
  if (point.without == Without::rounding) certify_from_release(section, result, point);
}

/// Whether the format has a claim of a chatter under a law of restitution: one that goes on for ever, and on a wall one
/// in which R is the same at all speeds.
bool is_claimed(const Restitution<double>& law, bool of_wall) {
  if (law.is_constant()) return true;
  const bool is_same = !law.is_power() && law.at_rest().slope == 0;
  return of_wall ? is_same && law.share_at_rest() > 0 : !is_same || law.share_at_rest() > 0;
}

CertifiedPoint with_claimed_chatters(CertifiedPoint point) {
  if (!point.certificate) return point;
  const Scene& scene = point.certificate->scene;
  const auto has_no_claim = [&](const ClaimedEvent& event) {
    const bool is_lower = event.side == Side::lower;
    const auto& of_wall = is_lower ? scene.loose.restitution_lower : scene.loose.restitution_upper;
    return event.kind == Kind::chatter &&
           !is_claimed(event.of_wall ? of_wall : law_of(scene.stops, event.side), event.of_wall);
  };
  if (std::ranges::any_of(point.certificate->events, has_no_claim))
    point.without = Without::law_of_speed, point.certificate.reset();
  return point;
}

/// The frame of the extrema that a certificate states.
Frame stated_frame(const Problem& problem) { return has_loose_mass(problem.loose) ? Frame::absolute : Frame::relative; }

/// The name of a result that was found otherwise by the run that a certificate is made of; empty: none.
std::string difference(const KnownResult& known, const PointResult& stated) {
  constexpr double same = 1e-9;
  if (stated.status != known.status) return "status";
  if (stated.observed_turns != known.periods) return "period_ratio";
  if (!known.word.empty() && stated.impact_word != known.word) return "impact_word";
  const double most = same * std::max(std::abs(stated.x_min), std::abs(stated.x_max));
  if (std::abs(known.x_min - stated.x_min) > most) return "x_min";
  return std::abs(known.x_max - stated.x_max) > most ? "x_max" : "";
}

/// A problem that begins where a run of it has ended.
Problem from_end(Problem problem, const point::End& end) {
  problem.start = end;
  if (has_loose_mass(problem.loose)) problem.loose.place = end.loose_place, problem.loose.velocity = end.loose_velocity;
  return problem;
}

}  // namespace

KnownResult::KnownResult(const Problem& problem, const PointResult& result)
    : status(result.status), periods(result.observed_turns), end(result.end) {
  if (!problem.observe.word_sticks) word = result.impact_word;
  if (problem.observe.frame == stated_frame(problem) || !is_shaken(problem.shaking))
    x_min = result.x_min, x_max = result.x_max;
}

CertifiedPoint certified_period(const Problem& problem, const PointResult& result) {
  CertifiedPoint point{.status = result.status};
  if (!is_driven(problem.oscillator))
    point.without = Without::force;
  else if (problem.oscillator.shape.is_in_pieces())
    point.without = Without::force_shape;
  else if (move_by_themselves(problem.stops))
    point.without = Without::stop_motion;
  else
    certify_periodic(problem, result, point);
  return with_claimed_chatters(std::move(point));
}

CertifiedPoint certified(const Problem& problem, const KnownResult& known, point::ThreadScratch& scratch) {
  using steady::Status;
  CertifiedPoint point{.status = known.status};
  if (known.status == Status::grazing) point.without = Without::graze;
  if (known.status != Status::periodic && known.status != Status::transient) return point;
  if (has_soft_wall(problem.loose) || problem.oscillator.shape.is_in_pieces()) {
    point.without = has_soft_wall(problem.loose) ? Without::soft_wall : Without::force_shape;
    return point;
  }
  if (move_by_themselves(problem.stops)) {
    point.without = Without::stop_motion;
    return point;
  }
  const bool is_steady = known.status == Status::periodic;
  if (is_steady && problem.oscillator.forcing == 0) {
    point.without = Without::force;
    return point;
  }
  const Problem plain = observed(is_steady ? from_end(problem, known.end) : problem);
  const PointResult result = point::run_point(plain, scratch);
  if (is_steady && result.status == Status::grazing) {  // a run looks for grazes only if derivatives are asked for
    point.without = Without::graze;
  } else if (is_steady && result.status == Status::undecided) {
    point.without = Without::rounding;
  } else if (point.differs = difference(known, result); !point.differs.empty()) {
    return point;
  } else if (is_steady) {
    return certified_period(plain, result);
  } else {
    certify_transient(plain, result, point);
  }
  return with_claimed_chatters(std::move(point));
}

}  // namespace clatter::certificates
