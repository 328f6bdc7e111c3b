#pragma once

#include "hard/any_scene.hpp"
#include "support/force_table.hpp"

namespace clatter::hard {

/// A random scene of a kind under a force of another shape than a sine.
template <AnyScene (*draw)(std::uint64_t)>
[[nodiscard]] AnyScene in_pieces(std::uint64_t index) {
  support::Random random(20731, index);
  AnyScene any = draw(index);
  Oscillator& o = any.scene.oscillator;
  if (o.forcing == 0) o.forcing = random.sign() * random.logarithmic(0.1, 3);
  constexpr int waveforms = static_cast<int>(force_shapes.size());
  o.shape.waveform = static_cast<Waveform>(1 + static_cast<int>(random.uniform(0, waveforms - 1)));
  o.shape.duty = random.happens(0.3) ? 0.5 : random.uniform(0.02, 0.98);
  o.shape.rise = random.happens(0.2) ? 0.5 : random.logarithmic(1e-6, 0.5);
  if (random.happens(0.5)) any.scene.start.phase = random.uniform(-3, 3);  // away from knots
  if (random.happens(0.3)) o.shape.waveform = Waveform::table, o.shape.table = support::any_force_table(random);
  return any;
}

}  // namespace clatter::hard
