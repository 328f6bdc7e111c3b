#include <utility>

#include "claims.hpp"
#include "eigenvalues.hpp"
#include "loose_motion.hpp"

namespace verify {
namespace {

/// A proved periodic motion with a loose mass, the only one whose state at the start is in a box. If a wall presses the
/// loose mass at the start, that box is of x and x' alone.
struct OrbitInHousing {
  std::optional<FixedBox<Four>> in_flight{};
  std::optional<FixedBox<Vector>> pressed{};
  std::optional<LooseMotion> motion{};
  std::vector<Event> events{};

  [[nodiscard]] const Ball& x() const { return in_flight ? in_flight->first[0] : pressed->first.x; }
  [[nodiscard]] const Ball& v() const { return in_flight ? in_flight->first[1] : pressed->first.y; }
  /// Whether a state is in the box.
  [[nodiscard]] bool holds(const Four& state) const {
    return in_flight ? in_flight->holds(state) : pressed->holds({state[0], state[1]});
  }
  /// The start in balls: all states of the box that may be it, by their middle and half widths.
  [[nodiscard]] std::pair<Four, Four> start() const {
    const Four first = in_flight ? in_flight->first : Four{{pressed->first.x, pressed->first.y, Ball(0), Ball(0)}};
    const auto half_width = [](const Ball& x) { return abs(x - x.middle()).upper(); };
    return {first.middle(), first.each(half_width)};
  }
};

Matrix of_main(const FourByFour& m) { return {m[0][0], m[0][1], m[1][0], m[1][1]}; }

Start start_from(const Certificate& certificate, const Four& state) {
  Start start = certificate.start_in_balls();
  start.x = state[0], start.v = state[1], start.z = state[2], start.w = state[3];
  return start;
}
Ball end_of(const Certificate& certificate, const Scene& scene, const Ball& parts) {
  return certificate.start_time.ball() + length_of(scene, certificate.periods) / parts;
}

void require_press(const Certificate& certificate, const LooseMotion& motion) {
  if (certificate.pressed && motion.pressing().is_negative())
    throw Refuted("start, pressed: the wall doesn't press the loose mass");
}

/// The map of a period of the claimed events.
class PeriodMap {
 public:
  PeriodMap(const Certificate& certificate, const Scene& scene, OrbitInHousing& orbit)
      : certificate_(certificate), scene_(scene), orbit_(orbit) {}

  /// From (x, x', z, z') in flight.
  Passage<Four, FourByFour> operator()(const Four& middle, const Four& half_width) const {
    follow(middle, half_width);
    return {orbit_.motion->centre(), orbit_.motion->derivative()};
  }
  /// From (x, x') while a wall presses the loose mass.
  Passage<Vector, Matrix> operator()(const Vector& middle, const Vector& half_width) const {
    follow({{middle.x, middle.y, Ball(0), Ball(0)}}, {{half_width.x, half_width.y, Ball(0), Ball(0)}});
    const Four image = orbit_.motion->centre();
    return {{image[0], image[1]}, of_main(orbit_.motion->derivative())};
  }

 private:
  void follow(const Four& middle, const Four& width) const {
    LooseMotion& motion = orbit_.motion.emplace(scene_, start_from(certificate_, middle), width);
    require_press(certificate_, motion);
    Course course(certificate_, motion, end_of(certificate_, scene_, Ball(1)));
    course.run();
    if (certificate_.pressed && !(motion.is_resting() && motion.wall() == *certificate_.pressed))
      throw Refuted("the motion doesn't end with the press that it starts with");
    orbit_.events = course.events();
  }

  const Certificate& certificate_;
  const Scene& scene_;
  OrbitInHousing& orbit_;
};

Four claimed_errors(const Certificate& certificate) {
  return {{certificate.start_x.error.ball(), certificate.start_v.error.ball(), certificate.start_z.error.ball(),
           certificate.start_w.error.ball()}};
}

/// The periodic motion near the claimed start.
OrbitInHousing orbit_near(const Certificate& certificate, const Scene& scene) {
  OrbitInHousing orbit;
  const PeriodMap map(certificate, scene, orbit);
  const Start start = certificate.start_in_balls();
  const Ball part(0.125);
  const Four width = claimed_errors(certificate).each([&](const Ball& error) { return (part * error).middle(); });
  if (certificate.pressed)
    orbit.pressed = fixed_point(Vector{start.x, start.v}.middle(), Vector{width[0], width[1]}, map);
  else
    orbit.in_flight = fixed_point(Four{{start.x, start.v, start.z, start.w}}.middle(), width, map);
  return orbit;
}

/// Whether a motion from a state is the periodic one if it is periodic, too: both are in a box that has only one.
bool is_alone_with(const Certificate& certificate, const Scene& scene, const OrbitInHousing& orbit, const Four& state) {
  if (orbit.holds(state)) return true;
  OrbitInHousing wider;
  const PeriodMap map(certificate, scene, wider);
  const auto in_wider = [&](const auto& box, const auto& there, const Ball& times) {
    auto width = box.width.each([&](const Ball& w) { return (times * w).upper(); });
    const auto found = krawczyk(box.start, width, map(box.start, width));
    return found && found->holds(there);
  };
  for (const int times : {16, 256, 4096, 65536}) try {
      if (orbit.in_flight ? in_wider(*orbit.in_flight, state, Ball(times))
                          : in_wider(*orbit.pressed, Vector{state[0], state[1]}, Ball(times)))
        return true;
    } catch (const Undecided&) {
      return false;
    }
  return false;
}

OrbitInHousing claimed_orbit_in_housing(const Certificate& certificate, const Scene& scene) {
  const auto require_one = [&] {
    LooseMotion motion(scene, certificate.start_in_balls(), claimed_errors(certificate));
    require_press(certificate, motion);
    require_possible(certificate, motion, end_of(certificate, scene, Ball(1)));
  };
  return found_or_undecided([&] { return orbit_near(certificate, scene); }, require_one);
}

/// The claim of one of some parts of a motion, up to what happens at its end.
Certificate part_of(const Certificate& certificate, const Scene& scene, const std::vector<Event>& events, int parts) {
  Certificate part = certificate;
  const Ball end = end_of(certificate, scene, Ball(parts));
  std::size_t count = 0;
  while (count < events.size() && events[count].time < end) ++count;
  if (count > 0 && events[count - 1].kind == Kind::chatter && !(events[count - 1].until < end)) --count;
  part.events.resize(std::min(count, part.events.size()));
  return part;
}

/// Whether half a period takes the motion to its mirror image: the only periodic motion in the box is that of its
/// mirror image, too.
bool returns_mirrored(const Certificate& certificate, const Scene& scene, const OrbitInHousing& orbit,
                      const Ball& centre) {
  const Certificate half = part_of(certificate, scene, orbit.events, 2);
  const auto [middle, width] = orbit.start();
  LooseMotion motion(scene, start_from(certificate, middle), width);
  Course course(half, motion, end_of(certificate, scene, Ball(2)));
  try {
    course.run();
  } catch (const Refuted&) {
    return false;
  }
  if (certificate.pressed && !(motion.is_resting() && motion.wall() == opposite(*certificate.pressed))) return false;
  const Four there = motion.state();
  const Ball walls = scene.loose->wall(Side::lower) + scene.loose->wall(Side::upper);
  return is_alone_with(certificate, scene, orbit,
                       {{Ball(2) * centre - there[0], -there[1], walls - there[2], -there[3]}});
}

/// The four multipliers; of motion that starts with a press two are 0.
std::optional<std::vector<Vector>> multipliers_of(const OrbitInHousing& orbit) {
  const FourByFour derivative = orbit.motion->derivative();
  if (orbit.in_flight) return eigenvalues(derivative);
  auto found = eigenvalues(of_main(derivative));
  if (found) found->insert(found->end(), 2, Vector{Ball(0), Ball(0)});
  return found;
}

}  // namespace

void check_in_housing(const Certificate& certificate, const Scene& scene, Report& report) {
  const OrbitInHousing orbit = claimed_orbit_in_housing(certificate, scene);
  compare_events(certificate, orbit.events, report);
  report.compare("start, x", orbit.x(), certificate.start_x);
  report.compare("start, v", orbit.v(), certificate.start_v);
  if (orbit.in_flight) {
    report.compare("start, z", orbit.in_flight->first[2], certificate.start_z);
    report.compare("start, w", orbit.in_flight->first[3], certificate.start_w);
  }
  compare_extrema(certificate, *orbit.motion, orbit.events, scene, report);
  check_multipliers(certificate, multipliers_of(orbit), report);
  const Cycle cycle(orbit.events, length_of(scene, certificate.periods), certificate.pressed.has_value());
  check_word(certificate, cycle, scene, orbit.x(), report);
  const auto repeats_after = [&](long parts) {
    Certificate shorter = part_of(certificate, scene, orbit.events, static_cast<int>(parts));
    shorter.periods /= parts;
    const auto [start, width] = orbit_near(shorter, scene).start();
    return is_alone_with(certificate, scene, orbit,
                         start + width.each([](const Ball& w) { return Ball::around_zero(w); }));
  };
  check_smallest_period(certificate, cycle, repeats_after, report);
  const auto is_mirrored = [&](const Ball& centre) { return returns_mirrored(certificate, scene, orbit, centre); };
  check_symmetry(certificate, scene, cycle, is_mirrored, report);
}

}  // namespace verify
