#include "course.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

#include "deadline.hpp"
#include "extrema.hpp"

namespace verify {

namespace {

/// Where an event is, claimed or found.
template <class AnyEvent>
std::string place_of(const AnyEvent& event) {
  if (is_of_friction(event.kind)) return "";
  return std::string(" at the ") + name_of(event.side) + (event.of_wall ? " wall" : " stop");
}

}  // namespace

std::string named(std::size_t number, const ClaimedEvent& event) {
  return "event " + std::to_string(number + 1) + ", " + name_of(event.kind) + place_of(event);
}

namespace {

std::string found_text(const Event& event) {
  if (event.kind == Kind::end) return "no further event";
  return name_of(event.kind) + place_of(event) + ", time " + event.time.text();
}

/// A part of a claimed error that grows smaller with the precision: what one precision leaves open, a later one tells.
double accuracy_of(const Claimed& claimed) {
  return std::ldexp(claimed.error.ball().near(), -static_cast<int>(bits / 32));
}
/// How near to a stop flights must be to be left out of the extrema.
double height_of(const Certificate& certificate) {
  double least = std::numeric_limits<double>::infinity();
  for (const auto& claim : {certificate.x_min, certificate.x_max})
    if (claim) least = std::min(least, accuracy_of(*claim));
  return least;
}
}  // namespace

/// An event that is none by the time it is claimed refutes a claim, also if what comes later can't be told.
Event Course::found_for(const ClaimedEvent& claim) {
  const std::size_t before = motion_.stretches().size();
  try {
    return next_event(&claim);
  } catch (const Undecided&) {
    if (motion_.stretches().size() != before ||
        !motion_.is_clear_until(smaller((claim.until ? *claim.until : claim.time).latest(), end_)))
      throw;
    return {Kind::end, claim.side, claim.time.latest(), Ball(0), Ball(0)};
  }
}

/// A mass that is held does nothing else before it is let go, whatever is claimed. After an impact that it leaves it
/// comes to rest by a chatter alone, which must be claimed.
Event Course::next_event(const ClaimedEvent* claim) {
  if (motion_.is_at_end()) return {Kind::end, Side::lower, end_, Ball(0), Ball(0)};
  if (motion_.is_resting()) return motion_.finish_rest(end_);
  if (claim == nullptr || motion_.is_sticking()) return motion_.next(end_);
  if (claim->kind == Kind::chatter)
    return motion_.finish_chatter({accuracy_of(*claim->until), height_of(certificate_), claim->until->latest(), end_});
  if (claim->kind == Kind::graze) return motion_.graze(claim->side, claim->time.value.ball(), end_);
  return motion_.next(end_);
}

/// Events that go back in time, or last beyond the end, are no course of a motion.
void Course::require_order(const Event& event) const {
  const bool is_late = lasts(event.kind) && (event.until < event.time || event.until > end_);
  bool is_early = false;
  if (!events_.empty()) {
    const Event& before = events_.back();
    is_early = event.time < (lasts(before.kind) ? before.until : before.time);
  }
  if (is_late || is_early || event.time > end_) throw std::logic_error("events out of order");
}

void Course::run() {
  const auto& claims = certificate_.events;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    require_time();
    const Event event = found_for(claims[i]);
    if (event.kind != claims[i].kind || event.side != claims[i].side || event.of_wall != claims[i].of_wall)
      throw Refuted(named(i, claims[i]) + ": claimed, found " + found_text(event));
    require_order(event);
    events_.push_back(event);
  }
  if (ends_with_release()) return;
  if (motion_.is_resting() && !motion_.is_at_end())
    throw Refuted(motion_.pressed_by() ? "after the last event: a wall presses the loose mass, and no press is claimed"
                  : motion_.is_carrying()
                      ? "after the last event: friction holds the loose mass, and no hold is claimed"
                      : "after the last event: a stop holds the mass, and no rest is claimed");
  const Event event = next_event(nullptr);
  if (event.kind != Kind::end) throw Refuted("after the last event: nothing is claimed, found " + found_text(event));
}

/// Of periodic motion alone: a transient that ends just at a release may have left the stop by then.
bool Course::ends_with_release() const {
  return certificate_.periodic && certificate_.released && !events_.empty() && events_.back().kind == Kind::rest &&
         !motion_.is_resting() && events_.back().until.overlaps(end_);
}

void compare_events(const Certificate& certificate, const std::vector<Event>& events, Report& report) {
  if (events.size() > certificate.events.size()) throw std::logic_error("more events are compared than are claimed");
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ClaimedEvent& claim = certificate.events[i];
    const std::string name = named(i, claim);
    report.compare(name + ", time", events[i].time, claim.time);
    if (claim.x) report.compare(name + (claim.of_wall ? ", z" : ", x"), events[i].x, *claim.x);
    if (claim.until)
      report.compare(name + ", until", events[i].until, *claim.until);
    else if (claim.kind != Kind::graze && !is_of_friction(claim.kind))
      report.compare(name + (claim.of_wall ? ", w" : ", v"), events[i].v, claim.v);
  }
}

void compare_extrema(const Certificate& certificate, const Motion& motion, const std::vector<Event>& events,
                     const Scene& scene, Report& report) {
  for (const Side side : {Side::lower, Side::upper}) {
    const auto& claim = side == Side::upper ? certificate.x_max : certificate.x_min;
    if (!claim) continue;
    const auto& stop = scene.stops[index_of(side)];
    const bool meets =
        stop && !stop->soft && (certificate.released == side || std::ranges::any_of(events, [&](auto& e) {
                                  return e.side == side && !e.of_wall && !is_of_friction(e.kind);
                                }));
    const Ball found = meets ? stop->position : extremum(motion.stretches(), motion.other_places(), sign_of(side));
    report.compare(side == Side::upper ? "x_max" : "x_min", found, *claim);
  }
}

}  // namespace verify
