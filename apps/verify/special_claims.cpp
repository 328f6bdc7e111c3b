#include "claims.hpp"

#include <algorithm>
#include <cmath>

#include "curve.hpp"

namespace verify {
namespace {

/// det(M - s): 0 if s is a multiplier.
Ball distance_to(int multiplier, const Matrix& m) {
  const Ball s(multiplier);
  return (m.a - s) * (m.d - s) - m.b * m.c;
}

bool is_contact(const Event& event) { return event.kind == Kind::impact || event.kind == Kind::touch; }

/// How a velocity changes along the curve.
Ball along(const Place& direction, const Event& event) {
  return dot({event.slopes.by_x, event.slopes.by_v, event.slopes.by_parameter}, direction);
}

/// The derivative of the largest impact speed along the curve.
Ball growth_of_speed(const Curve::Passage& passage, const Place& direction) {
  const auto is_chatter = [](const Event& event) { return event.kind == Kind::chatter; };
  if (std::ranges::any_of(passage.events, is_chatter)) throw Undecided("how fast the impacts within a chatter are");
  const Event* fastest = nullptr;
  for (const Event& event : passage.events)
    if (is_contact(event) && (fastest == nullptr || abs(event.v).near() > abs(fastest->v).near())) fastest = &event;
  if (fastest == nullptr) throw Refuted("kind: claimed maximum impact_speed, found no impact");
  for (const Event& event : passage.events)
    if (is_contact(event) && &event != fastest && !(abs(event.v) < abs(fastest->v)))
      throw Undecided("which impact is the fastest");
  return Ball(fastest->v.is_negative() ? -1 : 1) * along(direction, *fastest);
}

/// The derivative of the energy lost in impacts per tau, (1/T) sum of (1 - R^2) v^2/2, along the curve.
Ball growth_of_power(const Curve::Passage& passage, const Place& direction, const MovingScene& scene) {
  Dual lost(0);
  for (const Event& event : passage.events) {
    if (event.kind != Kind::impact) throw Undecided("the energy that is lost otherwise than in impacts");
    const Dual v(event.v, along(direction, event));
    const BasicStop<Dual>& stop = scene.stop(event.side);
    const Dual R(stop.R.value, stop.R.slope * direction.p);
    lost = lost + (Dual(1) - R * R) * v * v / Dual(2);
  }
  const Dual nu(scene.nu.value, scene.nu.slope * direction.p);  // the period is a number of turns over it
  return (lost * nu).slope;
}

Ball gap_of_graze(const std::vector<Event>& events) {
  const auto is_graze = [](const Event& event) { return event.kind == Kind::graze; };
  if (std::ranges::count_if(events, is_graze) != 1) throw Undecided("a graze of several impacts at once");
  return std::ranges::find_if(events, is_graze)->gap;
}

/// A quantity that is 0 at a special point, and changes its sign there.
Ball condition(const Curve& curve, SpecialKind kind, const Place& at) {
  const Curve::Passage passage = curve.pass(at);
  switch (kind) {
    case SpecialKind::fold:
      return distance_to(1, passage.derivative);
    case SpecialKind::flip:
    case SpecialKind::symmetry_breaking:
      return distance_to(-1, passage.derivative);
    case SpecialKind::graze:
      return gap_of_graze(passage.events);
    case SpecialKind::impact_speed:
      return growth_of_speed(passage, curve.direction(passage));
    default:
      return growth_of_power(passage, curve.direction(passage), curve.scene(at.p));
  }
}

int sign_of(const Ball& y) { return y.is_positive() ? 1 : y.is_negative() ? -1 : 0; }

/// A part of the curve at whose ends the condition has different signs, as short as can be told.
std::optional<Ball> part_with_change(const Curve& curve, SpecialKind kind) {
  const auto condition_at = [&](const Ball& distance) { return condition(curve, kind, curve.at(distance)); };
  const Ball to = curve.reach().middle(), from = -to;
  const Ball first = condition_at(from), last = condition_at(to);
  const bool is_maximum = kind >= SpecialKind::impact_speed;
  if (sign_of(first) * sign_of(last) >= 0 || (is_maximum && sign_of(first) < 0)) return std::nullopt;
  const Ball near = (from + first / (first - last) * (to - from)).middle();
  for (const double part : {0x1p-16, 0x1p-8, 0x1p-2}) {
    const Ball before = (near - Ball(part) * to).middle(), after = (near + Ball(part) * to).middle();
    if (before > from && after < to && sign_of(condition_at(before)) == sign_of(first) &&
        sign_of(condition_at(after)) == sign_of(last))
      return Ball::hull(before, after);
  }
  return Ball::hull(from, to);
}

/// Holds the numbers that move with the parameter to the limits that the format sets those of a scene. Beyond them the
/// equations have motions, too, but none of a scene.
void require_limits(const MovingScene& scene, Report& report) {
  const auto require_above = [&](const char* name, const Dual& number, const Dual& limit, bool or_at_it) {
    const Dual over = number - limit;
    if (over.is_constant() || over.value.is_positive() || (or_at_it && Ball(0) <= over.value)) return;
    const bool is_beyond = over.value.is_negative() || (!or_at_it && over.value.is_zero());
    report.add(is_beyond ? Verdict::refuted : Verdict::undecided, std::string("parameter: the found one makes ") +
                                                                      name + " of the scene " + number.value.text() +
                                                                      ", beyond its limit");
  };
  require_above("h", scene.h, Dual(0), true);
  require_above("nu", scene.nu, Dual(0), false);
  require_above("the square of the force", scene.force.squares(), Dual(0), false);
  for (const auto& stop : scene.stops) {
    if (!stop) continue;
    require_above("R", stop->R, Dual(0), true), require_above("1 - R", Dual(1) - stop->R, Dual(0), true);
    require_above("the stiffness", stop->kappa, Dual(0), !stop->soft);
    require_above("the damping", stop->zeta, Dual(0), true);
  }
  const auto& [lower, upper] = scene.stops;
  if (lower && upper) require_above("the upper position", upper->position, lower->position, false);
}

bool may_be_within_limits(const MovingScene& scene) {
  Report report;
  require_limits(scene, report);
  return report.finding().verdict != Verdict::refuted;
}

/// Proves, part by part, that no claimed place of the curve is special, of those whose scenes keep the format's limits.
class Exclusion {
 public:
  Exclusion(const Curve& curve, SpecialKind kind) : curve_(curve), kind_(kind) {}

  [[nodiscard]] bool holds(const Ball& from, const Ball& to, int halvings = 12) {
    const Place place = curve_.at(Ball::hull(from, to));
    if (!curve_.may_be_claimed(place) || !may_be_within_limits(curve_.scene(place.p)) || has_sign(place)) return true;
    if (halvings == 0 || --parts_left_ < 0) return false;
    const Ball middle = ((from + to) / Ball(2)).middle();
    return holds(from, middle, halvings - 1) && holds(middle, to, halvings - 1);
  }

 private:
  [[nodiscard]] bool has_sign(const Place& place) const {
    try {
      return sign_of(condition(curve_, kind_, place)) != 0;
    } catch (const Undecided&) {
      return false;
    }
  }

  const Curve& curve_;
  SpecialKind kind_;
  int parts_left_ = bits > 64 ? 5000 : 100;
};

/// The claimed periods, for all values of the parameter at some places.
Ball length_at(const Certificate& certificate, const Place& at) {
  return Ball(certificate.periods) * certificate.moving_scene(at.p).period().value;
}

/// All events of the claimed periods of motion at some places of the curve, from those that are followed: of motion
/// that is its own mirror image half a period later those of one half.
std::vector<Event> events_of(const Certificate& certificate, const Curve& curve, const Place& at,
                             std::vector<Event> events) {
  if (!curve.is_mirrored()) return events;
  const Ball half = length_at(certificate, at) / Ball(2);
  for (std::size_t i = 0, size = events.size(); i < size; ++i) {
    Event event = events[i];
    event.side = opposite(event.side), event.time = event.time + half, event.v = -event.v;
    if (lasts(event.kind)) event.until = event.until + half;
    events.push_back(event);
  }
  return events;
}

/// Refutes a period if the motion repeats sooner: then it is on a curve of its own, which is proved in the same way.
void check_smallest_period(const Certificate& certificate, const Curve& curve) {
  if (certificate.released) return;
  const Place all = curve.everywhere();
  const std::vector<Event> followed = curve.pass(all).events;
  const Cycle cycle(events_of(certificate, curve, all, followed), length_at(certificate, all));
  // a mirrored release has its number among those of the other stop, and a shorter period shows within the half
  require_smallest_period_of_rests(certificate.periods, Cycle(followed, length_at(certificate, all)));
  for (long parts = 2; parts <= certificate.periods; ++parts) {
    const auto share = static_cast<std::size_t>(parts);
    if (certificate.periods % parts != 0 || cycle.differs_after(share)) continue;
    Certificate shorter = certificate;
    shorter.periods /= parts, shorter.events.resize(certificate.events.size() / share);
    const std::string told =
        "periods: claimed " + std::to_string(certificate.periods) + ", found " + std::to_string(shorter.periods);
    try {
      const Curve found(shorter);
    } catch (const Refuted&) {
      throw Undecided(told);
    }
    throw Refuted(told);
  }
}

/// Of motion that starts with a release the whole period is followed, and its releases tell whether it is mirrored.
void check_symmetry_of_rests(const Certificate& certificate, const std::vector<Event>& events, const Place& at) {
  if (!certificate.released || !certificate.symmetric.value_or(false)) return;
  const Cycle cycle(events, length_at(certificate, at));
  if (certificate.periods % 2 == 0 || cycle.differs_from_mirror())
    throw Refuted("symmetric: claimed true, found false");
  if (!mirror_centre(certificate.moving_scene(Ball(0))))
    throw Undecided("symmetric: the scenes aren't, to their last digit");
  if (!cycle.releases_mirrored()) throw Undecided("symmetric: neither proved nor refuted");
}

/// The second half of the claimed events must be of the mirrored kinds.
void require_mirrored_kinds(const std::vector<ClaimedEvent>& events) {
  for (std::size_t i = 0, half = events.size() / 2; i < half; ++i)
    if (events[i].kind != events[half + i].kind || events[i].side == events[half + i].side)
      throw Refuted("symmetric: claimed true, and event " + std::to_string(half + i + 1) +
                    " isn't the mirror image of " + std::to_string(i + 1));
}

void require_possible_kind(const Certificate& certificate) {
  const SpecialKind kind = certificate.special->kind;
  const bool symmetric = certificate.symmetric.value_or(false);
  const std::string claimed = std::string("kind: claimed ") + name_of(kind);
  if (kind == SpecialKind::symmetry_breaking && !symmetric)
    throw Refuted(claimed + " of motion that isn't claimed to be symmetric");
  if (kind == SpecialKind::flip && symmetric)  // they are squares
    throw Refuted(claimed + " of motion that is its own mirror image, whose multipliers aren't negative");
  if (symmetric) require_mirrored_kinds(certificate.events);
  if (certificate.released && kind < SpecialKind::graze)
    throw Refuted(claimed + ", found motion that rests, whose multipliers are 0");
  const bool grazes =
      std::ranges::any_of(certificate.events, [](const ClaimedEvent& event) { return event.kind == Kind::graze; });
  if (grazes && kind != SpecialKind::graze) throw Refuted(claimed + ", and a graze among the events");
  if (!grazes && kind == SpecialKind::graze) throw Refuted(claimed + ", and none among the events");
}

/// The scene is claimed to be that at the parameter's value.
void require_scene_at_parameter(const Certificate& certificate) {
  const Claimed& parameter = certificate.special->parameter;
  for (const Ball& value : certificate.values_of_parameter())
    if (abs(value - parameter.value.ball()) > parameter.error.ball())
      throw Refuted("parameter: claimed " + parameter.value.text() + " to " + parameter.error.text() +
                    ", the scene is that at " + value.text());
}

void compare_place(const Certificate& certificate, const Place& place, Report& report) {
  const Claimed& parameter = certificate.special->parameter;
  std::vector<Ball> values = certificate.values_of_parameter();
  if (values.empty()) values.push_back(parameter.value.ball());
  for (const Ball& value : values) report.compare("parameter", value + place.p, parameter);
  require_limits(certificate.moving_scene(place.p), report);
  if (certificate.released) return;
  report.compare("start, x", place.x, certificate.start_x);
  report.compare("start, v", place.v, certificate.start_v);
}

}  // namespace

void check_special(const Certificate& certificate, Report& report) {
  if (certificate.scene_in_balls().is_rough()) throw Undecided("special points under dry friction");
  require_possible_kind(certificate);
  require_scene_at_parameter(certificate);
  const SpecialKind kind = certificate.special->kind;
  const Curve curve(certificate);
  check_smallest_period(certificate, curve);
  const auto found = part_with_change(curve, kind);
  Report of_place;
  if (found) compare_place(certificate, curve.at(*found), of_place);
  if (!found || of_place.finding().verdict != Verdict::proved) {
    if (!Exclusion(curve, kind).holds(-curve.reach(), curve.reach()))
      throw Undecided(std::string("whether there is a ") + name_of(kind));
    if (of_place.finding().verdict == Verdict::refuted) throw Refuted(of_place.first_refuted());
    throw Refuted(std::string("kind: claimed ") + name_of(kind) + ", found none within the errors");
  }
  const Place place = curve.at(*found);
  const std::vector<Event> events = events_of(certificate, curve, place, curve.pass(place).events);
  check_symmetry_of_rests(certificate, events, place);
  compare_events(certificate, events, report);
}

}  // namespace verify
