#include "plan/reasons.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <limits>

#include "scene/displacement_bound.hpp"
#include "scene/required_effects.hpp"

namespace clatter::plan {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

std::string text(double value) {
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.4g", value);
  return digits.data();
}

/// "a < b" or "a >= b" with as many digits as tell the two apart.
std::string compared(double a, const char* sign, double b) {
  std::array<char, 64> left{}, right{};
  for (int digits = 4; digits <= 17; ++digits) {
    std::snprintf(left.data(), left.size(), "%.*g", digits, a);
    std::snprintf(right.data(), right.size(), "%.*g", digits, b);
    if (left != right) break;
  }
  return std::string(left.data()) + sign + right.data();
}

/// The displacement from the load's equilibrium, as reasons name it.
std::string displacement(const point::Problem& scene) { return scene.oscillator.load == 0 ? "|x|" : "|x - load|"; }

std::string duration_text(const point::Problem& scene) {
  return scene.time.mode == steady::Mode::steady ? "for all time" : "until tau = " + text(scene.time.duration);
}

/// What a bound of the displacement between the stops takes in (eqs. 18 and 62).
std::string bound_contents(const Effects& effects) { return effects.friction ? ", friction included" : ""; }

Reason damping_reason(const Oscillator& oscillator) {
  const std::string h = "h = " + text(oscillator.damping);
  if (oscillator.stiffness <= 0)
    return {"damping", oscillator.damping != 0,
            h + (oscillator.stiffness < 0 ? ", k < 0: free motion is the sum of a growth and a decay"
                                          : ", k = 0: free motion is a drift that damping brings to a halt")};
  switch (damping_of(oscillator)) {
    case Damping::none:
      return {"damping", false, "h = 0: no damping"};
    case Damping::light:
      return {"damping", true, h + " < 1: free motion is a decaying rotation"};
    case Damping::critical:
      return {"damping", true, "h = 1: critical, the limit of rotation and creep"};
    default:
      return {"damping", true, h + " > 1: free motion is the sum of a slow and a fast decay"};
  }
}

/// "of orders 1, 3 and 5"
std::string orders_of(const ForceOrders<double>& orders) {
  std::vector<std::string> numbers;
  for (std::size_t j = 1; j <= orders.of.size(); ++j)
    if (!orders.is_zero(j)) numbers.push_back(std::to_string(j));
  std::string said = numbers.size() > 1 ? "of orders " : "of order ";
  for (std::size_t i = 0; i < numbers.size(); ++i)
    said += (i == 0 ? "" : i + 1 == numbers.size() ? " and " : ", ") + numbers[i];
  return said;
}

Reason forcing_reason(const Oscillator& oscillator) {
  if (oscillator.forcing == 0 && oscillator.paces_stops)
    return {"forcing", true, "f = 0, but as a stop that moves sees it, the mass is forced"};
  if (oscillator.forcing == 0) return {"forcing", false, "f = 0: no forcing"};
  const ForceShape& shape = oscillator.shape;
  std::string said = "f = " + text(oscillator.forcing);
  if (shape.table != nullptr)
    said += ", by a table of " + std::to_string(shape.table->knots().size()) + " straight lines";
  else if (shape.has_orders())
    said += " in all, " + orders_of(shape.orders);
  else if (!shape.is_sine())
    said += ", " + std::string(force_shapes[static_cast<std::size_t>(shape.waveform)]);
  if (const double mean = mean_of(shape); mean != 0) said += " with the mean " + text(oscillator.forcing * mean);
  return {"forcing", true, said};
}

/// The force that takes the place of shaken stops or a shaken base.
Reason shaking_reason(const point::Problem& scene) {
  const bool stops = scene.shaking.stops != 0;
  const std::string key =
      stops ? "stop_amplitude = " + text(scene.shaking.stops) : "base_amplitude = " + text(scene.shaking.base);
  const std::string frame = has_loose_mass(scene.loose) ? "as the ground sees it"
                            : stops                     ? "in the frame of the stops"
                                                        : "in the frame of the base";
  return {"shaking", true, key + ": " + frame + " the force f above, its phase " + text(scene.shaking.lead) + " ahead"};
}

/// Stops that move by themselves.
Reason stop_motion_reason(const point::Problem& scene) {
  std::string said;
  for (const Side side : {Side::lower, Side::upper}) {
    const auto& [amplitude, phase] = motion_of(scene.stops, side);
    if (amplitude == 0) continue;
    said += (said.empty() ? "" : ", ") + std::string(side == Side::lower ? "the lower" : "the upper") + " one by " +
            text(amplitude) + ", its phase " + text(phase) + " ahead";
  }
  return {"stops move", true, said + ": contacts are found as each stop sees the mass"};
}

Reason resonance_of_orders(const Oscillator& oscillator) {
  for (std::size_t j = 1; j <= oscillator.shape.orders.of.size(); ++j) {
    Oscillator alone = oscillator;
    alone.shape = {}, alone.frequency *= static_cast<double>(j);
    if (!oscillator.shape.orders.is_zero(j) && rotates(oscillator) && forcing_of(alone) == Forcing::secular)
      return {"resonance", true,
              "by order " + std::to_string(j) + ", whose response nearly cancels with the transient"};
  }
  return {"resonance", false, "of no order: responses and transient keep their digits apart"};
}

Reason resonance_reason(const Oscillator& oscillator) {
  if (oscillator.stiffness <= 0) return {"resonance", false, "no spring that a force could be in resonance with"};
  const double distance = std::hypot(oscillator.damping, oscillator.frequency - 1);
  if (oscillator.paces_stops) return {"resonance", true, "each stop that moves sees another force"};
  if (oscillator.forcing == 0) return {"resonance", false, "f = 0: nothing to resonate with"};
  if (oscillator.shape.is_in_pieces())
    return {"resonance", true, "a force in pieces: in each of them response and transient are computed together"};
  if (oscillator.shape.has_orders()) return resonance_of_orders(oscillator);
  const std::string what = "hypot(h, nu - 1) = " + text(distance);
  if (forcing_of(oscillator) == Forcing::secular)
    return {"resonance", true, what + " < 1/16: response and transient nearly cancel"};
  return {"resonance", false, what + " >= 1/16: response and transient keep their digits apart"};
}

/// A spring of another stiffness than 1. Points with k > 0 are computed with k = 1, in another unit of time.
Reason stiffness_reason(const point::Problem& scene) {
  const Units& units = scene.units;
  const double computed = scene.oscillator.stiffness, k = computed * factor_of(units, Quantity::stiffness);
  const std::string is = "k = " + text(k) + (units.is_si ? " N/m" : "");
  if (computed == 0) return {"stiffness", true, "k = 0: no spring"};
  const std::string rate = text(1 / units.time);
  const std::string in_units = units.is_si       ? ": times here are in " + text(units.time) + " s"
                               : units.time == 1 ? ""
                                                 : ": times here are in 1/" + rate + ", velocities in " + rate;
  return {"stiffness", computed != 1, is + (computed < 0 ? ", an unstable spring" : "") + in_units};
}

Reason load_reason(const Oscillator& oscillator) {
  if (oscillator.load == 0) return {"load", false, "load = 0"};
  return {"load", true, "load = " + text(oscillator.load)};
}

Reason stop_reason(const point::Problem& scene, const Requirements& needs, bool upper) {
  const std::string name = upper ? "upper stop" : "lower stop";
  const bool required = upper ? needs.effects.upper : needs.effects.lower;
  const double gap = upper ? needs.upper_gap : needs.lower_gap;
  if (std::isinf(gap)) return {name, false, upper ? "stop_upper = inf: no stop" : "stop_lower = -inf: no stop"};
  const std::string bound = displacement(scene) + " <= ", during = ' ' + duration_text(scene);
  if (!needs.effects.stops())
    return {name, false,
            bound + compared(needs.free_reach, " < ", gap) + during + bound_contents(needs.effects) + ": out of reach"};
  if (!required)
    return {name, false, bound + compared(needs.reach, " < ", gap) + during + ", impacts included: out of reach"};
  if (std::isnan(scene.start.displacement))
    return {name, true, "the start is the end of the point before, which isn't known yet"};
  const double reach =
      needs.free_reach < gap ? needs.reach : needs.free_reach;  // pushed there by the other stop, or not
  if (needs.effects.own_motion) return {name, true, "one that moves may be met at any displacement"};
  if (!(reach < infinity)) return {name, true, "nothing bounds " + displacement(scene)};
  return {name, true,
          displacement(scene) + " may reach " + compared(reach, " >= ", gap) + bound_contents(needs.effects)};
}

/// A law of restitution in words.
std::string described(const Restitution<double>& law) {
  const std::string from = law.below > 0 ? " from the speed " + text(law.below) + " on" : "";
  if (law.table != nullptr) return "R by a table of speeds" + from;
  if (law.exponent == 0) return "R = " + text(law.R) + from;
  return "R = " + text(law.R) + " at the speed " + text(law.reference) + ", exponent " + text(law.exponent) + from;
}

Reason dissipation_reason(const point::Problem& scene, const Effects& effects) {
  if (!effects.stops()) return {"dissipation", false, "no stop in reach"};
  const Stops& stops = scene.stops;
  if (effects.soft)
    return {"dissipation", effects.dissipation,
            effects.dissipation ? "contact takes energy" : "stop_damping = 0: contact keeps the energy"};
  if (!effects.dissipation) return {"dissipation", false, "R = 1: impacts keep the speed"};
  const std::string lower = described(stops.restitution_lower), upper = described(stops.restitution_upper);
  if (lower == upper || !effects.lower || !effects.upper) return {"dissipation", true, effects.lower ? lower : upper};
  const bool are_numbers = stops.restitution_lower.is_constant() && stops.restitution_upper.is_constant();
  return {"dissipation", true, lower + " and " + (are_numbers ? text(stops.restitution_upper.R) : upper)};
}

/// Stops that are springs and dampers.
Reason soft_reason(const point::Problem& scene, const Effects& effects) {
  if (!effects.soft) return {"soft stops", false, "out of reach"};
  const auto described = [](double kappa, double zeta) {
    return "stop_stiffness = " + text(kappa) + ", stop_damping = " + text(zeta);
  };
  const Stops& stops = scene.stops;
  const std::string lower = described(stops.stiffness_lower, stops.damping_lower),
                    upper = described(stops.stiffness_upper, stops.damping_upper);
  const bool of_lower = effects.lower && is_soft(stops, Side::lower),
             of_upper = effects.upper && is_soft(stops, Side::upper);
  if (of_lower && of_upper && lower != upper) return {"soft stops", true, "lower: " + lower + "; upper: " + upper};
  return {"soft stops", true, of_lower ? lower : upper};
}

/// Friction, and whether it holds the mass from the start on, for good.
Reason friction_reason(const point::Problem& scene) {
  const auto& [kinetic, level] = scene.friction;
  std::string why = "friction = " + text(kinetic);
  if (level != kinetic) why += ", friction_static = " + text(level);
  if (never_moves(scene))
    why += ": the mass never moves, since the other forces at its start never exceed " + text(level);
  return {"friction", true, why};
}

/// A loose mass, and whether it is proved to stay clear of its walls: with y' = 0 for all time, since any drift strikes
/// in the end.
Reason loose_reason(const point::Problem& scene) {
  const LooseMass& loose = scene.loose;
  const Oscillator& o = scene.oscillator;
  const Stops walls = walls_of(loose);
  const auto described_at = [&](Side side) {
    const bool lower = side == Side::lower;
    if (!is_soft(walls, side)) return described(law_of(walls, side));
    return "stiffness = " + text(lower ? walls.stiffness_lower : walls.stiffness_upper) +
           ", damping = " + text(lower ? walls.damping_lower : walls.damping_upper);
  };
  const std::string lower = described_at(Side::lower), upper = described_at(Side::upper);
  std::string why = "loose_mass = " + text(loose.ratio) + ", walls at " + text(loose.lower) + " and " +
                    text(loose.upper) + ", " + lower + (upper == lower ? "" : " and " + upper);
  const double middle = equilibrium_of(o), y = scene.start.displacement + loose.place - middle;
  if (has_loose_friction(loose)) {
    why += ", loose_friction = " + text(loose.friction);
    if (loose.friction_static != loose.friction) why += ", loose_friction_static = " + text(loose.friction_static);
  } else if (loose.load == 0 && scene.start.velocity + loose.velocity == 0) {
    const PhaseState start{scene.start.displacement - middle, scene.start.velocity, std::sin(scene.start.phase),
                           std::cos(scene.start.phase)};
    const double reach = displacement_bound(o, start, duration_of(scene.time), 0.0),
                 gap = std::fmin(loose.upper - y, y - loose.lower);
    if (reach < gap)
      why += "; it stands, and " + displacement(scene) + " <= " + compared(reach, " < ", gap) + ' ' +
             duration_text(scene) + ": its walls are out of reach";
  }
  return {"loose mass", true, why};
}

Reason rest_reason(const point::Problem& scene, const Requirements& needs) {
  const std::string effect = "chatter and rest";
  if (!needs.effects.stops()) return {effect, false, "no stop in reach"};
  if (needs.effects.soft && !needs.effects.rest)
    return {effect, false, "a soft stop holds no mass, and no rigid one in reach can"};
  const bool lower = needs.effects.lower && !is_soft(scene.stops, Side::lower),
             upper = needs.effects.upper && !is_soft(scene.stops, Side::upper);
  if (needs.effects.own_motion && needs.effects.rest)
    return {effect, true, "a stop that moves can be pressed by its motion"};
  const bool lower_first = lower && (!upper || needs.lower_gap < needs.upper_gap);
  const double gap = lower_first ? constant_force(scene.oscillator, scene.stops.lower)
                                 : -constant_force(scene.oscillator, scene.stops.upper);
  const double weight = std::abs(scene.loose.ratio * scene.loose.load);  // with which a wall presses the loose mass
  const double rubbing = scene.loose.friction_static;
  const std::string force = std::string("|f|") + (needs.effects.friction ? " + static friction" : "") +
                            (weight != 0 ? " + loose_mass |loose_load|" : "") +
                            (rubbing != 0 ? " + static friction of the loose mass" : "") + " = " +
                            text(std::abs(scene.oscillator.forcing) + scene.friction.static_level + weight + rubbing) +
                            (needs.effects.rest ? " >= " : " < ") + text(gap) +
                            (scene.oscillator.stiffness != 1 ? ", k times the stop less the load"
                             : scene.oscillator.load == 0    ? ""
                                                             : ", the gap from the load");
  return {effect, needs.effects.rest,
          force + (!needs.effects.rest      ? ": no stop can hold the mass"
                   : needs.effects.friction ? ": a stop can be pressed, or friction hold the mass on it"
                                            : ": a stop can be pressed")};
}

/// The share of the time that leaving an effect out saves, as measured on the ladder of scenes in src/scene/README.md.
Bounds measured_saving(const std::string& effect) {
  if (effect == "damping") return {0.13, 0.23};
  if (effect == "forcing") return {0.09, 0.3};
  if (effect == "resonance") return {0.07, 0.07};
  return {0.08, 0.17};  // both stops
}

/// The effects of a scene with one more, if compiled sets differ by it.
Effects kept_in(Effects effects, const std::string& effect) {
  if (effect == "damping") effects.damping = std::max(effects.damping, Damping::light);
  if (effect == "forcing") effects.forcing = std::max(effects.forcing, Forcing::regular);
  if (effect == "resonance" && effects.damping <= Damping::light) effects.forcing = Forcing::secular;
  if (effect == "lower stop" || effect == "upper stop") effects.lower = effects.upper = true;
  return effects;
}

}  // namespace

std::vector<Reason> reasons_of(const point::Problem& scene) {
  const Requirements needs = requirements_of(scene, duration_of(scene.time));
  std::vector<Reason> reasons{damping_reason(scene.oscillator), forcing_reason(scene.oscillator),
                              resonance_reason(scene.oscillator), load_reason(scene.oscillator)};
  if (needs.effects.loose) reasons.push_back(loose_reason(scene));
  if (!needs.effects.loose || has_events_of_its_own(scene))
    reasons.insert(reasons.end(), {stop_reason(scene, needs, false), stop_reason(scene, needs, true),
                                   dissipation_reason(scene, needs.effects), rest_reason(scene, needs)});
  if (scene.oscillator.stiffness != 1 || scene.units != Units{}) reasons.push_back(stiffness_reason(scene));
  if (has_soft_stop(scene.stops)) reasons.push_back(soft_reason(scene, needs.effects));
  if (needs.effects.friction) reasons.push_back(friction_reason(scene));
  if (is_shaken(scene.shaking)) reasons.push_back(shaking_reason(scene));
  if (needs.effects.own_motion) reasons.push_back(stop_motion_reason(scene));
  for (Reason& reason : reasons) {
    const bool has_no_set = effect_set_of(kept_in(needs.effects, reason.effect)) == effect_set_of(needs.effects);
    if (!reason.required && !has_no_set) reason.saving = measured_saving(reason.effect);
  }
  return reasons;
}

}  // namespace clatter::plan
