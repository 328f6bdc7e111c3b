#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "math/dual.hpp"
#include "motion/arc.hpp"
#include "motion/linear_maps.hpp"
#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"
#include "observables/sensitivity/course_slips.hpp"
#include "observables/sensitivity/dual_motion.hpp"
#include "observables/sensitivity/housing_extremes.hpp"
#include "observables/sensitivity/housing_instants.hpp"
#include "observables/sensitivity/main_oscillators.hpp"
#include "observables/sensitivity/sensitivity_observer.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::observables {
namespace {

/// By x, x', z and z' at the beginning of the period, and by the key.
using Along = Dual<double, 5>;
constexpr std::size_t by_x = 0, by_v = 1, by_z = 2, by_w = 3, by_key = 4;

/// Follows a course with a loose mass on numbers that carry derivatives. Where a stretch ends is known; by how much
/// that instant changes follows from the surface of its event, to first order.
template <Effects E>
class HousingWalk {
 public:
  HousingWalk(const Course& course, const ObservedSpan& span, const HousingExtremes& extremes,
              const BasicScene<Along>& scene, const Along& mass)
      : course_(course),
        span_(span),
        extremes_(extremes),
        scene_(scene),
        driven_(with_force_on_ground(scene.oscillator, scene.shaking)),
        pieces_(span, scene),
        frame_(span, scene, driven_.lead),
        mass_(mass),
        oscillators_(motion::ArcConstants<Along, E>::of(driven_.oscillator.damping, driven_.oscillator.forcing,
                                                        driven_.oscillator.frequency, driven_.oscillator.load,
                                                        driven_.oscillator.stiffness, driven_.oscillator.shape),
                     scene),
        instants_(course, span, scene, oscillators_, pieces_, driven_.lead),
        rule_(scene.loose),
        has_stops_(has_events_of_its_own(span.scene)) {}

  Sensitivity::ByKey run() {
    if (is_neutral()) return {};
    begin(course_.front());
    for (std::size_t i = 0; i < course_.size(); ++i) {
      if (course_[i].is_held) hold(course_[i]);
      check(course_[i]);
      oscillators_.in_stretch(course_[i], [&](const auto& constants) {
        if (course_[i].carries)
          carry(i, constants);
        else
          fly(i, constants);
      });
    }
    check(course_.front());
    return closes_ ? result() : Sensitivity::ByKey{};
  }

 private:
  using Motion = motion::Motion<Along>;

  struct State {
    Along x, v, z, w;
    Along phase;  ///< of the force; of it only the derivatives count
  };

  using Kind = motion::Event::Kind;

  /// Whether no wall meets the loose mass, which is then the same motion wherever it is.
  [[nodiscard]] bool is_neutral() const {
    return std::ranges::all_of(course_, [](const Stretch& stretch) {
      const auto strikes = [](const motion::Event& event) { return event.kind == Kind::strike; };
      return stretch.wall == Side::none && std::ranges::none_of(stretch.ends, strikes);
    });
  }
  [[nodiscard]] Along place(Side wall) const { return wall == Side::upper ? scene_.loose.upper : scene_.loose.lower; }
  [[nodiscard]] const Along& position(Side stop) const { return position_of(scene_.stops, stop); }

  /// At a section, in an unknown state. A wall that presses the loose mass leaves nothing of z and z', friction that
  /// holds it nothing of z'.
  void begin(const Stretch& first) {
    const motion::RelativeStart<double>& loose = first.loose;
    state_ = {Along(first.start.x, by_x), Along(first.start.v, by_v), Along(loose.origin + loose.offset, by_z),
              Along(loose.w, by_w), driven_.lead};
    if (pieces_.is_in_pieces()) state_.phase += pieces_.knot(first);
    if (first.wall != Side::none) state_.z = place(first.wall);
    if (first.carries) state_.w = Along(0);
    if (first.is_held) stop(first.held_on);
  }

  /// The main mass is held from here on, if it isn't yet: on a stop, which takes what energy is left, or by friction.
  void hold(const Stretch& stretch) {
    if (state_.v.value == 0 && state_.v.is_constant()) return;
    if (stretch.held_on != Side::none) lost_ += state_.v * state_.v / 2;
    if (!stretch.carries) state_.w += state_.v;
    stop(stretch.held_on);
  }
  void stop(Side on) {
    state_.v = Along(0);
    if (on != Side::none) state_.x = position(on);
  }

  template <Effects of>
  void fly(std::size_t i, const motion::ArcConstants<Along, of>& constants) {
    const Stretch& stretch = course_[i];
    const motion::Arc<Along, of> main(constants, start_of(stretch, constants), Along(stretch.anchor));
    const motion::RelativeArc<Along, of> arc(main, start_of(stretch.loose),
                                             motion::load_of_slide(scene_.loose, stretch.slides_to));
    const Motion end = main.at(Along(stretch.length)), there = arc.at(Along(stretch.length));
    const State before = state_;
    const Along late =
        instants_.lateness(i, {end, there, constants.jerk(end).value}, state_.x, phase_after(state_, stretch.length));
    pass(stretch, end, late);
    const bool strikes = !stretch.ends.empty() && stretch.ends.front().kind == Kind::strike;
    state_.z = strikes ? place(stretch.ends.front().side) : there.x + there.v * late;
    state_.w = there.v + there.a * late;
    lose(stretch, main, before, end, late);
    see(i, before, end, [&](const Along& s) { return Both{main.at(s), arc.at(s)}; });
    for (const motion::Event& event : stretch.ends) meet(event, false);
  }

  /// Both masses as one. Without friction x'' is the same before and after the wall would have to pull (eq. 72), so
  /// that a release a little later changes nothing to first order: it counts as if it came at a phase of the force,
  /// like a section.
  template <Effects of>
  void carry(std::size_t i, const motion::ArcConstants<Along, of>& constants) {
    const Stretch& stretch = course_[i];
    const motion::Arc<Along, of> arc(constants, start_of(stretch, constants), Along(stretch.anchor));
    const Motion end = arc.at(Along(stretch.length));
    const State before = state_;
    const Along late =
        instants_.lateness(i, {end, end, constants.jerk(end).value}, state_.x, phase_after(state_, stretch.length));
    pass(stretch, end, late);
    if (stretch.wall != Side::none) state_.z = place(stretch.wall);
    state_.w = Along(0);
    lose(stretch, arc, before, end, late);
    see(i, before, end, [&](const Along& s) {
      return Both{arc.at(s), {.offset = 0, .x = state_.z, .v = 0, .a = 0, .sine = 0, .cosine = 0}};
    });
    for (const motion::Event& event : stretch.ends) meet(event, true);
  }

  template <Effects of>
  [[nodiscard]] Motion start_of(const Stretch& stretch, const motion::ArcConstants<Along, of>& constants) const {
    return with_slopes_of(stretch, state_.x, state_.v, force_at(stretch, pieces_, state_.phase), constants);
  }
  [[nodiscard]] motion::RelativeStart<Along> start_of(const motion::RelativeStart<double>& loose) const {
    return {Along(loose.origin), with_slope_of(loose.offset, state_.z), with_slope_of(loose.w, state_.w),
            with_slope_of(loose.v, state_.w + state_.v)};
  }

  [[nodiscard]] Along phase_after(const State& from, double s) const {
    return from.phase + with_slope_of(0, scene_.oscillator.frequency * s);
  }
  /// To the end of a stretch.
  void pass(const Stretch& stretch, const Motion& end, const Along& late) {
    state_.phase = phase_after(state_, stretch.length) + scene_.oscillator.frequency * late;
    const bool is_on_stop = !stretch.ends.empty() && stretch.ends.front().kind == Kind::impact;
    if (!stretch.is_held)
      state_.x = is_on_stop ? position(stretch.ends.front().side) : end.x + end.v * late,
      state_.v = end.v + end.a * late;
  }

  /// The velocity of the main mass becomes another one. A loose mass keeps its own, y'.
  void change(const Along& v) { state_.w += state_.v - v, state_.v = v; }

  /// What an event does with the velocities, of both masses as one or of two. Where there are stops, speeds are those
  /// of their contacts, else of those of the walls.
  void meet(const motion::Event& event, bool as_one) {
    switch (event.kind) {
      case Kind::impact: {
        fastest_.see(event.side, state_.v);
        const Along after = restitution_at<Along>(scene_.stops, event.side).after(state_.v);
        lost_ += (state_.v * state_.v - after * after) / 2;
        return change(after);
      }
      case Kind::touch:
        return fastest_.see(event.side, state_.v);
      case Kind::reversal:
      case Kind::stick:
        if (as_one) return void(state_.v = Along(0));
        return change(Along(0));
      case Kind::strike: {  // eq. 70
        if (!has_stops_) fastest_.see(event.side, state_.w);
        const Along after = rule_.law_for(state_.w).after(state_.w);
        lost_ += rule_.loss(state_.w, after);
        state_.v = rule_.main_after(state_.v, state_.w), state_.w = after;
        return;
      }
      case Kind::press:  // what is left of a chatter is lost
        lost_ += rule_.loss(state_.w, Along(0));
        state_.v = rule_.main_with(state_.v, state_.w), state_.w = Along(0);
        return;
      default:
        return;
    }
  }

  /// The energy that soft stops take: in contact their dampers (eq. 54), and as they relax that of their springs.
  template <Effects of>
  void lose(const Stretch& stretch, const motion::Arc<Along, of>& arc, const State& before, const Motion& end,
            const Along& late) {
    if (!has_soft_stop(span_.scene.stops) || stretch.is_held) return;
    if (stretch.pressed == Side::none) {
      lost_ += stored_by_soft_stops(scene_.stops, before.x) - stored_by_soft_stops(scene_.stops, state_.x);
      return;
    }
    const Along damping = motion::soft_stop_at<Along>(scene_.stops, stretch.pressed).damping;
    lost_ += 2 * damping * squares_of_velocity(arc, stretch.length, end, late);
  }

  /// The main mass, and the place of the loose one.
  struct Both {
    Motion main, z;
  };
  using Least = std::array<Along, 2>;  ///< and greatest

  /// Takes the extremes that lie in a stretch; `at(s)` gives both masses at an instant within it.
  template <class At>
  void see(std::size_t i, const State& before, const Motion& end, const At& at) {
    const auto seen = [&](const Place& place, const auto& of) -> Along {
      const Stretch& stretch = course_[i];
      if (place.s > 0 && place.s < stretch.length) return of(at(Along(place.s)), phase_after(before, place.s), true);
      const bool is_end = place.s > 0;
      const State& state = is_end ? state_ : before;
      const double sine = is_end ? end.sine.value : stretch.start.sine,
                   cosine = is_end ? end.cosine.value : stretch.start.cosine;
      const auto still = [&](const Along& x) { return Motion{0, x, 0, 0, sine, cosine}; };
      return of(Both{still(state.x), still(state.z)}, state.phase, false);
    };
    const auto take = [&](const Extremes& extremes, Least& found, const auto& of) {
      if (extremes.least.is_in(i)) found[0] = seen(extremes.least, of);
      if (extremes.greatest.is_in(i)) found[1] = seen(extremes.greatest, of);
    };
    const auto in_frame = [&](const Motion& m, const Along& phase, bool turns) {
      return turns ? frame_.turning_point(m, phase) : frame_.displacement(m, phase);
    };
    take(extremes_.x, x_,
         [&](const Both& m, const Along& phase, bool turns) { return in_frame(m.main, phase, turns); });
    take(extremes_.y, y_, [&](const Both& m, const Along& phase, bool turns) {
      Motion y = m.main;
      y.x += m.z.x, y.v += m.z.v, y.a += m.z.a;
      return in_frame(y, phase, turns);
    });
    take(extremes_.z, z_, [&](const Both& m, const Along&, bool turns) {
      return turns ? DualFrame<Along>::turning_point(m.z.x, m.z.v, m.z.a) : m.z.x;
    });
  }

  /// A course whose stretches don't follow from each other has no derivatives.
  void check(const Stretch& next) {
    const motion::RelativeStart<double>& loose = next.loose;
    const double z = loose.origin + loose.offset, w = loose.w;
    const motion::Motion<double>& main = next.start;
    const double size = std::max({std::abs(main.x), std::abs(main.v), std::abs(z), std::abs(w)});
    const auto is_same = [&](const Along& one, double other) { return std::abs(one.value - other) <= same * size; };
    closes_ = closes_ && is_same(state_.x, main.x) && is_same(state_.v, main.v) && is_same(state_.z, z) &&
              is_same(state_.w, w);
  }

  [[nodiscard]] Sensitivity::ByKey result() const {
    motion::LooseJacobian map;
    motion::Four<double> by_number;
    for (std::size_t row = 0; const Along* end : {&state_.x, &state_.v, &state_.z, &state_.w}) {
      std::copy_n(end->slope.begin(), by_number.size(), map[row].begin());
      by_number[row++] = end->slope[by_key];
    }
    const auto change = motion::change_of_fixed_point(map, by_number);
    const auto total = [&](const Along& y) {
      double sum = y.slope[by_key];
      for (std::size_t i = 0; i < change.size(); ++i) sum += y.slope[i] * change[i];
      return sum;
    };
    const Along period = 2 * pi<double>() * span_.turns / scene_.oscillator.frequency;
    return {.x_min = total(x_[0]),
            .x_max = total(x_[1]),
            .period = total(period),
            .impact_speed = {total(fastest_.of(Side::lower)), total(fastest_.of(Side::upper))},
            .impact_power = total(lost_ * mass_ / period),
            .y_min = total(y_[0]),
            .y_max = total(y_[1]),
            .z_min = total(z_[0]),
            .z_max = total(z_[1])};
  }

  static constexpr double same = 1e-6;  ///< relative difference of states that are one

  const Course& course_;
  const ObservedSpan& span_;
  const HousingExtremes& extremes_;
  const BasicScene<Along>& scene_;
  LeadingOscillator<Along> driven_;  ///< in the frame in which the motion is computed
  DualForce<Along> pieces_;
  DualFrame<Along> frame_;
  Along mass_;  ///< over that of the units
  MainOscillators<Along, E> oscillators_;
  HousingInstants<Along, E> instants_;
  motion::WallRule<Along> rule_;
  bool has_stops_;  ///< or friction, of the main mass
  State state_{};
  bool closes_ = true;
  Least x_{}, y_{}, z_{};
  Along lost_{};
  FastestContacts<Along> fastest_{};
};

}  // namespace

std::vector<Sensitivity::ByKey> sensitivities_in_housing(const Course& course, const ObservedSpan& span,
                                                         const std::vector<Parameter>& keys) {
  std::vector<Sensitivity::ByKey> all;
  const HousingExtremes extremes = extremes_in_housing(course, span);
  const auto by = [&](Parameter key, const Course& of_key, const HousingExtremes& farthest) {
    auto given = with_numbers<Along>(*span.given);
    differentiate_by(given, key, by_key);
    const BasicScene<Along> scene = computed(given, span.units);
    all.push_back(with_smooth_effects<true>(span.scene.oscillator, [&]<Effects E>() {
      return HousingWalk<E>(of_key, span, farthest, scene, given.mass / span.units.mass).run();
    }));
  };
  for (const Parameter key : keys) {
    const bool is_rough = key.is_loose() ? has_loose_friction(span.scene.loose) : has_friction(span.scene.friction);
    if (is_rough || key.role() != Role::friction) {
      by(key, course, extremes);
    } else {  // from 0 on
      const Course slips = divided_into_slips(course, span, key.is_loose());
      by(key, slips, extremes_in_housing(slips, span));
    }
  }
  return all;
}

}  // namespace clatter::observables
