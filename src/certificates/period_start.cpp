#include "certificates/period_start.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::certificates {
namespace {

using Kind = motion::Event::Kind;

/// Whether the mass flies free of the stops after an event.
bool begins_flight(const RecordedEvent& event) { return event.kind != Kind::touch && event.kind != Kind::renewal; }

/// The rest that ends in a release before the section or at it; of several the first.
std::optional<PeriodStart> release_of(const RecordedMotion& motion) {
  const double same = 1e-12 * motion.duration;
  const auto& events = motion.events;
  const auto rest = std::ranges::find_if(events, &RecordedEvent::is_rest);
  if (rest == events.end()) return std::nullopt;
  if (rest->end() < motion.duration - same) return PeriodStart{rest->end(), rest->side};
  if (rest->time <= same) return PeriodStart{.time = 0.0, .released = Side::none, .rests_for_ever = true};
  return PeriodStart{0.0, rest->side};
}

}  // namespace

PeriodStart start_of_period(const RecordedMotion& from_section) {
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

}  // namespace clatter::certificates
