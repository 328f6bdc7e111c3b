#include "sweep/dataset_axes.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "observables/drawn_names.hpp"

namespace clatter::sweep {
namespace {

constexpr const char* direction = "direction";  ///< the dimension of two directions

/// Places and starts stay relative to what is shaken.
observables::FrameOf frame_of(Parameter parameter) {
  const bool is_place = parameter.row().quantity == Quantity::length && parameter.role() != Role::shaking &&
                        parameter.role() != Role::stop_motion;
  return is_place || parameter.row().quantity == Quantity::velocity ? observables::FrameOf::relative
                                                                    : observables::FrameOf::any;
}

}  // namespace

void name_frame(const Sweep& sweep, observables::FrameOf frame, results::Variable& variable) {
  if (frame == observables::FrameOf::any || !is_shaken(sweep)) return;
  const bool is_absolute = frame == observables::FrameOf::absolute ||
                           (frame == observables::FrameOf::observed && sweep.problem.observe.frame == Frame::absolute);
  const Frame given = is_absolute ? Frame::absolute : Frame::relative;
  variable.attributes.emplace_back("frame", std::string(frame_names[static_cast<std::size_t>(given)]));
}

void add_axes(const Sweep& sweep, results::Dataset& dataset) {
  const bool is_si = sweep.problem.is_si;
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
      dataset.variables.push_back({std::string(axis.parameter.key()),
                                   {std::string(name_of(dimension))},
                                   std::vector<double>(),
                                   std::string(axis.parameter.long_name(is_si)),
                                   std::string(unit_of(axis.parameter.row().quantity, is_si))});
      dataset.variables.back().next = [&axis, at = std::size_t{0}](std::size_t count) mutable {
        const auto values = std::span(axis.values).subspan(at, count);
        at += count;
        return std::vector<double>(values.begin(), values.end());
      };
      name_frame(sweep, frame_of(axis.parameter), dataset.variables.back());
    }
  }
}

void name_samples(const Sweep& sweep, results::Dataset& dataset) {
  std::string names;
  for (const Dimension& dimension : sweep.dimensions)
    for (const Axis& axis : dimension)
      if (axis.is_sample) names.append(names.empty() ? "" : " ").append(axis.parameter.key());
  if (!names.empty()) dataset.attributes.emplace_back("sampled_axes", names);
}

void name_observable(std::string_view key, results::Variable& variable) {
  variable.attributes.emplace_back("observable", std::string(key));
}

void add_drawn_names(bool is_si, results::Dataset& dataset, bool has_loose_mass, bool on_walls) {
  for (results::Variable& variable : dataset.variables) {
    auto [words, symbol] = observables::drawn_name(variable.name, is_si, on_walls);
    if (!words.empty()) variable.attributes.emplace_back("label", std::move(words));
    if (!symbol.empty()) variable.attributes.emplace_back("symbol", std::move(symbol));
  }
  dataset.attributes.emplace_back("scene_names", observables::scene_names(is_si, has_loose_mass));
}

void name_linked_axes(const Sweep& sweep, results::Dataset& dataset) {
  std::vector<std::string> axes;
  for (const Dimension& dimension : sweep.dimensions)
    for (const Axis& axis : dimension) axes.emplace_back(axis.parameter.key());
  for (results::Variable& variable : dataset.variables) {
    if (std::ranges::find(axes, variable.name) != axes.end()) continue;
    std::string linked;
    for (const Dimension& dimension : sweep.dimensions) {
      if (std::ranges::find(variable.dimensions, name_of(dimension)) == variable.dimensions.end()) continue;
      for (const Axis& axis : std::span(dimension).subspan(1))
        linked.append(linked.empty() ? "" : " ").append(axis.parameter.key());
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
