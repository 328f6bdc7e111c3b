#include "sweep/mirror_images.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "math/number.hpp"
#include "scene/scene.hpp"

namespace clatter::sweep {
namespace {

/// Whether only observables are asked for whose mirror images `mirrored` gives. The others depend on where the observed
/// period begins.
bool can_mirror(const observables::Observe& observe) {
  observables::Observe others = observe;
  others.extrema = others.settling = others.attractor = others.stability = false;
  return observables::All::descriptions(others).empty();
}

bool are_half_a_turn_apart(double a, double b) {
  const double turns = (a - b) / (2 * pi<double>());
  return std::abs(turns - std::floor(turns) - 0.5) <= 4 * epsilon<double>() * std::max(1.0, std::abs(turns));
}

constexpr Parameter x0("x0"), v0("v0"), phase("phase"), start_period("start_period");

bool is_start(Parameter parameter) { return parameter.role() == Role::start; }

/// Whether the values of a dimension at two indexes are those of a point and its mirror image.
bool are_mirrored(const Dimension& dimension, std::size_t a, std::size_t b, bool forced) {
  return std::ranges::all_of(dimension, [&](const Axis& axis) {
    if (!is_start(axis.parameter) || (axis.parameter == phase && !forced)) return axis.values[a] == axis.values[b];
    if (axis.parameter == phase) return are_half_a_turn_apart(axis.values[a], axis.values[b]);
    const double largest = std::max(std::abs(axis.values.front()), std::abs(axis.values.back()));
    return std::abs(axis.values[a] + axis.values[b]) <= 4 * epsilon<double>() * largest;
  });
}

/// For each index of a dimension that of the mirror image; empty if one has none.
std::vector<std::size_t> images_in(const Dimension& dimension, bool forced) {
  std::vector<std::size_t> images(length(dimension));
  const bool varies_start = std::ranges::any_of(dimension, is_start, &Axis::parameter);
  std::size_t guess = images.size() - 1;  // evenly spaced values are mirrored in the middle, or shifted by half
  for (std::size_t i = 0; i < images.size(); ++i) {
    if (!varies_start) {
      images[i] = i;
      continue;
    }
    std::size_t tried = 0;
    while (tried < images.size() && !are_mirrored(dimension, i, guess, forced))
      ++tried, guess = (guess + 1) % images.size();
    if (tried == images.size()) return {};
    images[i] = guess;
    guess = (guess + images.size() - 1) % images.size();
  }
  for (std::size_t i = 0; i < images.size(); ++i)
    if (images[images[i]] != i) return {};
  return images;
}

/// Whether the scene is symmetric about 0 at every point.
bool is_always_symmetric(const Sweep& sweep) {
  const bool varies = std::ranges::any_of(sweep.dimensions, [](const Dimension& dimension) {
    return std::ranges::any_of(dimension, [](const Axis& axis) { return !axis.parameter.keeps_symmetry(); });
  });
  const ForceShape& shape = sweep.problem.oscillator.shape;  // the first point may have no force
  const bool is_odd = !shape.has_orders() && is_odd_by_half(shape);
  return !varies && is_odd && mirror_centre(problem_at(sweep, 0)) == 0.0;
}

/// Whether a dimension varies the force, or what shakes.
bool drives(const Dimension& dimension) {
  return std::ranges::any_of(dimension, [](const Axis& axis) {
    const Role role = axis.parameter.role();
    return role == Role::drive || role == Role::force_order || role == Role::shaking || role == Role::stop_motion;
  });
}

bool is_swept(const Sweep& sweep, Parameter parameter) {
  return std::ranges::any_of(sweep.dimensions, [&](const Dimension& dimension) {
    return std::ranges::find(dimension, parameter, &Axis::parameter) != dimension.end();
  });
}

}  // namespace

MirrorImages::MirrorImages(const Sweep& sweep) : points_(size_one_way(sweep)) {
  constexpr std::size_t longest = 100'000;  // of a dimension, whose images are looked for one by one
  const GivenProblem& problem = sweep.problem;
  const bool forced = is_driven(problem.oscillator) || is_shaken(sweep) || move_by_themselves(sweep) ||
                      std::ranges::any_of(sweep.dimensions, drives);
  const bool paired = (problem.start.displacement == 0 || is_swept(sweep, x0)) &&
                      (problem.start.velocity == 0 || is_swept(sweep, v0)) && (!forced || is_swept(sweep, phase));
  if (!paired || has_loose_mass(sweep) || problem.time.mode != steady::Mode::steady ||
      problem.integration.method != stepping::Method::exact || problem.integration.all_effects || sweep.follow ||
      !std::isnan(problem.start_period) || is_swept(sweep, start_period) || !is_always_symmetric(sweep) ||
      !can_mirror(problem.observe))
    return;
  std::vector<std::vector<std::size_t>> images;
  for (const Dimension& dimension : sweep.dimensions) {
    if (length(dimension) > longest) return;
    images.push_back(images_in(dimension, forced));
    if (images.back().empty()) return;
  }
  std::size_t own = 1;  // points that are their own mirror images
  for (const std::vector<std::size_t>& along : images) {
    std::size_t fixed = 0;
    for (std::size_t i = 0; i < along.size(); ++i) fixed += along[i] == i ? 1 : 0;
    own *= fixed;
  }
  images_ = std::move(images), count_ = (points_ - own) / 2;
}

std::optional<std::size_t> MirrorImages::image_of(std::size_t point) const {
  if (!exist()) return std::nullopt;
  std::size_t image = 0, stride = points_, left = point;
  for (std::size_t d = 0; d < images_.size(); ++d) {
    stride /= images_[d].size();
    image += images_[d][left / stride] * stride;
    left %= stride;
  }
  return image != point ? std::optional(image) : std::nullopt;
}

point::PointResult mirrored(const point::PointResult& result) {
  point::PointResult mirror = result;
  mirror.x_min = -result.x_max, mirror.x_max = -result.x_min;
  mirror.v_min = -result.v_max, mirror.v_max = -result.v_min;
  mirror.attractor_x = -result.attractor_x, mirror.attractor_v = -result.attractor_v;
  mirror.end.displacement = -result.end.displacement, mirror.end.velocity = -result.end.velocity;
  mirror.end.phase = std::fmod(result.end.phase + pi<double>(), 2 * pi<double>());
  return mirror;
}

}  // namespace clatter::sweep
