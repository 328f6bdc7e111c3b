#include <algorithm>
#include <utility>

#include "observables/sensitivity/sensitivity.hpp"

namespace clatter::observables {

std::vector<Column<Sensitivity::Values>> Sensitivity::columns(const Settings& settings) {
  std::vector<Column<Values>> all;
  const std::vector<Parameter> keys = settings.sensitivity.list();
  for (std::size_t i = 0; i < keys.size(); ++i) {
    const Parameter key = keys[i];
    std::string_view missing = settings.loose_sensitivity
                                   ? "the motion has no period, no force drives it, it grazes a stop or a wall, or a "
                                     "loose mass strikes none"
                                   : "the motion has no period, no force drives it, or it grazes a stop";
    const auto add = [&](const std::string& name, Quantity quantity, FrameOf frame, auto ByKey::*member,
                         std::vector<Coordinate> along = {}) {
      const auto put = [i, member](const Values& values, double* out) {
        const ByKey own = i < values.sensitivities.size() ? values.sensitivities[i] : ByKey{};
        if constexpr (requires { (own.*member).size(); })
          std::ranges::copy(own.*member, out);
        else
          *out = own.*member;
      };
      Column<Values>& column = all.emplace_back();
      column.name = "d_" + name + "_d_" + std::string(key.key());
      column.long_name = "derivative of " + name + " by " + std::string(key.key());
      column.quantity = quantity, column.per = key.row().quantity, column.frame = frame;
      column.along = std::move(along), column.put = put, column.missing_if = missing;
    };
    add("x_min", Quantity::length, FrameOf::observed, &ByKey::x_min);
    add("x_max", Quantity::length, FrameOf::observed, &ByKey::x_max);
    add("period", Quantity::time, FrameOf::any, &ByKey::period);
    add("impact_power", Quantity::power, FrameOf::any, &ByKey::impact_power);
    if (settings.loose_sensitivity) {
      add("y_min", Quantity::length, FrameOf::observed, &ByKey::y_min);
      add("y_max", Quantity::length, FrameOf::observed, &ByKey::y_max);
      add("z_min", Quantity::length, FrameOf::any, &ByKey::z_min);
      add("z_max", Quantity::length, FrameOf::any, &ByKey::z_max);
    }
    missing = "the motion has no period, no force drives it, it grazes a stop, or it doesn't hit this one";
    add("impact_speed", Quantity::velocity, FrameOf::relative, &ByKey::impact_speed, {stop_coordinate()});
  }
  return all;
}

}  // namespace clatter::observables
