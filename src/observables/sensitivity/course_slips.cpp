#include "observables/sensitivity/course_slips.hpp"

#include <array>

#include "motion/first_crossing.hpp"
#include "motion/slide_rule.hpp"
#include "observables/sensitivity/main_oscillators.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::observables {
namespace {

/// The side to which a mass moves from an instant on: by its velocity, acceleration or, as it is released, its force,
/// which moves a loose mass in its housing the other way.
template <Effects E>
Side ahead_of(const motion::Motion<double>& m, const motion::ArcConstants<double, E>& constants, double sign = 1) {
  const double way = m.v != 0 ? m.v : m.a != 0 ? m.a : sign * constants.f * constants.drive(m).cosine;
  return way > 0 ? Side::upper : Side::lower;
}

/// Appends the slips of a stretch.
template <Effects E>
void divide(Stretch rest, const motion::ArcConstants<double, E>& constants, const ObservedSpan& span, bool of_loose,
            Course& slips) {
  for (;;) {
    const motion::Arc<double, E> main(constants, rest.start, rest.anchor);
    const motion::RelativeArc<double, E> beside(main, rest.loose, span.scene.loose.load);
    Side& ahead = of_loose ? rest.slides_to : rest.ahead;
    ahead = of_loose ? ahead_of(beside.start(), constants, -1) : ahead_of(rest.start, constants);
    const motion::Margin<double> forward{0.0, 0.0, static_cast<double>(sign_of(ahead))};
    const auto turn = of_loose ? motion::end_of_slide(beside, ahead, rest.length)
                               : motion::first_crossing(main, std::array{forward}, rest.length);
    if (!turn.resolved || turn.margin != 0 || !(turn.elapsed > 0)) break;
    slips.push_back(rest);
    slips.back().length = turn.elapsed;
    if (of_loose)
      slips.back().ends.clear();
    else
      slips.back().end = motion::Event{.kind = motion::Event::Kind::reversal}, slips.back().ends = {*slips.back().end};
    const motion::Motion<double> there = beside.at(turn.elapsed);
    rest.start = main.at(turn.elapsed);
    rest.loose = {rest.loose.origin, there.offset, there.v, beside.velocity(turn.elapsed)};
    (of_loose ? rest.loose.w : rest.start.v) = 0;
    rest.begin += turn.elapsed, rest.length -= turn.elapsed;
  }
  slips.push_back(rest);
}

template <Effects E>
Course divided(const Course& course, const ObservedSpan& span, bool of_loose) {
  const MainOscillators<double, E> oscillators(motion::ArcConstants<double, E>(span.scene.oscillator), span.scene);
  Course slips;
  for (const Stretch& stretch : course) {
    const bool stands = of_loose ? stretch.carries : stretch.stands() || stretch.is_held;
    if (stands || !(stretch.length > 0))
      slips.push_back(stretch);
    else
      oscillators.in_stretch(stretch, [&](const auto& of_arc) { divide(stretch, of_arc, span, of_loose, slips); });
  }
  return slips;
}

}  // namespace

Course divided_into_slips(const Course& course, const ObservedSpan& span, bool of_loose) {
  return with_smooth_effects<true>(span.scene.oscillator,
                                   [&]<Effects E>() { return divided<E>(course, span, of_loose); });
}

}  // namespace clatter::observables
