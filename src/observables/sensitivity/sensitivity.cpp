#include "observables/sensitivity/sensitivity_observer.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "math/dual.hpp"
#include "motion/arc.hpp"
#include "motion/dry_friction.hpp"
#include "observables/sensitivity/course_extremes.hpp"
#include "observables/sensitivity/course_slips.hpp"
#include "observables/sensitivity/dual_force.hpp"
#include "observables/sensitivity/dual_motion.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::observables {
namespace {

using motion::Event;

/// By the displacement and the velocity at the beginning of the period, and by the key.
using Along = Dual<double, 3>;
constexpr std::size_t by_x = 0, by_v = 1, by_key = 2;

/// Follows a course on numbers that carry derivatives. Where a stretch ends is known; by how much that instant changes
/// follows from the surface of its event, to first order.
template <Effects E>
class Walk {
 public:
  Walk(const Course& course, const ObservedSpan& span, const Extremes& extremes, const BasicScene<Along>& scene,
       const Along& mass)
      : course_(course),
        span_(span),
        extremes_(extremes),
        scene_(scene),
        driven_(with_force_in_frame(scene.oscillator, scene.shaking)),
        pieces_(span, scene),
        frame_(span, scene, driven_.lead),
        mass_(mass),
        still_(motion::ArcConstants<Along, E>::of(driven_.oscillator.damping, driven_.oscillator.forcing,
                                                  driven_.oscillator.frequency, driven_.oscillator.load,
                                                  driven_.oscillator.stiffness, driven_.oscillator.shape)),
        slips_(still_, scene.friction, scene.stops) {}

  Sensitivity::ByKey run() {
    const std::size_t first = begin();
    for (std::size_t n = 0; n < course_.size(); ++n) {
      const std::size_t i = (first + n) % course_.size();
      course_[i].stands() ? stay(i) : follow(i);
    }
    return closes_ ? result() : Sensitivity::ByKey{};
  }

 private:
  using Motion = motion::Motion<Along>;

  struct State {
    Along x, v;
    Along phase;  ///< of the force in the moving frame, rad; of it only the derivatives count
  };

  [[nodiscard]] const Along& position(Side side) const { return position_of(scene_.stops, side); }

  /// The first stretch to follow. A rest forgets all that went before, so that the course of a motion that rests is
  /// followed from a release on; any other begins at a section, with an unknown state. Motion that stands for ever
  /// stays at its place.
  std::size_t begin() {
    state_.phase = driven_.lead;
    if (pieces_.is_in_pieces() && !course_.empty()) state_.phase += pieces_.knot(course_.front());
    for (std::size_t i = 0; i < course_.size(); ++i)
      if (const Stretch& before = course_[(i + course_.size() - 1) % course_.size()];
          !course_[i].stands() && before.is_rest()) {
        forgets_ = stands_ = true, state_.x = position(before.end->side);
        return i;
      }
    forgets_ = std::ranges::all_of(course_, &Stretch::stands);
    if (!course_.empty())
      state_.x = Along(course_.front().start.x, by_x), state_.v = Along(course_.front().start.v, by_v);
    first_ = state_;
    return 0;
  }

  /// A time on a stop takes all energy that is left, and a stick the speed; friction has taken the energy by then.
  void stay(std::size_t i) {
    if (course_[i].is_rest()) {
      if (!stands_) lost_ += state_.v * state_.v / 2;
      state_.x = position(course_[i].end->side);
    }
    stands_ = true, state_.v = Along(0);
    each_place(i, [&](const Place& place) {
      Along x = state_.x;
      if (place.quarter >= 0) x += frame_.at(sine_cosine_of_turns(place.quarter / 4.0).sine, 0.0, 0.0).x;
      return x;
    });
  }
  /// The mass is released where the pull on it passes the level of friction, on a stop without friction 0 (eqs. 26 and
  /// 66).
  void release(const Stretch& stretch) {
    const motion::Motion<double>& m = stretch.start;
    Along needed = still_.spring(state_.x) - still_.load + sign_of(stretch.ahead) * slips_.static_level;
    if (stretch.pressed != Side::none) {
      const auto stop = motion::soft_stop_at<Along>(scene_.stops, stretch.pressed);
      needed += stop.stiffness * (state_.x - stop.position);
    }
    const Along sine = needed / still_.f;
    stands_ = false;
    if (pieces_.is_in_pieces()) {
      const bool by_jump = m.cosine == 0 || pieces_.begins_by_jump(stretch);
      const Along still = pieces_.at(stretch, Along(0)).sine;
      state_.phase = by_jump ? pieces_.knot(stretch) : with_slope_of(0, (sine - still) / m.cosine);
      if (by_jump) return;
    } else {
      const auto [still, slope] = still_.drive(SineCosine<Along>{m.sine, m.cosine});
      state_.phase = with_slope_of(0, (sine - still) / slope.value);
    }
    const double begins = slips_.release_acceleration(stretch.ahead).value;
    closes_ = closes_ && std::abs(m.a - begins) <= same * std::abs(still_.f.value);
  }

  void follow(std::size_t i) {
    const Stretch& stretch = course_[i];
    if (stands_) release(stretch);
    check(state_, stretch.start);
    const auto fly = [&](const auto& constants) { this->fly(i, constants); };
    if (stretch.pressed == Side::none)
      fly(slips_.towards(stretch.ahead));
    else
      slips_.in_contact(stretch.pressed, stretch.ahead, fly);
  }

  template <Effects of>
  void fly(std::size_t i, const motion::ArcConstants<Along, of>& constants) {
    const Stretch& stretch = course_[i];
    const Motion start =
        with_slopes_of(stretch, state_.x, state_.v, force_at(stretch, pieces_, state_.phase), constants);
    const motion::Arc<Along, of> arc(constants, start, Along(stretch.anchor));
    const Motion end = arc.at(Along(stretch.length));
    const Along& nu = scene_.oscillator.frequency;
    Along phase = state_.phase + with_slope_of(0, nu * stretch.length);
    const Along late = lateness(i, end, phase);
    const Along v = end.v + end.a * late;
    const State before = state_;
    const bool is_on_stop = stretch.end && stretch.end->kind == Event::Kind::impact;
    state_ = {is_on_stop ? position(stretch.end->side) : Along(end.x + end.v * late), v, phase + nu * late};
    lose(stretch, arc, end, late);
    each_place(i, [&](const Place& place) {
      if (place.s >= stretch.length)
        return frame_.displacement({end.offset, state_.x, v, end.a, end.sine, end.cosine}, state_.phase);
      if (!(place.s > 0)) return frame_.displacement(arc.start(), before.phase);
      return frame_.turning_point(arc.at(Along(place.s)), before.phase + with_slope_of(0, nu * place.s));
    });
    if (stretch.end) meet(*stretch.end);
  }

  /// By how much the end of a stretch comes later: the surface of its event (eqs. 4 and 50; of a slip the velocity), or
  /// the phase of a section or a knot of the force, over its rate of change. Its value is 0.
  [[nodiscard]] Along lateness(std::size_t i, const Motion& end, const Along& phase) const {
    const Stretch& stretch = course_[i];
    if (!stretch.end) {
      Along then = driven_.lead;
      if (pieces_.is_in_pieces()) then += pieces_.knot(course_[(i + 1) % course_.size()]);
      return with_slope_of(0, (then - phase) / scene_.oscillator.frequency.value);
    }
    return lateness_of(*stretch.end, end, stretch.anchor, scene_.stops);
  }

  [[nodiscard]] static bool ends_slip(const Event& event) {
    return event.kind == Event::Kind::stick || event.kind == Event::Kind::reversal;
  }

  /// What an event does with the velocity.
  void meet(const Event& event) {
    if (event.kind == Event::Kind::impact || event.kind == Event::Kind::touch) fastest_.see(event.side, state_.v);
    if (ends_slip(event)) state_.v = Along(0);
    if (event.kind != Event::Kind::impact) return;
    const Along after = restitution_at<Along>(scene_.stops, event.side).after(state_.v);
    lost_ += (state_.v * state_.v - after * after) / 2;
    state_.v = after;
  }

  /// The energy that soft stops take: in contact their dampers (eq. 54), and as they relax that of their springs.
  template <Effects of>
  void lose(const Stretch& stretch, const motion::Arc<Along, of>& arc, const Motion& end, const Along& late) {
    if (stretch.pressed != Side::none)
      lost_ += 2 * arc.constants().stop.damping * squares_of_velocity(arc, stretch.length, end, late);
    else if (has_soft_stop(span_.scene.stops))
      lost_ += stored_by_soft_stops(scene_.stops, arc.start().x) - stored_by_soft_stops(scene_.stops, state_.x);
  }

  template <class Displacement>
  void each_place(std::size_t i, const Displacement& displacement) {
    if (extremes_.least.is_in(i)) least_ = displacement(extremes_.least);
    if (extremes_.greatest.is_in(i)) greatest_ = displacement(extremes_.greatest);
  }

  /// A course whose stretches don't follow from each other has no derivatives.
  void check(const State& state, const motion::Motion<double>& next) {
    const double size = std::max(std::abs(next.x), std::abs(next.v));
    closes_ =
        closes_ && std::abs(state.x.value - next.x) <= same * size && std::abs(state.v.value - next.v) <= same * size;
  }

  [[nodiscard]] Sensitivity::ByKey result() {
    double x = 0, v = 0;  // how the state at the beginning changes with the key
    if (!forgets_) {
      check(state_, {.offset = 0, .x = first_.x.value, .v = first_.v.value, .a = 0, .sine = 0, .cosine = 0});
      if (!closes_) return {};
      const auto &a = state_.x.slope, &b = state_.v.slope;
      const double determinant = (1 - a[by_x]) * (1 - b[by_v]) - a[by_v] * b[by_x];
      const double rounding = 64 * std::numeric_limits<double>::epsilon();
      if (std::abs(determinant) <= rounding * (1 + std::abs(a[by_x])) * (1 + std::abs(b[by_v])))
        return {};  // without spring and stops it may be anywhere
      x = ((1 - b[by_v]) * a[by_key] + a[by_v] * b[by_key]) / determinant;
      v = ((1 - a[by_x]) * b[by_key] + b[by_x] * a[by_key]) / determinant;
    }
    const auto total = [&](const Along& y) { return y.slope[by_key] + y.slope[by_x] * x + y.slope[by_v] * v; };
    const Along period = 2 * pi<double>() * span_.turns / scene_.oscillator.frequency;
    return {total(least_),
            total(greatest_),
            total(period),
            {total(fastest_.of(Side::lower)), total(fastest_.of(Side::upper))},
            total(lost_ * mass_ / period)};
  }

  static constexpr double same = 1e-6;  ///< relative difference of states that are one

  const Course& course_;
  const ObservedSpan& span_;
  const Extremes& extremes_;
  const BasicScene<Along>& scene_;
  LeadingOscillator<Along> driven_;  ///< in the frame in which the motion is computed
  DualForce<Along> pieces_;
  DualFrame<Along> frame_;
  Along mass_;                            ///< over that of the units
  motion::ArcConstants<Along, E> still_;  ///< without friction
  motion::Slips<Along, E> slips_;
  State state_{}, first_{};
  bool stands_ = false, forgets_ = false, closes_ = true;
  Along least_{}, greatest_{}, lost_{};
  FastestContacts<Along> fastest_{};
};

/// Nothing is known of where a loose mass that begins would strike.
bool has_derivative(const BasicScene<Along>& scene) {
  return scene.loose.ratio.value != 0 || scene.loose.ratio.is_constant();
}

Sensitivity::ByKey derivative_by(Parameter key, const Course& course, const ObservedSpan& span,
                                 const Extremes& extremes) {
  auto given = with_numbers<Along>(*span.given);
  differentiate_by(given, key, by_key);
  const BasicScene<Along> scene = computed(given, span.units);
  if (!has_derivative(scene)) return {};
  return with_smooth_effects<true>(span.scene.oscillator, [&]<Effects E>() {
    return Walk<E>(course, span, extremes, scene, given.mass / span.units.mass).run();
  });
}

}  // namespace

std::vector<Sensitivity::ByKey> sensitivities(const Course& course, const ObservedSpan& span,
                                              const std::vector<Parameter>& keys) {
  std::vector<Sensitivity::ByKey> all;
  const Extremes extremes = extremes_of(course, span);
  const bool is_rough = has_friction(span.scene.friction);
  for (const Parameter key : keys) {
    if (is_rough || key.role() != Role::friction) {
      all.push_back(derivative_by(key, course, span, extremes));
    } else {  // from 0 on
      const Course slips = divided_into_slips(course, span);
      all.push_back(derivative_by(key, slips, span, extremes_of(slips, span)));
    }
  }
  return all;
}

}  // namespace clatter::observables
