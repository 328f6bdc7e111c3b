#include "hard/event_match.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iomanip>
#include <sstream>

namespace clatter::hard {
namespace {

using Kind = ToldEvent::Kind;
using Real = ToldEvent::Real;
using Events = std::vector<ToldEvent>;

constexpr Real instant = 1e-9L;  ///< of the duration: stands that are shorter aren't told from none

[[nodiscard]] bool is_stand(const ToldEvent& event) {
  return event.kind == Kind::rest || event.kind == Kind::stick || event.kind == Kind::chatter;
}

[[nodiscard]] std::string text(const ToldEvent& event) {
  static constexpr std::array names{"impact", "rest", "touch", "renewal", "separation", "stick", "reversal", "chatter"};
  std::ostringstream out;
  out << std::setprecision(15) << names[static_cast<std::size_t>(event.kind)] << " on side " << sign_of(event.side)
      << " at " << event.time;
  if (is_stand(event)) out << " until " << event.until;
  return out.str();
}
[[nodiscard]] std::string text(const Events& events, std::size_t i) {
  return i < events.size() ? text(events[i]) : "nothing";
}

/// The place after what may belong to a chatter on a stop: impacts on it, and what happens at the peaks between them,
/// no later than an instant.
[[nodiscard]] std::size_t after_chatter(const Events& events, std::size_t from, Side side, Real latest) {
  const auto belongs = [&](const ToldEvent& event) {
    return event.time <= latest && ((event.kind == Kind::impact && event.side == side) || event.kind == Kind::reversal);
  };
  while (from < events.size() && belongs(events[from])) ++from;
  return from;
}

/// Goes through two lists side by side.
class Matching {
 public:
  Matching(const Events& events, bool is_cut, const Events& reference, bool reference_is_cut, const Scales& scales)
      : a_(events), b_(reference), a_is_cut_(is_cut), b_is_cut_(reference_is_cut), scales_(scales) {}

  EventMatch run() {
    while (i_ < a_.size() || j_ < b_.size()) {
      if (skip_chatter()) continue;
      if (i_ == a_.size() || j_ == b_.size()) break;
      if (a_[i_].kind != b_[j_].kind || a_[i_].side != b_[j_].side) return different();
      found_.pairs.emplace_back(i_++, j_++);
    }
    found_.first_difference = j_;
    const bool more =
        (i_ < a_.size() && !b_is_cut_ && !is_last(a_[i_])) || (j_ < b_.size() && !a_is_cut_ && !is_last(b_[j_]));
    return more ? different() : std::move(found_);
  }

 private:
  /// Steps over impacts that one list sums, or ends earlier in a rest, than the other.
  bool skip_chatter() {
    if (i_ < a_.size() && a_[i_].kind == Kind::chatter) {
      j_ = after_chatter(b_, j_, a_[i_].side, a_[i_].until + tolerance());
      return ++i_, true;
    }
    const auto rests = [](const Events& list, std::size_t k) { return k < list.size() && list[k].kind == Kind::rest; };
    const std::size_t i = i_, j = j_;
    if (rests(b_, j_)) i_ = after_chatter(a_, i_, b_[j_].side, b_[j_].time + tolerance());
    if (rests(a_, i_)) j_ = after_chatter(b_, j_, a_[i_].side, a_[i_].time + tolerance());
    return i != i_ || j != j_;
  }
  [[nodiscard]] Real tolerance() const { return instant * scales_.duration; }
  [[nodiscard]] bool is_last(const ToldEvent& event) const { return event.time > scales_.duration - tolerance(); }
  EventMatch different() {
    found_.first_difference = j_;
    found_.difference = text(a_, i_) + " against " + text(b_, j_);
    return std::move(found_);
  }

  const Events &a_, &b_;
  const bool a_is_cut_, b_is_cut_;
  const Scales scales_;
  std::size_t i_ = 0, j_ = 0;
  EventMatch found_{};
};

}  // namespace

Scales scales_of(const Scene& scene, double duration, const MachineRun& run) {
  const auto& [h, f, nu, load, k, shape, paces] = scene.oscillator;
  const double response = std::abs(f) / std::max({std::abs(k - nu * nu), 2 * h * nu, nu / duration});
  Real farthest = std::max(-run.of_x.least, run.of_x.greatest);
  if (scene.loose.ratio > 0) farthest = std::max({farthest, -run.of_z.least, run.of_z.greatest});
  const double size = std::max(response, static_cast<double>(farthest));
  return {duration, size,
          std::max({response * nu, size * std::sqrt(std::abs(k)), static_cast<double>(run.fastest), 1e-300})};
}

Events told_events(const std::vector<motion::Event>& events) {
  using Told = motion::Event::Kind;
  const auto kind_of = [](Told kind) {
    switch (kind) {
      case Told::impact:
      case Told::strike:
        return Kind::impact;
      case Told::rest:
      case Told::press:
      case Told::hold:
        return Kind::rest;
      case Told::chatter:
        return Kind::chatter;
      case Told::touch:
      case Told::wall_touch:
        return Kind::touch;
      case Told::renewal:
      case Told::wall_renewal:
        return Kind::renewal;
      case Told::separation:
      case Told::wall_separation:
        return Kind::separation;
      case Told::stick:
        return Kind::stick;
      case Told::reversal:
        return Kind::reversal;
    }
    return Kind::chatter;
  };
  Events told;
  for (const motion::Event& e : events) {
    const Kind kind = kind_of(e.kind);
    const double place = kind == Kind::impact ? e.main.place : e.place;
    told.push_back({kind, e.side, e.time, e.before, e.end(), place, e.main.before, e.main.after});
  }
  return told;
}

Events told_events(const MachineRun& run) {
  using Simulated = MachineEvent::Kind;
  Events told;
  const auto end_of = [&](const MachineEvent& begin, Simulated kind) {
    const auto later = run.events.begin() + (&begin - run.events.data());
    const auto end = std::find_if(later, run.events.end(), [&](const MachineEvent& e) { return e.kind == kind; });
    return end == run.events.end() ? run.time : end->time;
  };
  for (const MachineEvent& e : run.events) {
    const Side side = e.side > 0 ? Side::upper : e.side < 0 ? Side::lower : Side::none;
    const auto stand = [&](Kind kind, Simulated end) {
      told.push_back({kind, side, e.time, 0, end_of(e, end), e.place, 0, 0, e.pull});
    };
    switch (e.kind) {
      case Simulated::stop_impact:
        told.push_back({Kind::impact, side, e.time, e.before});
        break;
      case Simulated::wall_impact:
        told.push_back({Kind::impact, side, e.time, e.before, e.time, e.place, e.main_before, e.main_after});
        break;
      case Simulated::rest:
        stand(Kind::rest, Simulated::rest_end);
        break;
      case Simulated::stick:
        stand(Kind::stick, Simulated::stick_end);
        break;
      case Simulated::press:
        stand(Kind::rest, Simulated::release);
        break;
      case Simulated::reversal:
        told.push_back({Kind::reversal, Side::none, e.time, 0, e.time, e.place, 0, 0, e.pull});
        break;
      case Simulated::touch:
      case Simulated::wall_touch:
        if (e.before != 0) told.push_back({Kind::touch, side, e.time, e.before});
        break;
      case Simulated::renewal:
        told.push_back({Kind::renewal, side, e.time, e.before});
        break;
      case Simulated::separation:
        told.push_back({Kind::separation, side, e.time, e.before});
        break;
      case Simulated::rest_end:
      case Simulated::stick_end:
      case Simulated::release:
      case Simulated::hold:
      case Simulated::hold_end:
      case Simulated::leave:
        break;
    }
  }
  return told;
}

Events joined(const Events& events, double duration) {
  Events all;
  for (const ToldEvent& event : events) {
    const bool continues = !all.empty() && is_stand(event) && all.back().kind == event.kind &&
                           all.back().side == event.side && event.time - all.back().until <= instant * duration;
    if (continues)
      all.back().until = event.until;
    else
      all.push_back(event);
  }
  std::erase_if(all, [&](const ToldEvent& event) {
    return is_stand(event) && event.kind != Kind::chatter && event.until - event.time <= instant * duration;
  });
  return all;
}

double deviation_of(const ToldEvent& event, const ToldEvent& reference, const Scales& scales) {
  double off = 0;
  const auto take = [&](Real a, Real b, double scale) {
    const double by = static_cast<double>(std::abs(a - b)) / scale;
    if (!(by <= off)) off = by;  // NaN, too
  };
  take(event.time, reference.time, scales.duration);
  if (is_stand(reference)) take(event.until, reference.until, scales.duration);
  if (reference.velocity != 0) take(event.velocity, reference.velocity, scales.fastest);
  if (reference.kind == Kind::stick || reference.kind == Kind::reversal || reference.kind == Kind::impact)
    take(event.place, reference.place, scales.size);
  if (reference.kind != Kind::impact) return off;
  take(event.before, reference.before, scales.fastest), take(event.after, reference.after, scales.fastest);
  return off;
}

EventMatch match(const Events& events, bool is_cut, const Events& reference, bool reference_is_cut,
                 const Scales& scales) {
  return Matching(events, is_cut, reference, reference_is_cut, scales).run();
}

}  // namespace clatter::hard
