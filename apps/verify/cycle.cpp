#include "cycle.hpp"

#include <algorithm>
#include <map>
#include <utility>

#include "deadline.hpp"
#include "release.hpp"

namespace verify {

Cycle::Cycle(std::vector<Event> events, const Ball& period, bool pressed)
    : events_(std::move(events)), period_(period) {
  if (pressed && events_.size() > 1) {  // the start divides this press
    events_.back().until = events_.front().until + period;
    events_.erase(events_.begin());
  }
  begin_after_rest();
}

/// A time in which the mass is held comes last, so that the impacts that lead to it come before it.
void Cycle::begin_after_rest() {
  const auto last =
      std::find_if(events_.rbegin(), events_.rend(), [](const Event& event) { return holds(event.kind); });
  if (last == events_.rend() || last == events_.rbegin()) return;
  for (auto event = events_.begin(); event != last.base(); ++event) {
    event->time = event->time + period_;
    if (lasts(event->kind)) event->until = event->until + period_;
  }
  std::rotate(events_.begin(), last.base(), events_.end());
}

/// The events without the impacts that a chatter begins with; it has the time of its end.
std::vector<Event> Cycle::without_rebounds() const {
  std::vector<Event> list;
  for (const Event& event : events_) {
    const auto leads_to_it = [&](const Event& before) {
      return (before.kind == Kind::impact && before.side == event.side && before.of_wall == event.of_wall) ||
             before.kind == Kind::reversal;
    };
    if (event.kind == Kind::chatter)
      while (!list.empty() && leads_to_it(list.back())) list.pop_back();
    list.push_back(event);
    if (event.kind == Kind::chatter) list.back().time = event.until;
  }
  return list;
}

/// Whether some event differs from the one that comes so many later.
bool Cycle::differs(const std::vector<Event>& events, std::size_t shift, const Ball& later, bool mirrored) const {
  for (std::size_t i = 0; i < events.size(); ++i) {
    require_time();
    const std::size_t j = (i + shift) % events.size();
    const Event &one = events[i], &other = events[j];
    const Ball turn = i + shift >= events.size() ? period_ : Ball(0);
    if (one.kind != other.kind || one.of_wall != other.of_wall) return true;
    if (!is_of_friction(one.kind) && (one.side == other.side) == mirrored) return true;
    if (!(other.time + turn).overlaps(one.time + later) || !other.v.overlaps(mirrored ? -one.v : one.v)) return true;
    if (lasts(one.kind) && !(other.until + turn).overlaps(one.until + later)) return true;
  }
  return false;
}

/// One press, stick or rest from the beginning to the end shows nothing of a smaller period.
bool Cycle::is_held_throughout() const {
  if (events_.size() != 1) return false;
  const Event& only = events_.front();
  return (holds(only.kind) || only.kind == Kind::stick || only.kind == Kind::hold) &&
         !(only.until - only.time < period_);
}

bool Cycle::differs_after(std::size_t parts) const {
  if (is_held_throughout()) return false;
  const std::vector<Event> events = without_rebounds();
  return events.size() % parts != 0 ||
         differs(events, events.size() / parts, period_ / Ball(static_cast<int>(parts)), false);
}

bool Cycle::differs_from_mirror() const {
  const std::vector<Event> events = without_rebounds();
  return events.size() % 2 != 0 || differs(events, events.size() / 2, period_ / Ball(2), true);
}

long Cycle::releases() const {
  std::map<std::pair<Side, std::size_t>, long> times;
  long most = 0;
  for (const Event& event : events_)
    if (event.kind == Kind::rest) most = std::max(most, ++times[{event.side, event.release}]);
  return most;
}

/// A stop lets the mass go at one phase of the force and the other, in a scene that is its own mirror image, half a
/// forcing period later: times that are nearer than phases of release ever are to each other are the same.
bool Cycle::releases_mirrored() const {
  constexpr int most_periods = 1'000'000;
  const Ball half = period_ / Ball(2), same = Ball(releases_apart) * period_ / Ball(most_periods);
  for (const Event& one : events_) {
    require_time();
    for (const Event& other : events_)
      if (one.kind == Kind::rest && other.kind == Kind::rest && one.side != other.side &&
          abs(other.until - one.until - half) < same)
        return true;
  }
  return false;
}

std::vector<std::string> Cycle::letters(bool tells_walls) const {
  std::vector<std::string> word;
  for (const Event& event : events_) {
    const bool is_small = tells_walls && event.of_wall, is_upper = event.side == Side::upper;
    const std::string letter = is_small ? (is_upper ? "u" : "l") : (is_upper ? "U" : "L");
    if (event.kind == Kind::impact || event.kind == Kind::touch) word.push_back(letter);
    if (!holds(event.kind)) continue;
    bool any = false;
    while (!word.empty() && word.back() == letter) word.pop_back(), any = true;
    if (any) word.push_back(letter + '*');
  }
  return word;
}

}  // namespace verify
