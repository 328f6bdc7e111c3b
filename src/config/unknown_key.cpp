#include "config/unknown_key.hpp"

#include <algorithm>
#include <vector>

#include "config/keys.hpp"
#include "config/settings.hpp"
#include "config/suggestion.hpp"

namespace clatter::config {
namespace {

/// Names that books and other programs have for a quantity, in lower case, and our key of it.
struct OtherName {
  std::vector<std::string_view> names;
  std::string_view quantity, in_scene, in_machine;
};

const std::vector<OtherName> other_names{
    {{"e", "r", "cor", "restitution", "restitution_coefficient", "coefficient_of_restitution"},
     "the coefficient of restitution",
     "R",
     "R"},
    {{"mu", "friction_coefficient", "coefficient_of_friction", "friction_force", "coulomb", "coulomb_friction"},
     "dry friction, as a force,",
     "friction",
     "friction"},
    {{"mu_s", "mu_static", "static_friction"}, "static friction, as a force,", "friction_static", "friction_static"},
    {{"omega", "freq", "frequency_ratio", "excitation_frequency", "forcing_frequency"},
     "the frequency of the force",
     "nu",
     "frequency"},
    {{"zeta", "xi", "damping_factor"}, "the damping ratio", "h", "damping_ratio"},
    {{"c", "damper", "damping_coefficient"}, "the damping", "h", "damping"},
    {{"q", "q_factor", "quality_factor"}, "the damping", "h", "quality"},
    {{"k", "spring", "spring_constant"}, "the spring", "stiffness", "stiffness"},
    {{"m"}, "the mass", "", "mass"},
    {{"a", "f0", "amplitude", "force_amplitude"}, "the amplitude of the force", "f", "force"},
    {{"g", "gravity", "weight", "static_load"}, "a constant force, such as weight,", "load", "load"},
    {{"clearance", "half_gap", "stops"}, "the distance of both stops", "xs", "gap"},
    {{"kc", "contact_stiffness"}, "the stiffness of a soft stop", "stop_stiffness", "stop_stiffness"},
    {{"contact_damping"}, "the damping of a soft stop", "stop_damping", "stop_damping"},
    {{"y0", "base_excitation"}, "the amplitude of a shaken base", "base_amplitude", "base_amplitude"},
};

/// Our key for a name that the field has for a quantity, and where it belongs unless it was written there.
std::string known_otherwise(const ParsedEntry& entry, std::string_view scene_section) {
  for (const auto& [names, quantity, in_scene, in_machine] : other_names) {
    if (std::ranges::find(names, lower_case(entry.key)) == names.end()) continue;
    const bool is_si = (describes_scene(entry.section) ? entry.section : scene_section) == "machine";
    const std::string_view key = is_si ? in_machine : in_scene;
    if (key.empty()) continue;
    const bool is_at_home = describes_scene(entry.section) || entry.section == "sweep";
    return "; " + std::string(quantity) + " is " + in_quotes(key) +
           (is_at_home ? "" : ", in [" + std::string(scene_section) + ']');
  }
  return {};
}

/// The section in which a key of that name belongs; of both that describe a scene the one that does.
std::string home_of(std::string_view name, std::string_view scene_section) {
  for (const std::string_view section : sections())
    if (section == name) return "; begin the section with [" + std::string(name) + "]";
  const bool is_of_scene = find_key(scene_section, name) != nullptr;
  std::string homes;
  for (const Key& key : keys()) {
    const bool is_other = is_of_scene && describes_scene(key.section) && key.section != scene_section;
    if (key.name == name && !is_other) homes += (homes.empty() ? "; it belongs " : ", or ") + shown(key.section);
  }
  return homes;
}

/// The names that a section takes; of [sweep] those of the section that describes the scene, and its own.
std::vector<std::string_view> names_in(std::string_view section, std::string_view scene_section) {
  if (section != "sweep") return key_names(section);
  std::vector<std::string_view> names = key_names(scene_section);
  for (const Key& key : keys())
    if (key.section == section) names.push_back(key.name);
  return names;
}

std::string list_of(std::string_view section, std::string_view scene_section) {
  if (section != "sweep") return "; expected one of " + joined(key_names(section));
  std::vector<std::string_view> own;
  for (const Key& key : keys())
    if (key.section == section) own.push_back(key.name);
  return "; keys of [" + std::string(scene_section) + "] can be swept: " + joined(key_names(scene_section)) +
         "; beside them [sweep] has " + joined(own);
}

}  // namespace

std::string shown(std::string_view section) {
  return section.empty() ? "before the first section" : "in [" + std::string(section) + "]";
}

std::string way_out_of_unknown_key(const ParsedEntry& entry, std::string_view scene_section) {
  const std::string counterpart(counterpart_of(entry.key));
  if (describes_scene(entry.section) && !counterpart.empty()) return "; there it is " + in_quotes(counterpart);
  if (const std::string home = home_of(entry.key, scene_section); !home.empty()) return home;
  if (const std::string known = known_otherwise(entry, scene_section); !known.empty()) return known;
  const std::string_view near = nearest(entry.key, names_in(entry.section, scene_section));
  if (!near.empty()) return "; did you mean '" + std::string(near) + "'?";
  return list_of(entry.section, scene_section);
}

}  // namespace clatter::config
