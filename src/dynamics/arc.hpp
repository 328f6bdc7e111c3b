#pragma once

#include <array>
#include <cmath>
#include <limits>

#include "dynamics/flow.hpp"

namespace clatter {

/// Motion without impact from a given instant on, in closed form (eq. 3).
template <class N, Effects E>
class Arc {
 public:
  using Number = N;

  /// Starts at displacement x, velocity v, phase (sine, cosine) and acceleration a, which the equation of motion gives
  /// or a release makes 0.
  Arc(const Flow<Number, E>& flow, const Motion<Number>& start) : Arc(flow, start, start.x) {}

  /// Starts `start.rise` away from a place.
  Arc(const Flow<Number, E>& flow, const Motion<Number>& start, const Number& anchor)
      : flow_(&flow), anchor_(anchor), start_(with_free_part(start)) {}

  [[nodiscard]] const Flow<Number, E>& flow() const { return *flow_; }
  [[nodiscard]] const Motion<Number>& start() const { return start_; }
  [[nodiscard]] const Number& anchor() const { return anchor_; }  ///< the place that `rise` counts from

  /// Motion a time s >= 0 after the start; for short times by Taylor's series, which keeps the relative accuracy of
  /// `rise`.
  [[nodiscard]] Motion<Number> at(const Number& s) const {
    return s * flow_->rate <= Number(0.25) ? near(start_, s) : closed_form(s);
  }

  /// The forcing phase a time s after the start.
  [[nodiscard]] SineCosine<Number> phase_after(const Number& s) const { return turned(start_, flow_->nu * s).phase; }

  /// Motion a short time d after `m` (d * flow().rate <= 1/4), an instant of this arc, by Taylor's series of the
  /// equation of motion.
  [[nodiscard]] Motion<Number> near(const Motion<Number>& m, const Number& d) const;

 private:
  [[nodiscard]] Motion<Number> closed_form(const Number& s) const;
  [[nodiscard]] Motion<Number> with_free_part(Motion<Number> m) const {
    m.free_x = flow_->offset(m.x, anchor_, m.rise) - flow_->response_displacement(m.sine, m.cosine),
    m.free_v = m.v - flow_->response_velocity(m.sine, m.cosine);
    if constexpr (E.damping == Damping::heavy) m.fast_x = flow_->fast_mode(m.free_x, m.free_v);
    return m;
  }
  /// A forcing phase and what it differs from the one before by.
  struct Turned {
    SineCosine<Number> phase, change;
  };
  [[nodiscard]] Turned turned(const Motion<Number>& m, const Number& angle) const;
  [[nodiscard]] std::array<Number, 2> response_from_rest(const Number& s) const;

  const Flow<Number, E>* flow_;
  Number anchor_;
  Motion<Number> start_;
};

template <class Number, Effects E>
auto Arc<Number, E>::turned(const Motion<Number>& m, const Number& angle) const -> Turned {
  using std::cos, std::sin;
  if constexpr (E.forcing == Forcing::none) return {{m.sine, m.cosine}, {Number(0), Number(0)}};
  const Number half = sin(angle / 2), s = 2 * half * cos(angle / 2), c = -2 * half * half;  // sin and cos - 1
  const SineCosine<Number> change{m.sine * c + m.cosine * s, m.cosine * c - m.sine * s};
  return {{m.sine + change.sine, m.cosine + change.cosine}, change};
}

template <class Number, Effects E>
Motion<Number> Arc<Number, E>::closed_form(const Number& s) const {
  using std::abs, std::exp;
  const Propagator<Number> p = flow_->propagator(s);
  const auto [phase, change] = turned(start_, flow_->nu * s);
  const Number forced_x = flow_->response_displacement(phase.sine, phase.cosine);
  // no difference of places, so that a short flight keeps its digits; the response is linear in sine and cosine
  Number rise =
      p.a_rise * start_.free_x + p.b * start_.free_v + flow_->response_displacement(change.sine, change.cosine);
  Number free_x = p.a * start_.free_x + p.b * start_.free_v, free_v = p.c * start_.free_v - p.b * start_.free_x;
  if constexpr (E.forcing == Forcing::secular) {
    const auto [response_x, response_v] = response_from_rest(s);
    rise += flow_->f * response_x, free_x += flow_->f * response_x, free_v += flow_->f * response_v;
  }
  rise += start_.rise;
  // of two sums for the place the one with the smaller terms: between close stops that is the rise
  const Number whole = abs(flow_->load) + abs(forced_x) + abs(free_x);
  const bool rises = abs(anchor_) + abs(rise) < whole;
  const Number x = rises ? anchor_ + rise : flow_->load + forced_x + free_x;
  const Number v = flow_->response_velocity(phase.sine, phase.cosine) + free_v;
  const Number a = E.forcing == Forcing::secular
                       ? flow_->acceleration(rises ? flow_->offset(x, anchor_, rise) : free_x, v, phase.sine)
                       : Number(-(p.c * start_.free_x + p.d * start_.free_v) - flow_->nu * flow_->nu * forced_x);
  Number fast_x = 0;
  if constexpr (E.damping == Damping::heavy) fast_x = start_.fast_x * exp(-flow_->fast * s);
  return {rise, x, v, a, phase.sine, phase.cosine, free_x, free_v, fast_x};
}

/// (e^z - 1)/z for z = re + i im with re <= 0, to relative accuracy for every z: the divided difference of the
/// exponential.
template <class Number>
[[nodiscard]] std::array<Number, 2> divided_exponential(const Number& re, const Number& im) {
  using std::cos, std::exp, std::expm1, std::sin, std::sqrt;
  const Number square = re * re + im * im;
  if (square < sqrt(epsilon<Number>())) {  // 1 + z/2 + z^2/6 + z^3/24: the next term is below rounding
    const Number re2 = (re - im) * (re + im), im2 = 2 * re * im;
    return {1 + re / 2 + re2 / 6 + (re * re2 - im * im2) / 24, im / 2 + im2 / 6 + (re * im2 + im * re2) / 24};
  }
  const Number half = sin(im / 2), u = expm1(re) * cos(im) - 2 * half * half, w = exp(re) * sin(im);
  return {(u * re + w * im) / square, (w * re - u * im) / square};
}

/// Displacement and velocity that sin(phase) alone gives after a time s, from rest: Im(e^{i phase} w(s)) with
/// w(s) = [E(mu) - E(mu*)]/(2 i lambda), E(mu) = (e^{i nu s} - e^{mu s})/(i nu - mu), mu = -h + i lambda; no difference
/// of large numbers.
template <class Number, Effects E>
std::array<Number, 2> Arc<Number, E>::response_from_rest(const Number& s) const {
  using std::cos, std::exp, std::sin;
  const Number &h = flow_->h, &lambda = flow_->root, &nu = flow_->nu;
  const Number c = cos(nu * s), d = sin(nu * s);
  const auto [q_re, q_im] = divided_exponential<Number>(-h * s, -flow_->detuning * s);
  const Number near_re = s * (c * q_re - d * q_im), near_im = s * (c * q_im + d * q_re);  // E(mu)
  const Number decay = exp(-h * s), top_re = c - decay * cos(lambda * s), top_im = d + decay * sin(lambda * s);
  const Number sum = nu + lambda, square = h * h + sum * sum;
  const Number far_re = (top_re * h + top_im * sum) / square, far_im = (top_im * h - top_re * sum) / square;  // E(mu*)
  const Number minus_re = near_re - far_re, minus_im = near_im - far_im, plus_re = near_re + far_re,
               plus_im = near_im + far_im;
  const Number w_re = minus_im / (2 * lambda), w_im = -minus_re / (2 * lambda);
  const Number rate_re = plus_re / 2 - h * w_re,
               rate_im = plus_im / 2 - h * w_im;  // [mu E(mu) - mu* E(mu*)]/(2 i lambda)
  return {start_.cosine * w_im + start_.sine * w_re, start_.cosine * rate_im + start_.sine * rate_re};
}

template <class Number, Effects E>
Motion<Number> Arc<Number, E>::near(const Motion<Number>& m, const Number& d) const {
  using std::exp;
  constexpr std::size_t terms = std::numeric_limits<Number>::digits <= 64 ? 13 : 36;  // (1/4)^n / n! below rounding
  if (!(d > 0)) return m;
  const Number square = d * d;
  std::array<Number, terms> t;  // t[k] = x^(k) d^k / k!
  t[0] = 0, t[1] = m.v * d, t[2] = m.a * square / 2;
  Number force = flow_->f * square, drive = m.sine, next = m.cosine;  // force: f d^2 (nu d)^k / k!
  for (std::size_t k = 1; k + 2 < terms; ++k) {
    Number sum = -square * t[k];
    if constexpr (E.damping != Damping::none) sum -= 2 * flow_->h * d * (static_cast<double>(k) + 1) * t[k + 1];
    if constexpr (E.forcing != Forcing::none) {
      force *= flow_->nu * d / static_cast<double>(k);
      sum += force * next;
      const Number turn = -drive;
      drive = next, next = turn;
    }
    t[k + 2] = sum / static_cast<double>((k + 1) * (k + 2));
  }
  Number rise = 0, gain = 0;  // from the small terms up
  for (std::size_t k = terms - 1; k >= 1; --k) {
    rise += t[k];
    if (k >= 2) gain += static_cast<double>(k) * t[k];
  }
  const SineCosine<Number> phase = turned(m, flow_->nu * d).phase;
  const Number x = m.x + rise, v = m.v + gain / d;
  rise += m.rise;
  const Number a = flow_->acceleration(flow_->offset(x, anchor_, rise), v, phase.sine);
  Motion<Number> end = with_free_part({rise, x, v, a, phase.sine, phase.cosine});
  if constexpr (E.damping == Damping::heavy) end.fast_x = m.fast_x * exp(-flow_->fast * d);
  return end;
}

}  // namespace clatter
