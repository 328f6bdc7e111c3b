#pragma once

#include "hard/any_scene.hpp"
#include "support/force_orders.hpp"

namespace clatter::hard {

/// A random scene of a kind under a force that is a sum of sines.
template <AnyScene (*draw)(std::uint64_t)>
[[nodiscard]] AnyScene of_orders(std::uint64_t index) {
  support::Random random(20741, index);
  AnyScene any = draw(index);
  Oscillator& o = any.scene.oscillator;
  if (o.forcing == 0) o.forcing = random.sign() * random.logarithmic(0.1, 3);
  o.shape = support::any_force_orders(random);
  if (random.happens(0.3)) o.frequency = natural_frequency(o) / static_cast<double>(1 + random.uniform(0, 8));
  if (random.happens(0.3) && o.frequency > 0 && o.stiffness > 0)  // an order in or beside resonance
    o.frequency = natural_frequency(o) * random.uniform(0.97, 1.03) / static_cast<int>(random.uniform(1, 9));
  if (!(o.frequency > 0)) o.frequency = 1;
  return any;
}

}  // namespace clatter::hard
