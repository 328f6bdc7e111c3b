#include "order.hpp"

#include "course.hpp"

namespace verify {
namespace {

/// Whether walls or a stop take all speed in an impact.
bool is_inelastic(const Certificate::SceneNumbers& scene, Side side) {
  if (scene.loose) return scene.loose->R[index_of(side)].ball().is_zero();
  const auto& stop = scene.stops[index_of(side)];
  return stop && !stop->soft && stop->R.ball().is_zero();
}

/// A mass comes to rest on a stop by a chatter, or by an impact that takes all its speed.
bool leads_to_rest(const Certificate::SceneNumbers& scene, const ClaimedEvent& before, Side side) {
  return before.side == side &&
         (before.kind == Kind::chatter || (before.kind == Kind::impact && is_inelastic(scene, side)));
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
    if (holds(event.kind) && !leads_to_rest(certificate.scene, before, event.side))
      throw Refuted(named(i, event) + ": claimed, and neither a chatter nor an impact with R = 0 leads to it");
    if (before.kind == Kind::chatter && !(holds(event.kind) && event.side == before.side))
      throw Refuted(named(i, event) + ": claimed, found that the chatter before it ends in rest");
  }
}

}  // namespace verify
