#include "orbit.hpp"

#include <cmath>
#include <utility>

namespace verify {

Ball length_of(const Scene& scene, long periods) { return Ball(static_cast<double>(periods)) * scene.period(); }

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

Matrix less_identity(const Matrix& m) { return {m.a - Ball(1), m.b, m.c, m.d - Ball(1)}; }

}  // namespace

namespace {

/// Krawczyk's operator on a box about a start; nothing if it doesn't map the box into itself, and then a wider box.
std::optional<Orbit> proved_within(const Certificate& certificate, const Scene& scene, const Start& start, long periods,
                                   Vector& width) {
  std::vector<Event> events;
  Motion motion = followed(certificate, scene, {start, width}, periods, events);
  const Matrix derivative = motion.derivative(), slope = less_identity(derivative);
  const Matrix inverse = slope.middle().inverse().middle();
  const Vector from = -(inverse * (motion.centre() - Vector{start.x, start.v}));
  Matrix rest = inverse * slope;
  rest = {Ball(1) - rest.a, -rest.b, -rest.c, Ball(1) - rest.d};
  const Vector box{Ball::around_zero(width.x), Ball::around_zero(width.y)}, image = from + rest * box;
  if (!image.x.is_finite() || !image.y.is_finite()) throw Undecided("Krawczyk's operator");
  if (box.x.holds_inside(image.x) && box.y.holds_inside(image.y))
    return Orbit{std::move(motion),  events, derivative,
                 {start.x, start.v}, width,  {start.x + image.x, start.v + image.y}};
  width = {Ball(4) * abs(image.x).upper(), Ball(4) * abs(image.y).upper()};
  return std::nullopt;
}

}  // namespace

Orbit periodic_orbit(const Certificate& certificate, const Scene& scene, long periods) {
  Start start = certificate.start_in_balls();
  start.x = start.x.middle(), start.v = start.v.middle();
  if (bits == 64) {  // a claim is mostly much better than its error
    const Ball part(0.125);
    Vector width{(part * certificate.start_x.error.ball()).middle(),
                 (part * certificate.start_v.error.ball()).middle()};
    try {
      if (auto orbit = proved_within(certificate, scene, start, periods, width)) return *std::move(orbit);
    } catch (const Undecided&) {  // Newton's steps may lead to a smaller box
    }
  }
  const Vector zero{Ball(0), Ball(0)};
  Vector width = zero;
  for (slong precision = bits; precision >= 64; precision /= 2) {  // each step doubles the digits
    std::vector<Event> events;
    const Motion thin = followed(certificate, scene, {start, zero}, periods, events);
    const Vector gap = thin.state() - Vector{start.x, start.v};
    const Vector step = less_identity(thin.derivative()).middle().inverse().middle() * gap.middle();
    if (!step.x.is_finite() || !step.y.is_finite()) throw Undecided("Newton's step");
    start.x = (start.x - step.x).middle(), start.v = (start.v - step.y).middle();
    const double least = std::ldexp(1.0, -static_cast<int>(bits) + 12);
    const auto wide = [&](const Ball& by, const Ball& at) {
      return Ball(std::abs(by.near()) / 512 + least * (std::abs(at.near()) + 1e-3));
    };
    width = {wide(step.x, start.x), wide(step.y, start.v)};
  }
  for (int attempt = 0; attempt < 5; ++attempt)
    if (auto orbit = proved_within(certificate, scene, start, periods, width)) return *std::move(orbit);
  throw Undecided("whether there is a periodic motion: Krawczyk's operator doesn't contract");
}

namespace {

/// Motion that rests: its state is exact again, whatever was before.
Orbit exact(Motion motion, const std::vector<Event>& events, const Certificate& certificate) {
  const Ball zero(0);
  const Vector start{certificate.start_x.value.ball(), certificate.start_v.value.ball()};
  return {std::move(motion), events, {zero, zero, zero, zero}, start, {zero, zero}, start};
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

namespace {

/// Refutes a claim if no motion that starts within its errors meets the claimed events.
void require_possible(const Certificate& certificate, const Scene& scene) {
  Motion motion(scene, certificate.start_in_balls(),
                {certificate.start_x.error.ball(), certificate.start_v.error.ball()});
  Course course(certificate, motion, motion.start_time() + length_of(scene, certificate.periods));
  try {
    course.run();
  } catch (const Undecided&) {  // the events before it are found
  }
  Report report;
  compare_events(certificate, course.events(), report);
  if (report.finding().verdict == Verdict::refuted) throw Refuted(report.first_refuted());
}

}  // namespace

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
  return Response{{response->centre + response->in_phase * sine + response->quadrature * cosine,
                   scene.nu * (response->in_phase * cosine - response->quadrature * sine)},
                  response->centre - response->amplitude,
                  response->centre + response->amplitude,
                  motion.flow().propagator(length_of(scene, certificate.periods))};
}

Orbit claimed_orbit(const Certificate& certificate, const Scene& scene) {
  if (certificate.released) return resting_orbit(certificate, scene);
  const bool held = certificate.events.size() == 1 && certificate.events[0].kind == Kind::rest;
  if (!held) {
    try {
      return periodic_orbit(certificate, scene, certificate.periods);
    } catch (const Undecided&) {
      require_possible(certificate, scene);
      throw;
    } catch (const Refuted& near) {  // of motion from the middle of the claimed errors
      require_possible(certificate, scene);
      throw Undecided(near.what());
    }
  }
  if (certificate.periods != 1) throw Refuted("periods: claimed " + std::to_string(certificate.periods) + ", found 1");
  std::vector<Event> events;  // a stop holds the mass for ever
  Motion motion =
      followed(certificate, scene, {certificate.start_in_balls(), {Ball(0), Ball(0)}}, certificate.periods, events);
  if (!motion.was_exact()) throw Refuted("the mass doesn't rest for ever");
  return exact(std::move(motion), events, certificate);
}

}  // namespace verify
