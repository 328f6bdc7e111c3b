#include "observables/sensitivity/course_slips.hpp"

#include <array>

#include "motion/first_crossing.hpp"
#include "motion/soft_contact.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::observables {
namespace {

/// The side to which a mass moves from an instant on: by its velocity, acceleration or, as it is released, its force.
template <Effects E>
Side ahead_of(const motion::Motion<double>& m, const motion::ArcConstants<double, E>& constants) {
  const double way = m.v != 0 ? m.v : m.a != 0 ? m.a : constants.f * m.cosine;
  return way > 0 ? Side::upper : Side::lower;
}

/// Appends the slips of a stretch.
template <Effects E>
void divide(Stretch rest, const motion::ArcConstants<double, E>& constants, Course& slips) {
  for (;;) {
    rest.ahead = ahead_of(rest.start, constants);
    const motion::Arc<double, E> arc(constants, rest.start, rest.anchor);
    const motion::Margin<double> forward{0.0, 0.0, static_cast<double>(sign_of(rest.ahead))};
    const auto turn = motion::first_crossing(arc, std::array{forward}, rest.length);
    if (!turn.resolved || turn.margin != 0 || !(turn.elapsed > 0)) break;
    slips.push_back(rest);
    slips.back().length = turn.elapsed;
    slips.back().end = motion::Event{.kind = motion::Event::Kind::reversal};
    rest.start = turn.motion, rest.start.v = 0;
    rest.begin += turn.elapsed, rest.length -= turn.elapsed;
  }
  slips.push_back(rest);
}

template <Effects E>
Course divided(const Course& course, const ObservedSpan& span) {
  const motion::ArcConstants<double, E> constants(span.scene.oscillator);
  const motion::SoftContact<double> contact(constants, span.scene.stops);
  Course slips;
  for (const Stretch& stretch : course) {
    const auto divide_it = [&](const auto& of_arc) { divide(stretch, of_arc, slips); };
    if (stretch.stands() || !(stretch.length > 0))
      slips.push_back(stretch);
    else if (stretch.pressed != Side::none)
      contact.with_constants(stretch.pressed, divide_it);
    else
      divide_it(constants);
  }
  return slips;
}

}  // namespace

Course divided_into_slips(const Course& course, const ObservedSpan& span) {
  return with_smooth_effects<true>(span.scene.oscillator, [&]<Effects E>() { return divided<E>(course, span); });
}

}  // namespace clatter::observables
