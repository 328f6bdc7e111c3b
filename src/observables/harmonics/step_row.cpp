#include "observables/harmonics/step_row.hpp"

namespace clatter::observables {

// One source for both instruction sets. A sample has the same operations in each, none of them fused, and so the same
// bits.
[[gnu::always_inline]] inline void StepRow::take_here(const motion::Motion<double>& from, double anchor,
                                                      const Stops& stops, double* x, double* v) const {
  double* __restrict places = x;
  double* __restrict velocities = v;
  const double sine = from.sine, cosine = from.cosine, free_x = from.free_x, free_v = from.free_v;
  const double offset = from.offset, lower = stops.lower, upper = stops.upper;
  for (std::size_t i = 0; i < size; ++i) {
    const double response = x_.sine[i] * sine + x_.cosine[i] * cosine;
    const double free = x_.free_x[i] * free_x + x_.free_v[i] * free_v;
    const double place = anchor + (offset + (free + response + x_.constant[i]));
    const double above = lower > place ? lower : place;
    places[i] = upper < above ? upper : above;
    velocities[i] =
        (v_.sine[i] * sine + v_.cosine[i] * cosine) + (v_.free_x[i] * free_x + v_.free_v[i] * free_v) + v_.constant[i];
  }
}
[[gnu::target("avx2")]] void StepRow::take_by_avx2(const motion::Motion<double>& from, double anchor,
                                                   const Stops& stops, double* x, double* v) const {
  take_here(from, anchor, stops, x, v);
}

void StepRow::take(const motion::Motion<double>& from, double anchor, const Stops& stops, double* x, double* v) const {
  static const bool has_avx2 = __builtin_cpu_supports("avx2");
  if (has_avx2) return take_by_avx2(from, anchor, stops, x, v);
  take_here(from, anchor, stops, x, v);
}

}  // namespace clatter::observables
