#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include <gtest/gtest.h>

#include "motion/housed_arc.hpp"
#include "motion/loose_tangent.hpp"
#include "motion/relative_arc.hpp"
#include "motion/tangent_map.hpp"
#include "support/random.hpp"

namespace clatter::motion::saltation_test {
namespace {

using Kind = Event::Kind;
using support::Random;
template <std::size_t n>
using Vector = std::array<double, n>;
template <std::size_t n>
using Matrix = std::array<Vector<n>, n>;

template <std::size_t n>
Matrix<n> diagonal(const Vector<n>& of) {
  Matrix<n> matrix{};
  for (std::size_t i = 0; i < n; ++i) matrix[i][i] = of[i];
  return matrix;
}

/// The one formula of the tangent at an event (Aizerman & Gantmakher 1958): D is the derivative of the state after it
/// by that before, `before` and `after` are the flows, and the guard changes by `gradient` and, in time, by `rate`.
template <std::size_t n>
Matrix<n> saltation(Matrix<n> D, const Vector<n>& before, const Vector<n>& after, const Vector<n>& gradient,
                    double rate = 0) {
  for (std::size_t i = 0; i < n; ++i) rate += gradient[i] * before[i];
  Vector<n> jump = after;
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) jump[i] -= D[i][j] * before[j];
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j) D[i][j] += jump[i] * gradient[j] / rate;
  return D;
}

template <std::size_t n>
void expect_near(const Matrix<n>& found, const Matrix<n>& expected) {
  double size = 1;
  for (const auto& row : expected)
    for (const double entry : row) size = std::max(size, std::abs(entry));
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t j = 0; j < n; ++j)
      EXPECT_NEAR(found[i][j], expected[i][j], 1e-12 * size) << i << ", " << j;  // thousands of roundings
}

/// A mass at the end of an arc, with an event there.
class Instant {
 public:
  static constexpr Effects effects{.damping = Damping::light, .forcing = Forcing::regular, .stiffness = true};

  explicit Instant(Random& any)
      : friction(any.uniform(-0.5, 0.5)),
        x(any.uniform(-2, 2)),
        v(any.sign() * any.uniform(0.1, 2)),
        R(any.uniform(0, 1)),
        oscillator_{.damping = any.uniform(0.01, 0.5),
                    .forcing = any.uniform(0.5, 2),
                    .frequency = any.uniform(0.5, 2),
                    .load = any.uniform(-1, 1),
                    .stiffness = any.uniform(1, 3)},
        constants_(ArcConstants<double, effects>::of(oscillator_.damping, oscillator_.forcing, oscillator_.frequency,
                                                     oscillator_.load + friction, oscillator_.stiffness)) {
    const double theta = any.uniform(-3, 3);
    sine = std::sin(theta), cosine = std::cos(theta);
    constants_.friction = friction;
  }

  [[nodiscard]] const Oscillator& oscillator() const { return oscillator_; }
  /// Acceleration at a velocity, with a friction.
  [[nodiscard]] double a(double velocity, double rubs) const {
    return oscillator_.forcing * sine + oscillator_.load + rubs - 2 * oscillator_.damping * velocity -
           oscillator_.stiffness * x;
  }
  template <class Tangent>
  void show_arc(Tangent& tangent, double velocity, double acceleration) const {
    const Motion<double> start{0, x, velocity, acceleration, sine, cosine};
    tangent.arc(Arc<double, effects>(constants_, start), 0.0, 0.0);
  }
  [[nodiscard]] Matrix<2> of_event(const Event& event, double velocity) const {
    const double infinity = std::numeric_limits<double>::infinity();
    TangentMap<double> tangent({x - (event.side == Side::lower ? 0 : 1), x + (event.side == Side::upper ? 0 : 1), R, R,
                                event.kind == Kind::touch ? stiffness : infinity, infinity, zeta, 0});
    show_arc(tangent, velocity, a(velocity, friction));
    tangent.event(event);
    if (event.kind == Kind::stick) show_arc(tangent, 0, event.a_after);
    const auto map = tangent.map();
    return {{{map[0], map[1]}, {map[2], map[3]}}};
  }

  double friction, x, v, R, sine = 0, cosine = 0;
  double stiffness = 7, zeta = 0.3;  ///< of a soft stop

 private:
  Oscillator oscillator_;
  ArcConstants<double, effects> constants_;
};

class Saltation : public testing::Test {
 protected:
  template <class Check>
  void for_any_instant(Check&& check) const {
    for (std::uint64_t i = 0; i < 200; ++i) {
      SCOPED_TRACE(i);
      Random any(4711, i);
      check(Instant(any), any);
    }
  }
};

TEST_F(Saltation, OfAnImpactIsTheOneFormula) {  // eq. 27, friction turned round by the rebound
  for_any_instant([](const Instant& at, Random&) {
    const double after = -at.R * at.v;
    const Event impact{Kind::impact, at.v > 0 ? Side::upper : Side::lower, 0.0, at.v, 0.0, after, at.x};
    expect_near(at.of_event(impact, at.v), saltation<2>(diagonal<2>({1, -at.R}), {at.v, at.a(at.v, at.friction)},
                                                        {after, at.a(after, -at.friction)}, {1, 0}));
  });
}

TEST_F(Saltation, OfATouchIsTheOneFormula) {  // eq. 53
  for_any_instant([](const Instant& at, Random&) {
    const double v = -std::abs(at.v), damper = 2 * at.zeta * std::sqrt(at.stiffness) * v;
    const double a = at.a(v, at.friction);
    const Event touch{Kind::touch, Side::lower, 0.0, v, 0.0, v, at.x};
    expect_near(at.of_event(touch, v), saltation<2>(diagonal<2>({1, 1}), {v, a}, {v, a - damper}, {1, 0}));
  });
}

TEST_F(Saltation, OfAReversalIsTheOneFormula) {  // eq. 64
  for_any_instant([](const Instant& at, Random& any) {
    const double before = any.uniform(0.1, 2), after = any.uniform(0.1, 2);
    const Event reversal{.kind = Kind::reversal, .place = at.x, .a_before = before, .a_after = after};
    expect_near(at.of_event(reversal, 0), saltation<2>(diagonal<2>({1, 1}), {0, before}, {0, after}, {0, 1}));
  });
}

TEST_F(Saltation, OfAStickAndItsReleaseIsTheOneFormula) {  // eq. 65: the guard is the level less the push
  for_any_instant([](const Instant& at, Random& any) {
    const double a_after = any.uniform(0.1, 2), &k = at.oscillator().stiffness;
    const double push_rate = at.oscillator().forcing * at.oscillator().frequency * at.cosine;
    const Event stick{.kind = Kind::stick, .place = at.x, .a_after = a_after};
    const Matrix<2> found = at.of_event(stick, 0);
    const Matrix<2> release = saltation<2>(diagonal<2>({1, 1}), {0, 0}, {0, a_after}, {k, 0}, -push_rate);
    expect_near(found, {{{release[0][0], 0}, {release[1][0], 0}}});  // a stick keeps the place alone
  });
}

TEST_F(Saltation, OfAnImpactOnAWallIsTheOneFormula) {  // eq. 73
  for_any_instant([](const Instant& at, Random& any) {
    const double eps = any.uniform(0.01, 2), load = any.uniform(-1, 1), y = any.uniform(-2, 2), w = y - at.v;
    const double kick = eps / (1 + eps) * (1 + at.R), back = kick / eps;
    const double v_after = at.v + kick * w, y_after = y - back * w;
    LooseTangent tangent(Scene{.loose = {.ratio = eps,
                                         .lower = -1,
                                         .upper = 1,
                                         .restitution_lower = at.R,
                                         .restitution_upper = at.R,
                                         .load = load}});
    Event strike{.kind = Kind::strike, .before = w, .after = -at.R * w};
    strike.main = {at.x, at.v, v_after};
    const double a = at.a(at.v, at.friction), a_after = at.a(v_after, at.friction);
    at.show_arc(tangent, at.v, a);
    tangent.event(strike);
    Matrix<4> D = diagonal<4>({1, 1, 1, 1});
    D[1][1] -= kick, D[1][3] += kick, D[3][1] += back, D[3][3] -= back;
    expect_near(tangent.map(), saltation<4>(D, {at.v, a, y, load}, {v_after, a_after, y_after, load}, {-1, 0, 1, 0}));
  });
}

/// A loose mass that rubs on its housing, at z' = 0 beside a main mass at some instant.
class AtRestInHousing {
 public:
  AtRestInHousing(const Instant& at, Random& any)
      : at_(at),
        loose{.ratio = any.uniform(0.01, 2),
              .lower = -1,
              .upper = 1,
              .load = any.uniform(-1, 1),
              .friction = any.uniform(0.1, 0.5),
              .friction_static = any.uniform(0.5, 1)} {}

  /// x'' beside a mass that slides to a side, y'' of that, and x'' of both as one.
  [[nodiscard]] double a(int towards) const { return at_.a(at_.v, at_.friction + towards * loose.friction); }
  [[nodiscard]] double y(int towards) const { return loose.load - towards * loose.friction / loose.ratio; }
  [[nodiscard]] double as_one() const { return (a(0) + loose.ratio * loose.load) / (1 + loose.ratio); }
  [[nodiscard]] Vector<4> sliding(int towards) const { return {at_.v, a(towards), at_.v, y(towards)}; }
  [[nodiscard]] Vector<4> held() const { return {at_.v, as_one(), at_.v, as_one()}; }

  void show_slide(LooseTangent& tangent, int towards) const {
    const Oscillator& o = at_.oscillator();
    const auto constants = ArcConstants<double, Instant::effects>::of(
        o.damping, o.forcing, o.frequency, o.load + at_.friction + towards * loose.friction, o.stiffness);
    const Arc<double, Instant::effects> main(constants, {0, at_.x, at_.v, a(towards), at_.sine, at_.cosine});
    const RelativeArc<double, Instant::effects> beside(main, {0, 0.3, 0, at_.v}, y(towards));
    tangent.arc(HousedArc{main, beside}, 0.0, 0.0);
  }
  void show_hold(LooseTangent& tangent) const {
    const Oscillator& o = at_.oscillator();
    const double both = 1 + loose.ratio, load = o.load + at_.friction + loose.ratio * loose.load;
    auto constants = ArcConstants<double, Instant::effects>::of(o.damping / both, o.forcing / both, o.frequency,
                                                                load / both, o.stiffness / both);
    constants.carried = loose.ratio;
    const Arc<double, Instant::effects> main(constants, {0, at_.x, at_.v, as_one(), at_.sine, at_.cosine});
    tangent.arc(HousedArc{main, Pressed{Side::none, 0.3}}, 0.0, 0.0);
  }

 private:
  const Instant& at_;

 public:
  LooseMass loose;
};

TEST_F(Saltation, OfTheEndOfASlideIsTheOneFormula) {  // z' = 0: friction turns the loose mass, or holds it
  for_any_instant([](const Instant& at, Random& any) {
    const AtRestInHousing housing(at, any);
    const int towards = any.sign() > 0 ? 1 : -1;
    for (const bool holds : {false, true}) {
      LooseTangent tangent(Scene{.loose = housing.loose});
      housing.show_slide(tangent, towards);
      holds ? housing.show_hold(tangent) : housing.show_slide(tangent, -towards);
      expect_near(tangent.map(), saltation<4>(diagonal<4>({1, 1, 1, 1}), housing.sliding(towards),
                                              holds ? housing.held() : housing.sliding(-towards), {0, -1, 0, 1}));
    }
  });
}

TEST_F(Saltation, OfAReleaseInTheHousingIsTheOneFormula) {  // eq. 81: the guard is x'' of both as one
  for_any_instant([](const Instant& at, Random& any) {
    const AtRestInHousing housing(at, any);
    const int towards = any.sign() > 0 ? 1 : -1;
    LooseTangent tangent(Scene{.loose = housing.loose});
    housing.show_hold(tangent);
    housing.show_slide(tangent, towards);
    const Oscillator& o = at.oscillator();
    Matrix<4> found = tangent.map(), known{};
    const Matrix<4> release = saltation<4>(diagonal<4>({1, 1, 1, 1}), housing.held(), housing.sliding(towards),
                                           {-o.stiffness, -2 * o.damping, 0, 0}, o.forcing * o.frequency * at.cosine);
    for (std::size_t i = 0; i < 4; ++i)  // a change of y' was lost before, since y' was x'
      known[i] = {release[i][0], release[i][1] + release[i][3], release[i][2], 0};
    expect_near(found, known);
  });
}

}  // namespace
}  // namespace clatter::motion::saltation_test
