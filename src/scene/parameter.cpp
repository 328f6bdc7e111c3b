#include "scene/parameter.hpp"

namespace clatter {
inline namespace scene {

std::optional<Parameter> Parameter::of(std::string_view key, Quantity written) {
  std::optional<Parameter> found;
  for (const Parameter parameter : all_parameters) {
    if (parameter.key() != key) continue;
    const bool is_better = parameter.row().is_with_unit ? parameter.row().quantity == written : true;
    if (is_better) found = parameter;
  }
  return found;
}

std::vector<Parameter> ParameterSet::list() const {
  std::vector<Parameter> parameters;
  for (const Parameter parameter : all_parameters)
    if (contains(parameter)) parameters.push_back(parameter);
  return parameters;
}

}  // namespace scene
}  // namespace clatter
