#include "observables/sensitivity/course_extremes.hpp"

#include "motion/arc.hpp"
#include "motion/dry_friction.hpp"
#include "observables/extremes/absolute_arc.hpp"
#include "observables/extremes/range.hpp"
#include "observables/extremes/range_search.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::observables {
namespace {

template <Effects E>
Extremes extremes_with(const Course& course, const ObservedSpan& span) {
  const motion::ArcConstants<double, E> constants(span.scene.oscillator);
  const motion::Slips<double, E> slips(constants, span.scene.friction, span.scene.stops);
  Extremes extremes;
  Range range;
  std::size_t i = 0;
  const auto search = [&](const auto& arc) {
    // an instant beside an impact is no turning point, though by rounding it may lie beyond the stop
    const auto see = [&](const motion::Motion<double>& m, double s) {
      range.include(m.x), extremes.see({m.x, i, s}, s > 0 && s < course[i].length ? span.uncertainty : 0.0);
    };
    RangeSearch(arc, course[i].length, see).exceed(DisplacementOnArc{}, range);
  };
  const auto look_at = [&]<Effects of>(const motion::ArcConstants<double, of>& of_arc) {
    const motion::Arc<double, of> arc(of_arc, course[i].start, course[i].anchor);
    if (!span.frame) return search(arc);
    search(AbsoluteArc(arc, *span.frame, span.scene.stops, course[i].begin));
  };
  const auto look_at_rest = [&](double position) {
    if (!span.frame) return extremes.see({position, i});
    for (const int quarter : {1, 3})
      if (span.frame->passes(quarter, course[i].begin, course[i].length))
        extremes.see({position + span.frame->displacement(sine_cosine_of_turns(quarter / 4.0)), i, 0.0, quarter});
  };
  for (; i < course.size(); ++i) {
    if (course[i].stands())
      look_at_rest(course[i].start.x);
    else if (course[i].length > 0 && course[i].pressed != Side::none)
      slips.in_contact(course[i].pressed, course[i].ahead, look_at);
    else if (course[i].length > 0)
      look_at(slips.towards(course[i].ahead));
  }
  return extremes;
}

}  // namespace

Extremes extremes_of(const Course& course, const ObservedSpan& span) {
  return with_smooth_effects<true>(span.scene.oscillator, [&]<Effects E>() { return extremes_with<E>(course, span); });
}

}  // namespace clatter::observables
