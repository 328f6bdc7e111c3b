#include "order.hpp"

#include <algorithm>

#include "course.hpp"

namespace verify {
namespace {

/// Whether an impact of some speed leaves none.
bool may_stop(const Number& R, const std::optional<Certificate::LawNumbers>& law) {
  if (!law) return R == Number();
  return law->below != Number() ||
         std::ranges::any_of(law->table, [](const auto& knot) { return knot.R == Number(); }) ||
         (law->table.empty() && !law->exponent && law->R == Number());
}

/// Whether a wall or a stop takes all speed in an impact, at some speed.
bool may_stop(const Certificate::SceneNumbers& scene, const ClaimedEvent& event) {
  const std::size_t side = index_of(event.side);
  if (event.of_wall) return may_stop(scene.loose->R[side], scene.loose->laws[side]);
  const auto& stop = scene.stops[side];
  return stop && !stop->soft && may_stop(stop->R, stop->law);
}

bool are_alike(const ClaimedEvent& one, const ClaimedEvent& other) {
  return one.side == other.side && one.of_wall == other.of_wall;
}

/// A mass comes to rest on a stop or a wall by a chatter, or by an impact that takes all its speed; a press goes on
/// after an event of the main mass.
bool leads_to_rest(const Certificate::SceneNumbers& scene, const std::vector<ClaimedEvent>& events, std::size_t rest) {
  const ClaimedEvent &before = events[rest - 1], &event = events[rest];
  if (are_alike(before, event))
    return before.kind == Kind::chatter || (before.kind == Kind::impact && may_stop(scene, before));
  return event.of_wall && !before.of_wall && before.kind != Kind::impact && rest > 1 &&
         events[rest - 2].kind == Kind::press && are_alike(events[rest - 2], event);
}

}  // namespace

void require_possible_order(const Certificate& certificate) {
  const auto& events = certificate.events;
  for (std::size_t i = 0; i < events.size(); ++i) {
    const ClaimedEvent& event = events[i];
    if (event.until && event.until->latest() < event.time.earliest())
      throw Refuted(named(i, event) + ": claimed until before its time");
    if (i == 0) continue;
    const ClaimedEvent& before = events[i - 1];
    if (event.time.latest() < (before.until ? *before.until : before.time).earliest())
      throw Refuted(named(i, event) + ": claimed before the end of event " + std::to_string(i));
    if (holds(event.kind) && !leads_to_rest(certificate.scene, events, i))
      throw Refuted(named(i, event) + ": claimed, and neither a chatter nor an impact without a rebound leads to it");
    if (before.kind == Kind::chatter && !(holds(event.kind) && are_alike(before, event)))
      throw Refuted(named(i, event) + ": claimed, found that the chatter before it ends in rest");
  }
}

}  // namespace verify
