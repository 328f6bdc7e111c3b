#include "accuracy/comparison.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::accuracy {
namespace {

/// The events on one stop, or on one wall of a loose mass; of side none the sticks.
struct OfStop {
  std::vector<Event> impacts, chatters, rests;

  OfStop(std::span<const Event> events, Side side, bool of_wall) {
    for (const Event& event : with_rests_joined({events.begin(), events.end()})) {
      if (event.side != side || event.of_wall != of_wall || event.kind == Event::Kind::reversal) continue;
      auto& of_kind = event.kind == Event::Kind::impact    ? impacts
                      : event.kind == Event::Kind::chatter ? chatters
                                                           : rests;
      of_kind.push_back(event);
    }
  }

  /// Whether a chatter has been completed at a time, give or take its length at both ends.
  [[nodiscard]] bool completes(double time) const {
    return std::ranges::any_of(chatters, [&](const Event& chatter) {
      return time >= chatter.time - chatter.length && time <= chatter.end() + chatter.length;
    });
  }
};

/// Pairs the impacts of a run with those of its reference on one stop, and finds the differences.
class Pairing {
 public:
  /// `keeps_lag`: the lag at one impact is expected at the next one, too.
  Pairing(const OfStop& run, const OfStop& reference, double latest, bool keeps_lag)
      : run_(run), reference_(reference), latest_(latest), keeps_lag_(keeps_lag) {
    impacts();
    rests();
  }

  [[nodiscard]] const ContactErrors& errors() const { return errors_; }

 private:
  void impacts() {
    const std::vector<Event>& impacts = run_.impacts;
    std::size_t j = 0;
    for (std::size_t i = 0; i < reference_.impacts.size(); ++i) {
      const double time = reference_.impacts[i].time;
      const auto off = [&](std::size_t k) { return std::abs(impacts[k].time - time - lag_); };
      while (j < impacts.size() && impacts[j].time < time + earliest(i)) count_extra(impacts[j++]);
      while (j + 1 < impacts.size() && off(j + 1) < off(j)) count_extra(impacts[j++]);  // pair the nearest one
      if (j < impacts.size() && impacts[j].time <= time + latest(i)) {
        pair(impacts[j++], reference_.impacts[i]);
      } else if (!run_.completes(time + lag_)) {
        ++errors_.missed;
      }
    }
    while (j < impacts.size()) count_extra(impacts[j++]);
  }

  void rests() {
    for (const Event& rest : reference_.rests) {
      const auto overlaps = [&](const Event& other) { return other.time <= rest.end() && other.end() >= rest.time; };
      const auto other = std::ranges::find_if(run_.rests, overlaps);
      if (other == run_.rests.end()) {
        ++errors_.rests_missed;
        continue;
      }
      ++errors_.rests_paired;
      errors_.rest = std::max({errors_.rest, std::abs(other->time - rest.time), std::abs(other->end() - rest.end())});
    }
  }

  /// Half the time from an impact of the reference to the next (direction 1) or the one before (-1), and not less than
  /// the rounding of their times: between a stop and a wall a mass may have several in one instant.
  [[nodiscard]] double half_spacing(std::size_t i, int direction) const {
    const auto& impacts = reference_.impacts;
    const bool first = i == 0, last = i + 1 == impacts.size();
    if (first && last) return latest_;
    const bool ahead = (direction > 0 && !last) || first;
    const double rounding = 1e-13 * (1 + impacts[i].time);
    return std::max(std::abs(impacts[ahead ? i + 1 : i - 1].time - impacts[i].time) / 2, rounding);
  }
  /// The earliest and latest lag of the run's impact behind the reference's.
  [[nodiscard]] double earliest(std::size_t i) const { return std::max(lag_ - half_spacing(i, -1), -latest_); }
  [[nodiscard]] double latest(std::size_t i) const { return std::min(lag_ + half_spacing(i, 1), latest_); }

  void pair(const Event& impact, const Event& expected) {
    const double lag = impact.time - expected.time;
    if (keeps_lag_) lag_ = lag;
    ++errors_.paired;
    errors_.time = std::max(errors_.time, std::abs(lag));
    errors_.speed = std::max(errors_.speed, std::abs(impact.speed() - expected.speed()));
  }
  void count_extra(const Event& impact) {
    if (!reference_.completes(impact.time - lag_)) ++errors_.extra;
  }

  const OfStop &run_, &reference_;
  double latest_;
  bool keeps_lag_;
  ContactErrors errors_{};
  double lag_ = 0.0;  ///< of the run behind the reference at the last pair, in tau
};

/// Pairs with and without a kept lag, and takes the pairing that leaves fewer unpaired: in one sequence all impacts
/// come late, in another a single one.
ContactErrors compare_on_stop(const OfStop& run, const OfStop& reference, double latest) {
  const ContactErrors late = Pairing(run, reference, latest, true).errors();
  if (late.missed + late.extra == 0) return late;
  const ContactErrors in_place = Pairing(run, reference, latest, false).errors();
  return in_place.missed + in_place.extra < late.missed + late.extra ? in_place : late;
}

}  // namespace

Agreement agreement_of(const RunRecord& in_double, const RunRecord& in_fifty_digits, double tolerance) {
  const std::vector<Event> events = with_rests_joined(in_double.events),
                           exact = with_rests_joined(in_fifty_digits.events);
  const double end = in_double.duration * (1 - 1e-12);  // an event at the very end may fall on either side of it
  Agreement agreement{.until = in_double.duration};
  std::size_t j = 0;
  for (const Event& event : events) {
    if (event.kind == Event::Kind::chatter)
      while (j < exact.size() && is_of_chatter(exact[j])) ++j;
    if (event.kind == Event::Kind::chatter && j == exact.size() && event.end() >= end)
      return agreement;  // the run ends within it
    const double other = j < exact.size() ? exact[j].time : in_double.duration;
    const bool chatter = event.kind == Event::Kind::chatter;  // begins later in 50 digits, and ends at the same time
    const double off =
        chatter ? std::abs(event.end() - (j < exact.size() ? exact[j].end() : end)) : std::abs(event.time - other);
    const bool same = j < exact.size() && exact[j].kind == event.kind && exact[j].side == event.side &&
                      exact[j].of_wall == event.of_wall && off <= tolerance;
    if (!same && std::min(event.time, other) >= end) return agreement;
    if (!same) {
      agreement.until = std::min(event.time, other);
      return agreement;
    }
    agreement.events.push_back(exact[j++]);
    if (chatter)
      agreement.events.back().time = event.time, agreement.events.back().length = exact[j - 1].end() - event.time;
  }
  if (j < exact.size() && exact[j].time < end) agreement.until = exact[j].time;
  return agreement;
}

ContactErrors compare(std::span<const Event> run, std::span<const Event> reference, double latest) {
  ContactErrors errors;
  double fastest = 0.0;
  for (const Event& event : reference) fastest = std::max(fastest, event.speed());
  for (const bool of_wall : {false, true})
    for (const Side side : {Side::lower, Side::none, Side::upper}) {
      const ContactErrors on_stop =
          compare_on_stop(OfStop(run, side, of_wall), OfStop(reference, side, of_wall), latest);
      errors.time = std::max(errors.time, on_stop.time), errors.speed = std::max(errors.speed, on_stop.speed);
      errors.rest = std::max(errors.rest, on_stop.rest);
      errors.paired += on_stop.paired, errors.rests_paired += on_stop.rests_paired;
      errors.missed += on_stop.missed, errors.extra += on_stop.extra, errors.rests_missed += on_stop.rests_missed;
    }
  if (fastest > 0) errors.speed /= fastest;
  return errors;
}

}  // namespace clatter::accuracy
