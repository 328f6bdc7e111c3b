#include "observables/samples/section.hpp"

#include <cmath>
#include <cstddef>
#include <utility>

#include "math/number.hpp"

namespace clatter::observables {

bool Section::in_lanes(const Settings& settings, const ObservedSpan& span) {
  const bool reaches = span.periodic || span.transient || static_cast<double>(settings.section) <= span.turns;
  return is_driven(span.scene.oscillator) && span.has_whole_turns() && reaches &&
         turns_to(settings.section_phase, span.scene) == 0;
}

double Section::turns_to(double phase, const Scene& scene) {
  const double turns = (phase - scene.start.phase) / (2 * pi<double>()), part = turns - std::floor(turns);
  return part < 1 - 4 * epsilon<double>() ? part : 0.0;
}

std::vector<Column<Section::Values>> Section::columns(const Settings& settings) {
  const auto of = [&](const char* name, const char* long_name, std::vector<double> Values::*member, Quantity quantity) {
    return series<Values>(name, long_name, quantity, {"section", static_cast<std::size_t>(settings.section)},
                          [member](const Values& v) -> const std::vector<double>& { return v.*member; });
  };
  constexpr std::string_view fewer = "the motion has fewer such states: one for each forcing period of its period";
  std::vector<Column<Values>> all{
      missing_if(fewer, in_observed_frame(of("section_x", "displacement in successive periods", &Values::section_x,
                                             Quantity::length))),
      missing_if(fewer, in_observed_frame(of("section_v", "velocity in successive periods", &Values::section_v,
                                             Quantity::velocity)))};
  if (!settings.loose_section) return all;
  all.push_back(missing_if(
      fewer, of("section_z", "place of the loose mass in successive periods", &Values::section_z, Quantity::length)));
  all.push_back(missing_if(fewer, of("section_w", "relative velocity of the loose mass in successive periods",
                                     &Values::section_w, Quantity::velocity)));
  return all;
}

}  // namespace clatter::observables
