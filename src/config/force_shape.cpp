#include "config/force_shape.hpp"

#include <algorithm>
#include <array>

#include "config/placed.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {

Waveform waveform_of(const Settings& settings) {
  const auto chosen = std::ranges::find(force_shapes, settings.text(settings.scene_section, "force_shape"));
  return static_cast<Waveform>(chosen - force_shapes.begin());
}

void set_force_shape(const Settings& settings, GivenScene& scene) {
  scene.oscillator.shape.waveform = waveform_of(settings);
}

void check_force_shape(const Settings& settings) {
  if (waveform_of(settings) == Waveform::sine) return;
  const Setting& given = *settings.find(settings.scene_section, "force_shape");
  const std::string shape = in_quotes("force_shape") + " = " + in_quotes(std::get<std::string>(given.value));
  for (const Parameter shaking : std::array<Parameter, 2>{"stop_amplitude", "base_amplitude"})
    if (const SourceLocation* const place = place_of_nonzero(settings.given(shaking)))
      fail(*place,
           in_quotes(shaking.key()) + " beside " + shape +
               "; what is shaken moves as a sine, so far beside a force that is one, too: leave out one of them");
  if (const Setting* const along = settings.find("branch", "along"))
    fail(along->location, "[branch] beside " + shape +
                              "; a branch follows motion under a sine so far: leave out force_shape, or follow the "
                              "motion by sweep.follow");
  const Setting* const names = settings.find("observe", "sensitivity");
  if (names != nullptr && !std::get<std::string>(names->value).empty())
    fail(names->location,
         "sensitivity beside " + shape + "; it is that of motion under a sine so far: leave out one of them");
}

}  // namespace clatter::config
