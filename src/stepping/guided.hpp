#pragma once

#include "motion/guided_contact.hpp"
#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {

/// The first contact of an arc in numbers with more digits than double has, proved in double if it can be.
template <class Number, Effects E>
class GuidedSearch {
 public:
  GuidedSearch(const motion::ArcConstants<Number, E>& constants, const BasicStops<Number>& stops)
      : guide_(constants, stops) {}

  [[nodiscard]] motion::Crossing<Number> operator()(const motion::Arc<Number, E>& arc, const BasicStops<Number>& stops,
                                                    const Number& horizon) const {
    const auto guided = guide_.first(arc, horizon);
    return guided ? *guided : next_contact(arc, stops, horizon);
  }

 private:
  motion::GuidedContact<Number, E> guide_;
};

/// `Exact` for motion that double has found: the first contact of most flights is proved in double, and only its
/// instant is computed in all digits, which takes a tenth of the time. The reference of `clatter accuracy` doesn't use
/// this, since it has to be independent of double.
template <class Number, Effects E>
using Guided = Exact<Number, E, GuidedSearch<Number, E.arc()>>;

}  // namespace clatter::stepping
