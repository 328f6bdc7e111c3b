#include "orbit.hpp"

#include <optional>
#include <utility>

namespace verify {

Ball length_of(const Scene& scene, long periods) { return Ball(periods) * scene.period(); }

namespace {

struct Section {
  Start start;
  Vector width;
};

Motion followed(const Certificate& certificate, const Scene& scene, const Section& section, long periods,
                std::vector<Event>& events) {
  Motion motion(scene, section.start, section.width);
  Course course(certificate, motion, motion.start_time() + length_of(scene, periods));
  course.run();
  events = course.events();
  return motion;
}

}  // namespace

Orbit periodic_orbit(const Certificate& certificate, const Scene& scene, long periods) {
  Start start = certificate.start_in_balls();
  const Ball part(0.125);
  const Vector claimed{(part * certificate.start_x.error.ball()).middle(),
                       (part * certificate.start_v.error.ball()).middle()};
  std::vector<Event> events;
  std::optional<Motion> motion;
  const auto pass = [&](const Vector& middle, const Vector& width) -> Passage<Vector, Matrix> {
    start.x = middle.x, start.v = middle.y;
    motion.emplace(followed(certificate, scene, {start, width}, periods, events));
    return {motion->centre(), motion->derivative()};
  };
  const FixedBox<Vector> box = fixed_point(Vector{start.x.middle(), start.v.middle()}, claimed, pass);
  const Matrix derivative = motion->derivative();
  return {box, *std::move(motion), events, derivative};
}

namespace {

/// Motion that rests: its state is exact again, whatever was before.
Orbit exact(Motion motion, const std::vector<Event>& events, const Certificate& certificate) {
  const Ball zero(0);
  const Vector start{certificate.start_x.value.ball(), certificate.start_v.value.ball()};
  return {{start, {zero, zero}, start}, std::move(motion), events, Matrix::zero()};
}

/// Motion that starts with a release and ends with the same one, a whole number of forcing periods later: its state is
/// exact, so it repeats, and not before.
Orbit resting_orbit(const Certificate& certificate, const Scene& scene) {
  std::vector<Event> events;
  Motion motion(scene, certificate.start_in_balls(), {Ball(0), Ball(0)});
  const slong first = motion.turns_of_release();
  Course course(certificate, motion, motion.start_time() + length_of(scene, certificate.periods));
  course.run();
  require_same_release(certificate, course, motion.turns_of_release() - first);
  return exact(std::move(motion), course.events(), certificate);
}

}  // namespace

void require_possible(const Certificate& certificate, Followed& motion, const Ball& end) {
  Course course(certificate, motion, end);
  try {
    course.run();
  } catch (const Undecided&) {  // the events before it are found
  }
  Report report;
  compare_events(certificate, course.events(), report);
  if (report.finding().verdict == Verdict::refuted) throw Refuted(report.first_refuted());
}

void require_same_release(const Certificate& certificate, const Course& course, slong periods) {
  if (!course.ends_with_release() || course.events().back().side != *certificate.released)
    throw Refuted("the motion doesn't end with the release that it starts with");
  if (periods != certificate.periods)
    throw Refuted("periods: claimed " + std::to_string(certificate.periods) + ", found " + std::to_string(periods));
  for (std::size_t i = 0; i + 1 < course.events().size(); ++i)
    if (course.events()[i].kind == Kind::rest && course.events()[i].side == *certificate.released)
      throw Refuted("periods: the stop releases the mass before them, too");
}

std::optional<Response> steady_response(const Certificate& certificate, const Scene& scene) {
  if (scene.is_rough() || certificate.released || !certificate.events.empty()) return std::nullopt;
  const Start start = certificate.start_in_balls();
  const Motion motion(scene, start, {Ball(0), Ball(0)});
  const auto response = motion.flow().response();
  if (!response) return std::nullopt;
  for (const Margin& margin : motion.margins()) {
    const Ball swing = response->amplitude * sqrt(Ball(1) + square(scene.nu * margin.q));
    if (!(margin.of(response->centre, Ball(0)) > swing)) return std::nullopt;
  }
  const auto [sine, cosine] = sin_cos(scene.nu * start.time + scene.phase);
  return Response{motion.is_within_stop(),
                  {response->centre + response->in_phase * sine + response->quadrature * cosine,
                   scene.nu * (response->in_phase * cosine - response->quadrature * sine)},
                  response->centre - response->amplitude,
                  response->centre + response->amplitude,
                  motion.flow().propagator(length_of(scene, certificate.periods))};
}

Orbit claimed_orbit(const Certificate& certificate, const Scene& scene) {
  if (certificate.released) return resting_orbit(certificate, scene);
  const bool held = certificate.events.size() == 1 && certificate.events[0].kind == Kind::rest;
  if (!held) {
    const auto require_one = [&] {
      Motion motion(scene, certificate.start_in_balls(),
                    {certificate.start_x.error.ball(), certificate.start_v.error.ball()});
      require_possible(certificate, motion, motion.start_time() + length_of(scene, certificate.periods));
    };
    return found_or_undecided([&] { return periodic_orbit(certificate, scene, certificate.periods); }, require_one);
  }
  if (certificate.periods != 1) throw Refuted("periods: claimed " + std::to_string(certificate.periods) + ", found 1");
  std::vector<Event> events;  // a stop holds the mass for ever
  Motion motion =
      followed(certificate, scene, {certificate.start_in_balls(), {Ball(0), Ball(0)}}, certificate.periods, events);
  if (!motion.is_resting()) throw Refuted("the stop lets the mass go within the period, and it doesn't come back");
  return exact(std::move(motion), events, certificate);
}

}  // namespace verify
