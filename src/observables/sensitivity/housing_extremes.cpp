#include "observables/sensitivity/housing_extremes.hpp"

#include "motion/arc.hpp"
#include "motion/walls.hpp"
#include "observables/extremes/absolute_arc.hpp"
#include "observables/extremes/loose_arc.hpp"
#include "observables/extremes/range.hpp"
#include "observables/extremes/range_search.hpp"
#include "observables/sensitivity/main_oscillators.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::observables {
namespace {

/// One of the three, stretch by stretch.
class Search {
 public:
  Search(const ObservedSpan& span, Extremes& extremes) : span_(span), extremes_(extremes) {}

  /// Of a stretch with an index; of something that is `apart` from what moves along the arc.
  template <class A>
  void look_at(std::size_t i, double length, const A& arc, double apart = 0.0) {
    Range range{extremes_.least.x - apart, extremes_.greatest.x - apart};
    const auto see = [&](const motion::Motion<double>& m, double s) {
      range.include(m.x), extremes_.see({m.x + apart, i, s}, s > 0 && s < length ? span_.uncertainty : 0.0);
    };
    RangeSearch(arc, length, see).exceed(DisplacementOnArc{}, range);
  }
  /// Of a stretch with an index, in the frame that the run observes in.
  template <class A>
  void look_at(const Stretch& stretch, std::size_t i, const A& arc, double apart = 0.0) {
    if (!span_.frame) return look_at(i, stretch.length, arc, apart);
    look_at(i, stretch.length, AbsoluteArc(arc, *span_.frame, Stops{}, stretch.begin), apart);
  }

 private:
  const ObservedSpan& span_;
  Extremes& extremes_;
};

template <Effects E>
HousingExtremes extremes_of_both(const Course& course, const ObservedSpan& span) {
  const MainOscillators<double, E> oscillators(motion::ArcConstants<double, E>(span.scene.oscillator), span.scene);
  HousingExtremes extremes;
  Search x(span, extremes.x), y(span, extremes.y), z(span, extremes.z);
  for (std::size_t i = 0; i < course.size(); ++i) {
    const Stretch& stretch = course[i];
    if (!(stretch.length > 0)) continue;
    oscillators.in_stretch(stretch, [&](const auto& constants) {
      const motion::Arc main(constants, stretch.start, stretch.anchor);
      x.look_at(stretch, i, main);
      if (stretch.carries) {
        const double place = stretch.loose.origin + stretch.loose.offset;
        y.look_at(stretch, i, main, place), extremes.z.see({place, i});
      } else {
        const motion::RelativeArc arc(main, stretch.loose, motion::load_of_slide(span.scene.loose, stretch.slides_to));
        y.look_at(stretch, i, LooseArc(arc)), z.look_at(i, stretch.length, arc);
      }
    });
  }
  return extremes;
}

}  // namespace

HousingExtremes extremes_in_housing(const Course& course, const ObservedSpan& span) {
  return with_smooth_effects<true>(span.scene.oscillator,
                                   [&]<Effects E>() { return extremes_of_both<E>(course, span); });
}

}  // namespace clatter::observables
