#include "config/force_shape.hpp"

#include <algorithm>
#include <array>

#include "config/force_table.hpp"
#include "config/placed.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {

Waveform waveform_of(const Settings& settings) {
  if (has_force_table(settings)) return Waveform::table;
  const auto chosen = std::ranges::find(force_shapes, settings.text(settings.scene_section, "force_shape"));
  return static_cast<Waveform>(chosen - force_shapes.begin());
}

void set_force_shape(const Settings& settings, GivenScene& scene) {
  Oscillator& oscillator = scene.oscillator;
  oscillator.shape.waveform = waveform_of(settings);
  if (const std::optional<MeasuredForce>& force = settings.measured_force) {
    oscillator.shape.table = kept(force->table);
    oscillator.forcing = oscillator.shape.table->peak();
  }
}

void check_force_shape(const Settings& settings) {
  const Waveform waveform = waveform_of(settings);
  if (waveform == Waveform::sine) return;
  const std::string_view key = waveform == Waveform::table ? "force_table" : "force_shape";
  std::string shape = in_quotes(key);
  if (waveform != Waveform::table)
    shape += " = " + in_quotes(std::get<std::string>(settings.find(settings.scene_section, key)->value));
  for (const Parameter shaking : std::array<Parameter, 2>{"stop_amplitude", "base_amplitude"})
    if (const SourceLocation* const place = place_of_nonzero(settings.given(shaking)))
      fail(*place,
           in_quotes(shaking.key()) + " beside " + shape +
               "; what is shaken moves as a sine, so far beside a force that is one, too: leave out one of them");
  if (const Setting* const along = settings.find("branch", "along"))
    fail(along->location, "[branch] beside " + shape + "; a branch follows motion under a sine so far: leave out " +
                              std::string(key) + ", or follow the motion by sweep.follow");
}

}  // namespace clatter::config
