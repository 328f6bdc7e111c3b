#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "motion/event.hpp"
#include "motion/polynomial_arc.hpp"
#include "motion/soft_stop.hpp"
#include "motion/state.hpp"
#include "observables/contacts/impacts.hpp"
#include "observables/extremes/range_search.hpp"

namespace clatter::observables {

class Impacts::Observer {
 public:
  Observer() = default;
  Observer(const Settings& settings, const ObservedSpan& span)
      : tells_walls_(settings.wall_impacts), soft_stops_(span.scene.stops) {}

  template <class A>
  void arc(const A& arc, double, double length) {
    if constexpr (A::effects.stiffness)
      if (arc.constants().stop.side != Side::none && length > 0) contact(arc, length);
    if constexpr (motion::Housed<A>) see_wall(arc.loose, length);
  }
  /// The walls of a loose mass count like stops, beside which they are counted apart, with z' in place of the velocity.
  /// A contact with a soft stop counts like an impact if the mass comes from outside; its velocities are those at the
  /// touch and where the stop's force has fallen to 0.
  void event(const motion::Event& event) {
    using Kind = motion::Event::Kind;
    if (event.is_stick()) return stick(event);
    if (event.side == Side::none) return;
    const bool is_of_wall = event.kind == Kind::strike || event.kind == Kind::hold || event.is_of_soft_wall();
    OfStop& stop = (tells_walls_ && is_of_wall ? walls_ : stops_)[index_of(event.side)];
    switch (event.kind) {
      case Kind::impact:
      case Kind::strike:
        if (stop.count == 0.0) stop.after = event.after;
        return stop.meet(event.before);
      case Kind::touch:
      case Kind::wall_touch:
        return stop.meet(event.before);
      case Kind::separation:
      case Kind::wall_separation:
        if (std::isnan(stop.after) && stop.count > 0.0) stop.after = event.after;
        if (std::isnan(stop.left_first)) stop.left_first = event.after;
        return;
      case Kind::rest:
      case Kind::hold:
        stop.rest_time += event.length;
        return;
      default:
        return;
    }
  }
  /// Takes over what was counted elsewhere, in motion that never rests.
  void include(const std::array<OfStop, 2>& stops) { stops_ = stops; }
  /// The response meets no stop.
  bool response(const ObservedSpan&, double) { return true; }

  [[nodiscard]] const std::array<OfStop, 2>& stops() const { return stops_; }

  [[nodiscard]] Values finish(const ObservedSpan& span, double, double) const {
    const double periods = span.counts_as_one_period() ? 1.0 : span.turns;
    Values values;
    values.stick_fraction = std::min(1.0, stick_time_ / span.total);
    for (std::size_t i = 0; i < stops_.size(); ++i) {
      values.impacts_per_period[i] = stops_[i].count / periods;
      values.v_before[i] = stops_[i].before, values.v_after[i] = stops_[i].after;
      if (stops_[i].count > 0) values.impact_speed[i] = stops_[i].fastest;
      if (span.periodic && std::isnan(values.v_after[i])) values.v_after[i] = stops_[i].left_first;
      values.rest_fraction[i] = std::min(1.0, stops_[i].rest_time / span.total);
      values.contact_fraction[i] = std::min(1.0, (stops_[i].rest_time + stops_[i].contact_time) / span.total);
      const Side side = i == 0 ? Side::lower : Side::upper;
      const bool are_walls = has_loose_mass(span.scene.loose) && !tells_walls_;
      if (are_walls ? is_soft(span.scene.loose, side) : is_soft(span.scene.stops, side))
        values.contact_force_max[i] = std::max(0.0, stops_[i].force.high);
      values.wall_impacts_per_period[i] = walls_[i].count / periods;
      values.wall_v_before[i] = walls_[i].before, values.wall_v_after[i] = walls_[i].after;
      if (walls_[i].count > 0) values.wall_impact_speed[i] = walls_[i].fastest;
      values.wall_rest_fraction[i] = std::min(1.0, walls_[i].rest_time / span.total);
      values.wall_contact_fraction[i] = std::min(1.0, (walls_[i].rest_time + walls_[i].contact_time) / span.total);
      if (is_soft(span.scene.loose, side)) values.wall_contact_force_max[i] = std::max(0.0, walls_[i].force.high);
    }
    return values;
  }

 private:
  /// Friction may hold the mass in contact with a soft stop, too.
  void stick(const motion::Event& stick) {
    stick_time_ += stick.length;
    const Side side = soft_stop_beyond(soft_stops_, stick.place);
    if (side == Side::none) return;
    const auto stop = motion::soft_stop_at<double>(soft_stops_, side);
    stops_[index_of(side)].contact_time += stick.length;
    stops_[index_of(side)].force.include(stop.force(stop.into(stick.place - stop.position), 0.0));
  }
  template <class A>
  void contact(const A& arc, double length) {
    if constexpr (requires { arc.as_stop_sees(); })
      contact_by(*arc.as_stop_sees(), length);
    else
      contact_by(arc, length);
  }
  template <Effects E>
  void contact_by(const motion::Arc<double, E>& arc, double length) {
    const motion::SoftStop<double>& of_arc = arc.constants().stop;
    OfStop& stop = stops_[index_of(of_arc.side)];
    stop.contact_time += length;
    const auto see = [&](const motion::Motion<double>& m) {
      stop.force.include(of_arc.force(of_arc.into(m.offset), of_arc.into(m.v)));
    };
    RangeSearch(arc, length, see).exceed(StopForceOnArc{}, stop.force);
  }
  template <motion::Polynomial A>
  void contact_by(const A& arc, double length) {
    const motion::SoftStop<double>& of_arc = arc.constants().stop;
    OfStop& stop = stops_[index_of(of_arc.side)];
    stop.contact_time += length;
    if (!(arc.length() > 0)) return;
    auto force = arc.offset();
    const auto velocity = arc.velocity();
    for (std::size_t i = 0; i < force.size(); ++i)
      force[i] = of_arc.force(of_arc.into(force[i]), of_arc.into(velocity[i]));
    include_polynomial(stop.force, split_off(force, length / arc.length()));
  }

  /// The contact of a loose mass with a soft wall.
  template <class L>
  void see_wall(const L& loose, double length) {
    if constexpr (requires { loose.coupling(); }) {
      const motion::SoftStop<double>& wall = loose.coupling().wall;
      if (!loose.coupling().pushes || !(length > 0)) return;
      OfStop& stop = (tells_walls_ ? walls_ : stops_)[index_of(wall.side)];
      stop.contact_time += length;
      auto force = from_powers(loose.push_powers());
      for (double& push : force) push *= sign_of(wall.side);
      include_polynomial(stop.force, split_off(force, length / loose.length()));
    }
  }

  bool tells_walls_ = false;
  std::array<OfStop, 2> stops_{}, walls_{};  ///< [stop], of a loose mass if it has walls of its own
  Stops soft_stops_{};
  double stick_time_ = 0.0;  ///< tau
};

}  // namespace clatter::observables
