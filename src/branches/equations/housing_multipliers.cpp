#include "branches/equations/housing_multipliers.hpp"

#include <Eigen/LU>
#include <cmath>
#include <limits>

#include "branches/equations/housing_flight.hpp"
#include "branches/equations/links.hpp"
#include "motion/linear_maps.hpp"

namespace clatter::branches {
namespace {

constexpr auto four = static_cast<Eigen::Index>(of_event);

Eigen::Matrix4d matrix_of(const Square4& square) {
  Eigen::Matrix4d matrix;
  for (Eigen::Index i = 0; i < four; ++i)
    for (Eigen::Index j = 0; j < four; ++j)
      matrix(i, j) = square[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)];
  return matrix;
}
Square4 square_of(const Eigen::Matrix4d& matrix) {
  Square4 square;
  for (Eigen::Index i = 0; i < four; ++i)
    for (Eigen::Index j = 0; j < four; ++j)
      square[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)] = matrix(i, j);
  return square;
}

/// The map of small changes from event to event: the phase of the next one makes up for the change of the gap.
Eigen::Matrix4d map_of(const HousingLink& link) {
  const Eigen::Matrix4d begin = matrix_of(link.by_begin), end = matrix_of(link.by_end);
  Eigen::Matrix4d map;
  map.row(0) = -begin.row(0) / end(0, 0);
  for (Eigen::Index row = 1; row < four; ++row)
    map.row(row) = -(begin.row(row) + end(row, 0) * map.row(0)) / end(row, row);
  return map;
}

/// The equations of small changes of all events, of which the last flight returns the first `multiplier` times as
/// large.
template <class Number>
Eigen::MatrixX<Number> changes_of(const std::vector<HousingLink>& links, Number multiplier, double speed_unit) {
  const auto count = static_cast<Eigen::Index>(links.size());
  const Eigen::Vector4d unit(1.0, speed_unit, speed_unit, speed_unit);
  Eigen::MatrixX<Number> equations = Eigen::MatrixX<Number>::Zero(four * count, four * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const HousingLink& link = links[static_cast<std::size_t>(i)];
    const bool closes = i + 1 == count;
    const Eigen::Matrix4d begin = matrix_of(link.by_begin) * unit.asDiagonal(),
                          end = matrix_of(link.by_end) * unit.asDiagonal();
    equations.block(four * i, four * i, four, four) += begin.cast<Number>();
    equations.block(four * i, closes ? 0 : four * (i + 1), four, four) +=
        (closes ? multiplier : Number(1)) * end.cast<Number>();
  }
  return equations;
}

/// The least singular value of equations, with its unit vectors: they take `right` to `size` times `left`.
struct LeastChange {
  double size;
  Eigen::VectorXd left, right;
};
/// By inverse iteration, which converges at once if the value is small.
LeastChange least_change(const Eigen::MatrixXd& equations) {
  Eigen::PartialPivLU<Eigen::MatrixXd> lu(equations);
  if (lu.matrixLU().diagonal().cwiseAbs().minCoeff() == 0) {  // just on the special point: it has no inverse
    const double rounding = std::numeric_limits<double>::epsilon() * equations.norm();
    lu.compute(equations + rounding * Eigen::MatrixXd::Identity(equations.rows(), equations.cols()));
  }
  LeastChange found{0.0, Eigen::VectorXd::Ones(equations.rows()).normalized(), {}};
  for (int iteration = 0; iteration < 200; ++iteration) {
    found.right = lu.solve(found.left).normalized();
    const Eigen::VectorXd left = lu.transpose().solve(found.right);
    const double before = found.size;
    found.size = 1 / left.norm(), found.left = left * found.size;
    if (std::abs(found.size - before) <= 1e-15 * found.size) break;
  }
  return found;
}

}  // namespace

HousingMultiplier housing_multiplier(const FollowedScene& scene, const Orbit& orbit,
                                     const std::vector<OrbitEquations::Axis>& axes, int multiplier, double speed_unit) {
  const LeastChange least = least_change(changes_of<double>(housing_links(scene, orbit, axes), multiplier, speed_unit));
  Vector right(least.right.begin(), least.right.end());
  for (std::size_t i = 0; i < right.size(); ++i)
    if (i % of_event != 0) right[i] *= speed_unit;
  // the derivative of a singular value is left . dJ right
  return {least.size, housing_slopes(scene, orbit, axes, {least.left.begin(), least.left.end()}, right, multiplier)};
}

namespace {

/// The map of small changes of the first event over a period, or half a period; of motion without events that of its
/// state.
Eigen::Matrix4d map_of(const FollowedScene& scene, const Orbit& orbit) {
  Eigen::Matrix4d map = Eigen::Matrix4d::Identity();
  if (orbit.size() == 0)
    with_arcs_of_main(scene, [&]<Effects E>() {
      const HousingFlights<double, E> flights(numbers_of<double>(scene));
      const double time = orbit.advance() / flights.constants().nu;
      flights.of_main().with_constants(orbit.pressed, [&](const auto& c) {
        const motion::Propagator<double> free = c.propagator(time);
        map.topLeftCorner<2, 2>() << free.a, free.b, -c.spring(free.b), free.c;
      });
      map(2, 3) = time;
      if (orbit.mirrored) map = -map;
    });
  for (const HousingLink& link : housing_links(scene, orbit, {})) map = map_of(link) * map;
  return map;
}

}  // namespace

// From its values at 1, -1 and i; a power of a map that is infinite in a graze would have no digits there.
HousingCharacteristic housing_characteristic(const FollowedScene& scene, const Orbit& orbit) {
  const SceneNumbers<double> p = numbers_of<double>(scene);
  const std::vector<HousingLink> links = housing_links(scene, orbit, {});
  const double at_1 = changes_of<double>(links, 1.0, 1.0).determinant(),
               at_minus_1 = changes_of<double>(links, -1.0, 1.0).determinant();
  const std::complex<double> at_i =
      changes_of<std::complex<double>>(links, std::complex<double>(0.0, 1.0), 1.0).determinant();
  HousingCharacteristic found;
  for (const HousingLink& link : links)
    for (std::size_t i = 0; i < of_event; ++i) found.leading *= link.by_end[i][i];
  found.determinant = detail::determinant_of(p, orbit);
  const double sum = (at_minus_1 - at_1) / 2, difference = at_i.imag();  // a + c, a - c
  found.a = (sum + difference) / 2, found.c = (sum - difference) / 2;
  found.b = (at_1 + at_minus_1) / 2 - found.leading * (1 + found.determinant);
  return found;
}

// If two multipliers have the product 1, the polynomial is (s^2 + p s + 1)(s^2 + q s + D) with p = (c - a)/(1 - D) and
// q = (a D - c)/(1 - D).
double HousingCharacteristic::distance_to_unit_product() const {
  const double D = determinant;
  if (!(D < 1 - 1e-9)) return 1.0;  // nothing contracts, so that all pairs have it
  return (b - leading * (1 + D)) * leading * (1 - D) * (1 - D) - (c - a) * (a * D - c);
}

double HousingCharacteristic::beyond_real() const {
  return 2 * (1 - determinant) * std::abs(leading) - std::abs(c - a);
}

std::array<std::complex<double>, 4> housing_multipliers(const FollowedScene& scene, const Orbit& orbit) {
  return motion::known_of(motion::multipliers_of(square_of(map_of(scene, orbit))));
}

Vector direction_of_daughter_in_housing(const FollowedScene& scene, const Orbit& orbit, const Orbit& daughter,
                                        double speed_unit) {
  const Eigen::Matrix4d back = map_of(scene, orbit) + Eigen::Matrix4d::Identity();
  Eigen::Vector4d change = least_change(back).right;
  Vector direction;
  for (const HousingLink& link : housing_links(scene, daughter, {})) {
    direction.push_back(change[0]);
    for (Eigen::Index i = 1; i < four; ++i) direction.push_back(change[i] / speed_unit);
    change = map_of(link) * change;
  }
  direction.push_back(0.0);
  const double length = std::sqrt(product(direction, direction));
  for (double& x : direction) x /= length;
  return direction;
}

}  // namespace clatter::branches
