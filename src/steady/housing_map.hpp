#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "motion/linear_maps.hpp"
#include "motion/walls.hpp"
#include "scene/scene.hpp"
#include "steady/passage_observer.hpp"
#include "stepping/run.hpp"

namespace clatter::steady {

/// A motion with a loose mass over some forcing periods; periodic if the last state is the first.
struct HousingOrbit {
  std::vector<motion::State<double>> states{};  ///< at its sections, the last as computed from the first
  std::vector<std::uint64_t> contacts{};        ///< from each state but the last to the next (`Passage::itinerary`)
  motion::LooseJacobian derivative{};           ///< of the last state by the first, if asked for
  double settling = 0.0;  ///< forcing periods until an approaching motion is within the tolerance of it

  [[nodiscard]] std::size_t periods() const { return contacts.size(); }
};

/// The map of states with a loose mass over some forcing periods, and Newton's method for its fixed points.
template <stepping::Integrator I>
class HousingMap {
  using State = motion::State<double>;
  using Four = motion::Four<double>;

 public:
  HousingMap(I& integrator, const Scene& scene, double tolerance)
      : integrator_(integrator), scene_(scene), tolerance_(tolerance), watch_(passage_observer(integrator, scene)) {}

  /// The most times that an attempt follows all periods of a motion: Newton's iterations, the orbit that they find, and
  /// two neighbours of it in each direction.
  static constexpr std::size_t most_iterations = 5, most_turns = most_iterations + 1 + 2 * 4;

  [[nodiscard]] std::size_t simulated() const { return simulated_; }  ///< forcing periods

  /// The periodic motion that a motion at `now` settles to, with the same contacts in the same order as they were in
  /// the round before. It attracts it as far as can be seen: in the norm of the derivative's eigenvectors, states as
  /// far from it as `now` come closer, in each direction to either side and at `now` itself, over the same contacts.
  [[nodiscard]] std::optional<HousingOrbit> attractor_of(const State& now, const std::vector<std::uint64_t>& contacts,
                                                         const Passage& latest) {
    sizes_ = {std::max({std::abs(now.x), std::abs(now.v), latest.size}), latest.loose_size};
    State start = now, end = now;  // `end`: a round after `now`
    double before = std::numeric_limits<double>::infinity();
    for (std::size_t iteration = 0; iteration < most_iterations; ++iteration) {
      const std::optional<HousingOrbit> orbit = follow(start, contacts, true);
      if (!orbit) return std::nullopt;
      if (iteration == 0) end = orbit->states.back();
      const double gap = distance(orbit->states.front(), orbit->states.back());
      const bool found = gap <= tolerance_;
      if (!found && !(gap < before / 4)) return std::nullopt;
      before = gap;
      const Four step =
          motion::change_of_fixed_point(orbit->derivative, difference(orbit->states.front(), orbit->states.back()));
      start = motion::moved(start, step);
      if (!is_inside(start)) return std::nullopt;
      if (found) return attracting(start, orbit->derivative, contacts, now, end);
    }
    return std::nullopt;
  }

  /// The distance of two states, of each pair, (x, x') and (z, z'), by the size of its motion.
  [[nodiscard]] double distance(const State& from, const State& to) const {
    const auto [z, w] = motion::place_in_housing(from, scene_.loose);
    const auto [to_z, to_w] = motion::place_in_housing(to, scene_.loose);
    return std::max(std::max(std::abs(to.x - from.x), std::abs(to.v - from.v)) / sizes_[0],
                    std::max(std::abs(to_z - z), std::abs(to_w - w)) / sizes_[1]);
  }

 private:
  [[nodiscard]] Four difference(const State& from, const State& to) const {
    const Four a = motion::numbers_of(from, scene_.loose), b = motion::numbers_of(to, scene_.loose);
    return {b[0] - a[0], b[1] - a[1], b[2] - a[2], b[3] - a[3]};
  }

  /// The motion from a state; nothing if it fails or its contacts are others.
  [[nodiscard]] std::optional<HousingOrbit> follow(const State& from, const std::vector<std::uint64_t>& contacts,
                                                   bool differentiates) {
    HousingOrbit orbit{.states = {from}, .contacts = contacts};
    State state = from;
    if (differentiates)
      watch_.differentiate();
    else
      watch_.stop_differentiating();
    for (const std::uint64_t expected : contacts) {
      watch_.begin_section();
      ++simulated_;
      if (advance_to_section(integrator_, state, from.periods, watch_) != stepping::Outcome::completed ||
          watch_.passage().itinerary != expected)
        return std::nullopt;
      orbit.states.push_back(state);
    }
    if (differentiates) orbit.derivative = watch_.derivative();
    return orbit;
  }

  [[nodiscard]] bool is_inside(const State& state) const {
    const Stops stops = rigid_ones(scene_.stops);
    const auto [z, w] = motion::place_in_housing(state, scene_.loose);
    return state.x >= stops.lower && state.x <= stops.upper && std::isfinite(state.v) && z >= scene_.loose.lower &&
           z <= scene_.loose.upper && std::isfinite(w);
  }

  /// The orbit from `start` with this derivative, if states around it come closer, among them `now`, at `end` a round
  /// later.
  [[nodiscard]] std::optional<HousingOrbit> attracting(const State& start, const motion::LooseJacobian& derivative,
                                                       const std::vector<std::uint64_t>& contacts, const State& now,
                                                       const State& end) {
    const auto norm = motion::EigenNorm::of(derivative);
    if (!norm || !(norm->spectral_radius() < 1)) return std::nullopt;
    std::optional<HousingOrbit> orbit = follow(start, contacts, false);
    if (!orbit || !(distance(start, orbit->states.back()) <= tolerance_)) return std::nullopt;
    constexpr double least = 1e-7;  // of the motion's size, so that rounding doesn't show
    const double radius = std::max(norm->size_of(difference(start, now)), least * std::max(sizes_[0], sizes_[1]));
    const double closer = radius * (1 + norm->spectral_radius()) / 2;
    const auto comes_closer = [&](const State& to) { return norm->size_of(difference(start, to)) <= closer; };
    if (!comes_closer(end)) return std::nullopt;
    for (Four direction : norm->directions())
      for (const double by : {radius, -radius}) {
        Four change;
        std::ranges::transform(direction, change.begin(), [by](double number) { return by * number; });
        const State beside = motion::moved(start, change);
        if (!is_inside(beside)) return std::nullopt;
        const auto neighbour = follow(beside, contacts, false);
        if (!neighbour || !comes_closer(neighbour->states.back())) return std::nullopt;
      }
    const double rounds = std::log(distance(start, now) / tolerance_) / -std::log(norm->spectral_radius());
    orbit->settling = static_cast<double>(contacts.size()) * (1 + std::max(0.0, rounds));
    return orbit;
  }

  I& integrator_;
  const Scene& scene_;
  double tolerance_;
  HousingObserver watch_;
  std::array<double, 2> sizes_{1.0, 1.0};  ///< of the motion of each pair
  std::size_t simulated_ = 0;
};

}  // namespace clatter::steady
