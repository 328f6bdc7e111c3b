#include "config/force_shape.hpp"

#include <algorithm>
#include <array>

#include "config/force_table.hpp"
#include "config/placed.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {

namespace {

/// An amplitude of an order of the force that is given, or nullptr.
const Setting* given_order(const Settings& settings) {
  for (const Parameter parameter : all_parameters)
    if (is_order_amplitude(parameter))
      if (const Setting* const given = settings.given(parameter)) return given;
  return nullptr;
}

/// The number of an order of the force along which motion is followed, from 0 if it isn't given.
std::optional<Parameter> followed_order(const Settings& settings) {
  for (const std::string_view key : {"along", "across"})
    if (const auto followed = settings.followed(key); followed && followed->role() == Role::force_order)
      return followed;
  return std::nullopt;
}

/// Throws ConfigError if there are orders beside a force that has its own course.
void check_orders(const Settings& settings, const std::string& shape) {
  if (const Setting* const order = given_order(settings))
    fail(order->key_location,
         in_quotes(order->key->name) + " beside " + shape + ", which has all its orders; leave one of them out");
}

}  // namespace

Waveform waveform_of(const Settings& settings) {
  if (has_force_table(settings)) return harmonics_of_table(settings) > 0 ? Waveform::orders : Waveform::table;
  const auto chosen = std::ranges::find(force_shapes, settings.text(settings.scene_section, "force_shape"));
  const auto waveform = static_cast<Waveform>(chosen - force_shapes.begin());
  const bool has_orders = given_order(settings) != nullptr || followed_order(settings);
  return waveform == Waveform::sine && has_orders ? Waveform::orders : waveform;
}

bool has_force_in_pieces(const Settings& settings) {
  const Waveform waveform = waveform_of(settings);
  return waveform != Waveform::sine && waveform != Waveform::orders;
}

std::string_view key_of_shape(const Settings& settings) {
  if (has_force_table(settings)) return "force_table";
  if (waveform_of(settings) != Waveform::orders) return "force_shape";
  const Setting* const order = given_order(settings);
  return order != nullptr ? std::string_view(order->key->name) : followed_order(settings)->key();
}

Parameter amplitude_of_order(Parameter order, bool is_si) {
  const char number = order.key().back();
  return *Parameter::of((is_si ? "force_" : "f_") + std::string(1, number), is_si ? Quantity::force : Quantity::number);
}

void set_force_shape(const Settings& settings, GivenScene& scene) {
  Oscillator& oscillator = scene.oscillator;
  oscillator.shape.waveform = waveform_of(settings);
  const std::optional<MeasuredForce>& force = settings.measured_force;
  if (!force) return;
  if (const std::size_t count = harmonics_of_table(settings); count > 0) {
    const auto [mean, orders, left_out] = force->table.harmonics(count);
    oscillator.shape.orders = orders, oscillator.forcing = orders.most_of(0), scene.mean_force = mean;
    for (ForceOrder<double>& order : oscillator.shape.orders.of)
      if (oscillator.forcing > 0) order = {order.in_phase / oscillator.forcing, order.quadrature / oscillator.forcing};
    return;
  }
  oscillator.shape.table = kept(force->table);
  oscillator.forcing = oscillator.shape.table->peak();
}

void check_force_shape(const Settings& settings) {
  const Waveform waveform = waveform_of(settings);
  if (waveform == Waveform::sine) return;
  const std::string_view key = key_of_shape(settings);
  std::string shape = in_quotes(key);
  if (key == "force_shape")
    shape += " = " + in_quotes(std::get<std::string>(settings.find(settings.scene_section, key)->value));
  if (waveform != Waveform::orders || has_force_table(settings)) check_orders(settings, shape);
  if (!has_force_in_pieces(settings)) return;
  for (const Parameter shaking : std::array<Parameter, 2>{"stop_amplitude", "base_amplitude"})
    if (const SourceLocation* const place = place_of_nonzero(settings.given(shaking)))
      fail(*place, in_quotes(shaking.key()) + " beside " + shape +
                       "; what is shaken moves as a sine, so far beside a force of sines: leave out one of them");
  if (const Setting* const along = settings.find("branch", "along"))
    fail(along->location, "[branch] beside " + shape +
                              "; a branch follows motion under a sine, or several orders of one, so far: leave out " +
                              std::string(key) + ", or follow the motion by sweep.follow");
}

}  // namespace clatter::config
