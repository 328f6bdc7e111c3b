#include "orbit.hpp"

#include <algorithm>
#include <utility>

#include "eigenvalues.hpp"

namespace verify {

Ball length_of(const Scene& scene, long periods) { return Ball(periods) * scene.period(); }

/// The first two coefficients of the characteristic polynomial, as those of a matrix of two numbers.
Matrix with_its_two_eigenvalues(const FourByFour& m) {
  Ball trace(0), minors(0);
  for (std::size_t i = 0; i < 4; ++i) {
    trace = trace + m[i][i];
    for (std::size_t j = 0; j < i; ++j) minors = minors + m[i][i] * m[j][j] - m[i][j] * m[j][i];
  }
  return {trace, -minors, Ball(1), Ball(0)};
}

/// A rest forgets x and x', a press z and z', so that no more than two multipliers are left.
std::optional<std::vector<Vector>> Orbit::multipliers() const {
  const FourByFour derivative = motion->derivative();
  const bool forgets = std::ranges::any_of(events, [](const Event& event) { return verify::holds(event.kind); });
  if (in_flight && !forgets) return eigenvalues(derivative);
  auto found = eigenvalues(in_flight ? with_its_two_eigenvalues(derivative) : of_main(derivative));
  if (found && motion->has_loose_mass()) found->insert(found->end(), 2, Vector{Ball(0), Ball(0)});
  return found;
}

namespace {

Start start_from(const Certificate& certificate, const Four& state) {
  Start start = certificate.start_in_balls();
  start.x = state[0], start.v = state[1], start.z = state[2], start.w = state[3];
  return start;
}
Four claimed_errors(const Certificate& certificate) {
  return {{certificate.start_x.error.ball(), certificate.start_v.error.ball(), certificate.start_z.error.ball(),
           certificate.start_w.error.ball()}};
}

void require_press(const Certificate& certificate, const Motion& motion) {
  if (certificate.pressed && motion.pressing().is_negative())
    throw Refuted("start, pressed: the wall doesn't press the loose mass");
}

/// Follows all motions at most some widths from a state, for one of some parts of the period.
Motion followed(const Certificate& certificate, const Scene& scene, const Four& middle, const Four& width,
                std::vector<Event>& events, int parts = 1) {
  Motion motion(scene, start_from(certificate, middle), width);
  require_press(certificate, motion);
  Course course(certificate, motion, motion.start_time() + length_of(scene, certificate.periods) / Ball(parts));
  course.run();
  events = course.events();
  return motion;
}

/// The map of a period of the claimed events.
class PeriodMap {
 public:
  PeriodMap(const Certificate& certificate, const Scene& scene, Orbit& orbit)
      : certificate_(certificate), scene_(scene), orbit_(orbit) {}

  Passage<Four, FourByFour> operator()(const Four& middle, const Four& half_width) const {
    orbit_.motion.emplace(followed(certificate_, scene_, middle, half_width, orbit_.events));
    if (certificate_.pressed && orbit_.motion->pressed_by() != certificate_.pressed)
      throw Refuted("the motion doesn't end with the press that it starts with");
    return {orbit_.motion->centre(), orbit_.motion->derivative()};
  }
  /// From (x, x') alone.
  Passage<Vector, Matrix> operator()(const Vector& middle, const Vector& half_width) const {
    const auto four = [](const Vector& p) { return Four{{p.x, p.y, Ball(0), Ball(0)}}; };
    const auto [image, derivative] = (*this)(four(middle), four(half_width));
    return {of_main(image), of_main(derivative)};
  }

 private:
  const Certificate& certificate_;
  const Scene& scene_;
  Orbit& orbit_;
};

/// Whether a motion from a state is the periodic one if it is periodic, too: both are in a box that has only one.
bool is_alone_with(const Certificate& certificate, const Scene& scene, const Orbit& orbit, const Four& state) {
  if (orbit.holds(state)) return true;
  Orbit wider;
  const PeriodMap map(certificate, scene, wider);
  const auto in_wider = [&](const auto& box, const auto& there, int times) {
    const auto away = (there - box.start).each([](const Ball& x) { return Ball(4) * abs(x).upper(); });
    auto width = (box.width + away).each([&](const Ball& w) { return (Ball(times) * w).upper(); });
    const auto found = krawczyk(box.start, width, map(box.start, width));
    return found && found->holds(there);
  };
  for (const int times : {1, 16, 256, 4096}) try {
      if (orbit.in_flight ? in_wider(*orbit.in_flight, state, times) : in_wider(*orbit.of_two, of_main(state), times))
        return true;
    } catch (const Undecided&) {
      return false;
    }
  return false;
}

/// The claim of one of some parts of a motion, up to what happens at its end.
Certificate part_of(const Certificate& certificate, const Scene& scene, const std::vector<Event>& events, int parts) {
  Certificate part = certificate;
  const Ball end = certificate.start_time.ball() + length_of(scene, certificate.periods) / Ball(parts);
  std::size_t count = 0;
  while (count < events.size() && events[count].time < end) ++count;
  if (count > 0 && events[count - 1].kind == Kind::chatter && !(events[count - 1].until < end)) --count;
  part.events.resize(std::min(count, part.events.size()));
  return part;
}

}  // namespace

Orbit orbit_near(const Certificate& certificate, const Scene& scene) {
  Orbit orbit;
  const PeriodMap map(certificate, scene, orbit);
  const Start start = certificate.start_in_balls();
  const Ball part(0.125);
  const Four width = claimed_errors(certificate).each([&](const Ball& error) { return (part * error).middle(); });
  if (scene.loose && !certificate.pressed)
    orbit.in_flight = fixed_point(Four{{start.x, start.v, start.z, start.w}}.middle(), width, map);
  else
    orbit.of_two = fixed_point(Vector{start.x, start.v}.middle(), of_main(width), map);
  return orbit;
}

bool repeats_after(const Certificate& certificate, const Scene& scene, const Orbit& orbit, int parts) {
  Certificate shorter = part_of(certificate, scene, orbit.events, parts);
  shorter.periods /= parts;
  return is_alone_with(certificate, scene, orbit, orbit_near(shorter, scene).start());
}

bool returns_mirrored(const Certificate& certificate, const Scene& scene, const Orbit& orbit, const Ball& centre) {
  const Four start = orbit.start();
  const Four width = start.each([](const Ball& x) { return abs(x - x.middle()).upper(); });
  const Certificate half = part_of(certificate, scene, orbit.events, 2);
  std::vector<Event> events;
  std::optional<Motion> motion;
  try {
    motion.emplace(followed(half, scene, start.middle(), width, events, 2));
  } catch (const Refuted&) {
    return false;
  }
  if (certificate.pressed && motion->pressed_by() != opposite(*certificate.pressed)) return false;
  const Four there = motion->state();
  const Ball walls = scene.loose ? scene.loose->wall(Side::lower) + scene.loose->wall(Side::upper) : Ball(0);
  return is_alone_with(certificate, scene, orbit,
                       {{Ball(2) * centre - there[0], -there[1], walls - there[2], -there[3]}});
}

namespace {

/// Motion that rests: its state is exact again, whatever was before.
Orbit exact(Motion motion, const std::vector<Event>& events, const Certificate& certificate) {
  const Vector start{certificate.start_x.value.ball(), certificate.start_v.value.ball()};
  Orbit orbit;
  orbit.of_two = FixedBox<Vector>{start, {Ball(0), Ball(0)}, start};
  orbit.motion.emplace(std::move(motion)), orbit.events = events;
  return orbit;
}

/// Motion that starts with a release and ends with the same one, a whole number of forcing periods later: its state is
/// exact, so it repeats, and not before.
Orbit resting_orbit(const Certificate& certificate, const Scene& scene) {
  Motion motion(scene, certificate.start_in_balls(), Four::zero());
  const auto first = motion.release();
  Course course(certificate, motion, motion.start_time() + length_of(scene, certificate.periods));
  course.run();
  require_same_release(certificate, course, first, motion.release());
  return exact(std::move(motion), course.events(), certificate);
}

}  // namespace

void require_possible(const Certificate& certificate, Motion& motion, const Ball& end) {
  Course course(certificate, motion, end);
  try {
    course.run();
  } catch (const Undecided&) {  // the events before it are found
  }
  Report report;
  compare_events(certificate, course.events(), report);
  if (report.finding().verdict == Verdict::refuted) throw Refuted(report.first_refuted());
}

void require_same_release(const Certificate& certificate, const Course& course, const PhaseOfRelease& first,
                          const PhaseOfRelease& last) {
  if (!course.ends_with_release() || course.events().back().side != *certificate.released ||
      last.number != first.number)
    throw Refuted("the motion doesn't end with the release that it starts with");
  if (const slong periods = last.turns - first.turns; periods != certificate.periods)
    throw Refuted("periods: claimed " + std::to_string(certificate.periods) + ", found " + std::to_string(periods));
  for (std::size_t i = 0; i + 1 < course.events().size(); ++i)
    if (course.events()[i].kind == Kind::rest && course.events()[i].side == *certificate.released &&
        course.events()[i].release == first.number)
      throw Refuted("periods: the stop releases the mass before them, too");
}

std::optional<Response> steady_response(const Certificate& certificate, const Scene& scene) {
  if (scene.loose || scene.is_rough() || certificate.released || !certificate.events.empty()) return std::nullopt;
  const Start start = certificate.start_in_balls();
  const Motion motion(scene, start, Four::zero());
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
  const bool held = !scene.loose && certificate.events.size() == 1 && certificate.events[0].kind == Kind::rest;
  if (!held) {
    const auto require_one = [&] {
      Motion motion(scene, certificate.start_in_balls(), claimed_errors(certificate));
      require_press(certificate, motion);
      require_possible(certificate, motion, motion.start_time() + length_of(scene, certificate.periods));
    };
    return found_or_undecided([&] { return orbit_near(certificate, scene); }, require_one);
  }
  if (certificate.periods != 1) throw Refuted("periods: claimed " + std::to_string(certificate.periods) + ", found 1");
  std::vector<Event> events;  // a stop holds the mass for ever
  const Four start{{certificate.start_x.value.ball(), certificate.start_v.value.ball(), Ball(0), Ball(0)}};
  Motion motion = followed(certificate, scene, start, Four::zero(), events);
  if (!motion.is_resting()) throw Refuted("the stop lets the mass go within the period, and it doesn't come back");
  return exact(std::move(motion), events, certificate);
}

}  // namespace verify
