#include "course.hpp"

#include <algorithm>

#include "extrema.hpp"

namespace verify {
namespace {

std::string named(std::size_t number, const ClaimedEvent& event) {
  return "event " + std::to_string(number + 1) + ", " + name_of(event.kind) + " at the " + name_of(event.side) +
         " stop";
}

std::string found_text(const Event& event) {
  if (event.kind == Kind::end) return "no further event";
  return std::string(name_of(event.kind)) + " at the " + name_of(event.side) + " stop, time " + event.time.text();
}

double accuracy_of(const Claimed& claimed) { return claimed.error.ball().near() / 16; }
Ball latest(const Claimed& claimed) { return claimed.value.ball() + claimed.error.ball(); }

}  // namespace

Event Course::found_for(const ClaimedEvent& claim) {
  if (claim.kind == Kind::chatter) return motion_.finish_chatter(accuracy_of(*claim.until), latest(*claim.until));
  if (claim.kind == Kind::rest) {
    if (!motion_.is_resting()) {  // after an impact of an inelastic stop
      const Event event = motion_.finish_chatter(accuracy_of(claim.time), latest(claim.time));
      if (event.kind != Kind::chatter) return event;
    }
    return motion_.finish_rest(end_);
  }
  return motion_.is_resting() ? motion_.finish_rest(end_) : motion_.next(end_);
}

void Course::run() {
  const auto& claims = certificate_.events;
  for (std::size_t i = 0; i < claims.size(); ++i) {
    const Event event = found_for(claims[i]);
    if (event.kind != claims[i].kind || event.side != claims[i].side)
      throw Refuted(named(i, claims[i]) + ": claimed, found " + found_text(event));
    events_.push_back(event);
  }
  if (motion_.is_resting()) {
    if (!claims.empty() && claims.back().kind == Kind::rest) return;
    throw Refuted("after the last event: a stop holds the mass, and no rest is claimed");
  }
  if (ends_with_release()) return;
  const Event event = motion_.next(end_);
  if (event.kind != Kind::end) throw Refuted("after the last event: nothing is claimed, found " + found_text(event));
}

bool Course::ends_with_release() const {
  return certificate_.released && !events_.empty() && events_.back().kind == Kind::rest && !motion_.is_resting() &&
         events_.back().until.overlaps(end_);
}

void compare_events(const Certificate& certificate, const std::vector<Event>& events, Report& report) {
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ClaimedEvent& claim = certificate.events[i];
    const std::string name = named(i, claim);
    report.compare(name + ", time", events[i].time, claim.time);
    if (claim.until)
      report.compare(name + ", until", events[i].until, *claim.until);
    else
      report.compare(name + ", v", events[i].v, claim.v);
  }
}

void compare_extrema(const Certificate& certificate, const Motion& motion, const std::vector<Event>& events,
                     const Scene& scene, Report& report) {
  for (const Side side : {Side::lower, Side::upper}) {
    const auto& claim = side == Side::upper ? certificate.x_max : certificate.x_min;
    if (!claim) continue;
    const auto& stop = scene.stops[index_of(side)];
    const bool meets =
        stop && !stop->soft &&
        (certificate.released == side || std::ranges::any_of(events, [&](auto& e) { return e.side == side; }));
    const bool rests = motion.stretches().empty();
    const Ball found = meets || rests ? scene.stop(rests && !events.empty() ? events.front().side : side).position
                                      : extremum(motion.stretches(), sign_of(side));
    report.compare(side == Side::upper ? "x_max" : "x_min", found, *claim);
  }
}

}  // namespace verify
