#include "sweep/dataset_axes.hpp"

#include <algorithm>
#include <span>

namespace clatter::sweep {
namespace {

constexpr const char* direction = "direction";  ///< the dimension of two directions

/// Of keys that mean another thing in [machine]; nothing for the others.
const char* name_in_si(const Axis& axis) {
  const bool is_damping = axis.quantity == Quantity::damping;
  switch (axis.parameter) {
    case Parameter::stop_damping:
      return is_damping ? "damping coefficient of both stops" : nullptr;
    case Parameter::stop_damping_lower:
      return is_damping ? "damping coefficient of the lower stop" : nullptr;
    case Parameter::stop_damping_upper:
      return is_damping ? "damping coefficient of the upper stop" : nullptr;
    case Parameter::load:
      return "constant force";
    case Parameter::x0:
      return "displacement at t = 0";
    case Parameter::v0:
      return "velocity at t = 0";
    case Parameter::phase:
      return "forcing phase at t = 0";
    default:
      return nullptr;
  }
}

const char* long_name_of(Parameter parameter) {
  switch (parameter) {
    case Parameter::h:
      return "damping ratio";
    case Parameter::f:
      return "force amplitude over stiffness";
    case Parameter::nu:
      return "excitation over natural frequency";
    case Parameter::phase:
      return "forcing phase at tau = 0";
    case Parameter::R:
      return "restitution of velocity";
    case Parameter::xs:
      return "place of the symmetric stops";
    case Parameter::stop_lower:
      return "place of the lower stop";
    case Parameter::stop_upper:
      return "place of the upper stop";
    case Parameter::R_lower:
      return "restitution of the lower stop";
    case Parameter::R_upper:
      return "restitution of the upper stop";
    case Parameter::load:
      return "constant force over stiffness";
    case Parameter::stiffness:
      return "stiffness of the spring";
    case Parameter::stop_amplitude:
      return "amplitude of the motion of both stops";
    case Parameter::base_amplitude:
      return "amplitude of the motion of the base";
    case Parameter::stop_stiffness:
      return "stiffness of both stops";
    case Parameter::stop_stiffness_lower:
      return "stiffness of the lower stop";
    case Parameter::stop_stiffness_upper:
      return "stiffness of the upper stop";
    case Parameter::stop_damping:
      return "damping ratio of both stops";
    case Parameter::stop_damping_lower:
      return "damping ratio of the lower stop";
    case Parameter::stop_damping_upper:
      return "damping ratio of the upper stop";
    case Parameter::mass:
      return "mass";
    case Parameter::damping:
      return "damping coefficient";
    case Parameter::damping_ratio:
      return "damping ratio";
    case Parameter::quality:
      return "quality factor";
    case Parameter::force:
      return "force amplitude";
    case Parameter::frequency:
      return "excitation frequency";
    case Parameter::gap:
      return "distance of the symmetric stops from the middle";
    case Parameter::x0:
      return "displacement at tau = 0";
    case Parameter::v0:
      return "velocity at tau = 0";
    case Parameter::start_period:
      return "period of the free vibration that the start lies on";
  }
  return "";
}

/// Places and starts stay relative to what is shaken.
observables::FrameOf frame_of(Parameter parameter) {
  const Quantity quantity = quantity_of(parameter);
  const bool is_amplitude = parameter == Parameter::stop_amplitude || parameter == Parameter::base_amplitude;
  const bool is_of_frame = (quantity == Quantity::length && !is_amplitude) || quantity == Quantity::velocity;
  return is_of_frame ? observables::FrameOf::relative : observables::FrameOf::any;
}

}  // namespace

void name_frame(const Sweep& sweep, observables::FrameOf frame, Variable& variable) {
  if (frame == observables::FrameOf::any || !is_shaken(sweep)) return;
  const bool is_absolute = frame == observables::FrameOf::observed && sweep.problem.observe.frame == Frame::absolute;
  const Frame given = is_absolute ? Frame::absolute : Frame::relative;
  variable.attributes.emplace_back("frame", std::string(frame_names[static_cast<std::size_t>(given)]));
}

void add_axes(const Sweep& sweep, Dataset& dataset) {
  const bool is_si = sweep.machine.has_value();
  if (sweep.direction == Direction::both) {
    dataset.dimensions.push_back({direction, 2});
    dataset.variables.push_back({direction,
                                 {direction},
                                 std::vector<std::int8_t>{1, -1},
                                 "+1: in the order of the followed axis, -1: back from its end",
                                 "1"});
  }
  for (const Dimension& dimension : sweep.dimensions) {
    dataset.dimensions.push_back({std::string(name_of(dimension)), length(dimension)});
    for (const Axis& axis : dimension) {
      dataset.variables.push_back(
          {std::string(key_of(axis.parameter)),
           {std::string(name_of(dimension))},
           axis.values,
           is_si && name_in_si(axis) != nullptr ? name_in_si(axis) : long_name_of(axis.parameter),
           std::string(unit_of(axis.quantity, is_si))});
      name_frame(sweep, frame_of(axis.parameter), dataset.variables.back());
    }
  }
}

void name_linked_axes(const Sweep& sweep, Dataset& dataset) {
  std::vector<std::string> axes;
  for (const Dimension& dimension : sweep.dimensions)
    for (const Axis& axis : dimension) axes.emplace_back(key_of(axis.parameter));
  for (Variable& variable : dataset.variables) {
    if (std::ranges::find(axes, variable.name) != axes.end()) continue;
    std::string linked;
    for (const Dimension& dimension : sweep.dimensions) {
      if (std::ranges::find(variable.dimensions, name_of(dimension)) == variable.dimensions.end()) continue;
      for (const Axis& axis : std::span(dimension).subspan(1))
        linked.append(linked.empty() ? "" : " ").append(key_of(axis.parameter));
    }
    if (!linked.empty()) variable.attributes.emplace_back("coordinates", linked);
  }
}

std::vector<std::string> axis_names(const Sweep& sweep) {
  std::vector<std::string> names;
  if (sweep.direction == Direction::both) names.emplace_back(direction);
  for (const Dimension& dimension : sweep.dimensions) names.emplace_back(name_of(dimension));
  return names;
}

}  // namespace clatter::sweep
