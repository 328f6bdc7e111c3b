#pragma once

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "hard/any_rubbing_machine.hpp"

namespace clatter::hard {

/// Knots on the speeds of a scene and beyond, by which a faster impact never rebounds more slowly.
[[nodiscard]] inline SpeedTable any_knots(support::Random& random, double fast) {
  SpeedTable table;
  double speed = random.happens(0.3) ? 0 : fast * random.logarithmic(1e-2, 1);
  for (int left = random.happens(0.5) ? 2 : random.happens(0.5) ? 1 : 9; left > 0; --left) {
    double R = any_restitution(random);
    if (!table.knots.empty()) {
      const auto& [slower, before] = table.knots.back();
      R = std::min(1.0, std::max(R, before * (speed / (2 * speed - slower)) * (1 + 4 * epsilon<double>())));
    }
    table.knots.push_back({speed, R});
    speed += fast * random.logarithmic(1e-3, 0.5);
  }
  return table;
}

/// Lets a restitution depend on the speed: by a power, most of them so small that a chatter takes no more than
/// thousands of impacts, by knots, or not at all but for a speed below which nothing rebounds.
inline void draw_law(support::Random& random, Restitution<double>& law, double fast) {
  const double kind = random.uniform(0, 1);
  if (kind < 0.15) return;
  if (kind < 0.5) {
    law.exponent = random.happens(0.7) ? random.logarithmic(0.02, 0.15) : random.uniform(0.15, 0.95);
    law.reference = fast * random.logarithmic(0.1, 10);
  } else if (kind < 0.85) {
    law.table = kept(any_knots(random, fast));
  }
  if (kind > 0.85 || random.happens(0.25)) law.below = fast * random.logarithmic(1e-3, 0.7);
  if (random.happens(0.3)) law.unit = random.logarithmic(0.1, 10);
}

/// Gives laws to the rigid stops and walls of a scene. A tenth begins with an impact at the very speed of a corner or a
/// jump.
inline void draw_laws(support::Random& random, AnyScene& any) {
  Scene& scene = any.scene;
  auto& [oscillator, stops, start, shaking, friction, loose] = scene;
  const double slowest = std::min(loose.upper - loose.lower, stops.upper - stops.lower);
  const double of_force = std::abs(oscillator.forcing) / std::max(1.0, oscillator.frequency);
  const double fast = std::max({std::abs(start.velocity), std::abs(loose.velocity), of_force, std::min(slowest, 1e-3)});
  const bool is_same = random.happens(0.3);
  for (const Side side : {Side::lower, Side::upper}) {
    const bool upper = side == Side::upper;
    auto& of_stop = upper ? stops.restitution_upper : stops.restitution_lower;
    auto& of_wall = upper ? loose.restitution_upper : loose.restitution_lower;
    if (!is_soft(stops, side)) draw_law(random, of_stop, fast);
    if (has_loose_mass(loose) && !is_soft(walls_of(loose), side)) draw_law(random, of_wall, fast);
  }
  if (is_same && !is_soft(stops, Side::lower) && !is_soft(stops, Side::upper))
    stops.restitution_upper = stops.restitution_lower;
  if (!random.happens(0.1)) return;
  for (const auto& [law, speed] : {std::pair{&stops.restitution_lower, std::abs(start.velocity)},
                                   {&stops.restitution_upper, std::abs(start.velocity)},
                                   {&loose.restitution_lower, std::abs(loose.velocity)},
                                   {&loose.restitution_upper, std::abs(loose.velocity)}})
    if (law->table && law->table->knots.size() > 1 && speed > 0) law->unit = speed / law->table->knots[1].speed;
}

template <AnyScene (*draw)(std::uint64_t)>
[[nodiscard]] AnyScene by_speed(std::uint64_t index) {
  support::Random random(20721, index);
  AnyScene any = draw(index);
  draw_laws(random, any);
  return any;
}

}  // namespace clatter::hard
