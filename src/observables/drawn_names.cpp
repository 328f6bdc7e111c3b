#include "observables/drawn_names.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "scene/parameter.hpp"

namespace clatter::observables {
namespace {

struct Name {
  std::string_view words, symbol;
};

struct NamedVariable {
  std::string_view variable;
  Name name;
  std::optional<Name> in_si{};  ///< where a scene is given in [machine], if that is another
};

/// In the order of captions. [machine] has its own keys as symbols, but for the letters of m x'' + c x' + k x.
constexpr NamedVariable names[] = {
    {"h", {"damping ratio", "$h$"}},
    {"f", {"force amplitude", "$f$"}},
    {"nu", {"excitation frequency", "$\\nu$"}},
    {"phase", {"forcing phase", "$\\varphi$"}, Name{"forcing phase", "phase"}},
    {"R", {"restitution", "$R$"}},
    {"xs", {"stop", "$x_s$"}},
    {"stop_lower", {"lower stop", "$x_-$"}, Name{"", "stop_lower"}},
    {"stop_upper", {"upper stop", "$x_+$"}, Name{"", "stop_upper"}},
    {"R_lower", {"restitution, lower stop", "$R_-$"}, Name{"", "R_lower"}},
    {"R_upper", {"restitution, upper stop", "$R_+$"}, Name{"", "R_upper"}},
    {"force_duty", {"share of the first part of the force", "$d$"}, Name{"", "force_duty"}},
    {"force_rise", {"share of the rise of the force", "$r$"}, Name{"", "force_rise"}},
    {"force_factor", {"factor of the measured force", "$c_f$"}, Name{"", "force_factor"}},
    {"f_2", {"order 2 of the force", "$f_2$"}},
    {"f_3", {"order 3 of the force", "$f_3$"}},
    {"f_4", {"order 4 of the force", "$f_4$"}},
    {"f_5", {"order 5 of the force", "$f_5$"}},
    {"f_6", {"order 6 of the force", "$f_6$"}},
    {"f_7", {"order 7 of the force", "$f_7$"}},
    {"f_8", {"order 8 of the force", "$f_8$"}},
    {"force_2", {"order 2 of the force", "$F_2$"}},
    {"force_3", {"order 3 of the force", "$F_3$"}},
    {"force_4", {"order 4 of the force", "$F_4$"}},
    {"force_5", {"order 5 of the force", "$F_5$"}},
    {"force_6", {"order 6 of the force", "$F_6$"}},
    {"force_7", {"order 7 of the force", "$F_7$"}},
    {"force_8", {"order 8 of the force", "$F_8$"}},
    {"phase_2", {"phase of order 2 of the force", "$\\varphi_2$"}, Name{"", "phase_2"}},
    {"phase_3", {"phase of order 3 of the force", "$\\varphi_3$"}, Name{"", "phase_3"}},
    {"phase_4", {"phase of order 4 of the force", "$\\varphi_4$"}, Name{"", "phase_4"}},
    {"phase_5", {"phase of order 5 of the force", "$\\varphi_5$"}, Name{"", "phase_5"}},
    {"phase_6", {"phase of order 6 of the force", "$\\varphi_6$"}, Name{"", "phase_6"}},
    {"phase_7", {"phase of order 7 of the force", "$\\varphi_7$"}, Name{"", "phase_7"}},
    {"phase_8", {"phase of order 8 of the force", "$\\varphi_8$"}, Name{"", "phase_8"}},
    {"R_exponent", {"exponent of the restitution", "$p$"}, Name{"", "R_exponent"}},
    {"R_reference_speed", {"reference speed of the restitution", "$V$"}, Name{"", "R_reference_speed"}},
    {"R_below", {"least speed of a rebound", "$v_{r}$"}, Name{"", "R_below"}},
    {"R_exponent_lower", {"exponent of the restitution, lower stop", "$p_-$"}, Name{"", "R_exponent_lower"}},
    {"R_reference_speed_lower",
     {"reference speed of the restitution, lower stop", "$V_-$"},
     Name{"", "R_reference_speed_lower"}},
    {"R_below_lower", {"least speed of a rebound, lower stop", "$v_{r-}$"}, Name{"", "R_below_lower"}},
    {"R_exponent_upper", {"exponent of the restitution, upper stop", "$p_+$"}, Name{"", "R_exponent_upper"}},
    {"R_reference_speed_upper",
     {"reference speed of the restitution, upper stop", "$V_+$"},
     Name{"", "R_reference_speed_upper"}},
    {"R_below_upper", {"least speed of a rebound, upper stop", "$v_{r+}$"}, Name{"", "R_below_upper"}},
    {"stop_stiffness", {"stiffness of the stops", "$\\kappa$"}, Name{"", "stop_stiffness"}},
    {"stop_stiffness_lower", {"stiffness of the lower stop", "$\\kappa_-$"}, Name{"", "stop_stiffness_lower"}},
    {"stop_stiffness_upper", {"stiffness of the upper stop", "$\\kappa_+$"}, Name{"", "stop_stiffness_upper"}},
    {"stop_damping", {"damping of the stops", "$\\zeta$"}, Name{"", "stop_damping"}},
    {"stop_damping_lower", {"damping of the lower stop", "$\\zeta_-$"}, Name{"", "stop_damping_lower"}},
    {"stop_damping_upper", {"damping of the upper stop", "$\\zeta_+$"}, Name{"", "stop_damping_upper"}},
    {"stop_R", {"restitution of the soft stops", "$R_s$"}, Name{"", "stop_R"}},
    {"stop_R_lower", {"restitution, lower soft stop", "$R_{s-}$"}, Name{"", "stop_R_lower"}},
    {"stop_R_upper", {"restitution, upper soft stop", "$R_{s+}$"}, Name{"", "stop_R_upper"}},
    {"load", {"constant load", "load"}},
    {"stiffness", {"stiffness", "$k$"}},
    {"mass", {"mass", "$m$"}},
    {"damping", {"damping", "$c$"}},
    {"damping_ratio", {"damping ratio", "$h$"}, Name{"", "damping_ratio"}},
    {"quality", {"quality factor", "$Q$"}, Name{"quality factor", "quality"}},
    {"force", {"force amplitude", "$F$"}},
    {"frequency", {"excitation frequency", "$f$"}, Name{"excitation frequency", "frequency"}},
    {"gap", {"stop", "$x_s$"}, Name{"", "gap"}},
    {"friction", {"dry friction", "$\\mu$"}, Name{"", "friction"}},
    {"friction_static", {"static friction", "$\\mu_s$"}, Name{"", "friction_static"}},
    {"stop_amplitude", {"amplitude of the stops", "$b$"}, Name{"", "stop_amplitude"}},
    {"base_amplitude", {"amplitude of the base", "$b$"}, Name{"", "base_amplitude"}},
    {"stop_phase", {"lead of the shaking", "$\\sigma$"}, Name{"", "stop_phase"}},
    {"stop_amplitude_lower", {"amplitude of the lower stop", "$b_-$"}, Name{"", "stop_amplitude_lower"}},
    {"stop_amplitude_upper", {"amplitude of the upper stop", "$b_+$"}, Name{"", "stop_amplitude_upper"}},
    {"stop_phase_lower", {"lead of the lower stop", "$\\sigma_-$"}, Name{"", "stop_phase_lower"}},
    {"stop_phase_upper", {"lead of the upper stop", "$\\sigma_+$"}, Name{"", "stop_phase_upper"}},
    {"loose_mass", {"loose mass", "$\\varepsilon$"}, Name{"", "loose_mass"}},
    {"loose_gap", {"walls of the loose mass", "$s$"}, Name{"", "loose_gap"}},
    {"loose_lower", {"lower wall of the loose mass", "$z_-$"}, Name{"", "loose_lower"}},
    {"loose_upper", {"upper wall of the loose mass", "$z_+$"}, Name{"", "loose_upper"}},
    {"loose_R", {"restitution of the loose mass", "$R_z$"}, Name{"", "loose_R"}},
    {"loose_R_lower", {"restitution, lower wall", "$R_{z-}$"}, Name{"", "loose_R_lower"}},
    {"loose_R_upper", {"restitution, upper wall", "$R_{z+}$"}, Name{"", "loose_R_upper"}},
    {"loose_R_exponent", {"exponent of the restitution of the loose mass", "$p_{z}$"}, Name{"", "loose_R_exponent"}},
    {"loose_R_reference_speed",
     {"reference speed of the restitution of the loose mass", "$V_{z}$"},
     Name{"", "loose_R_reference_speed"}},
    {"loose_R_below", {"least speed of a rebound of the loose mass", "$v_{rz}$"}, Name{"", "loose_R_below"}},
    {"loose_R_exponent_lower",
     {"exponent of the restitution, lower wall", "$p_{z-}$"},
     Name{"", "loose_R_exponent_lower"}},
    {"loose_R_reference_speed_lower",
     {"reference speed of the restitution, lower wall", "$V_{z-}$"},
     Name{"", "loose_R_reference_speed_lower"}},
    {"loose_R_below_lower", {"least speed of a rebound, lower wall", "$v_{rz-}$"}, Name{"", "loose_R_below_lower"}},
    {"loose_R_exponent_upper",
     {"exponent of the restitution, upper wall", "$p_{z+}$"},
     Name{"", "loose_R_exponent_upper"}},
    {"loose_R_reference_speed_upper",
     {"reference speed of the restitution, upper wall", "$V_{z+}$"},
     Name{"", "loose_R_reference_speed_upper"}},
    {"loose_R_below_upper", {"least speed of a rebound, upper wall", "$v_{rz+}$"}, Name{"", "loose_R_below_upper"}},
    {"loose_wall_stiffness", {"stiffness of the walls", "$\\kappa_z$"}, Name{"", "loose_wall_stiffness"}},
    {"loose_wall_stiffness_lower",
     {"stiffness of the lower wall", "$\\kappa_{z-}$"},
     Name{"", "loose_wall_stiffness_lower"}},
    {"loose_wall_stiffness_upper",
     {"stiffness of the upper wall", "$\\kappa_{z+}$"},
     Name{"", "loose_wall_stiffness_upper"}},
    {"loose_wall_damping", {"damping of the walls", "$\\zeta_z$"}, Name{"", "loose_wall_damping"}},
    {"loose_wall_damping_lower", {"damping of the lower wall", "$\\zeta_{z-}$"}, Name{"", "loose_wall_damping_lower"}},
    {"loose_wall_damping_upper", {"damping of the upper wall", "$\\zeta_{z+}$"}, Name{"", "loose_wall_damping_upper"}},
    {"loose_wall_R", {"restitution of the soft walls", "$R_{zs}$"}, Name{"", "loose_wall_R"}},
    {"loose_wall_R_lower", {"restitution, lower soft wall", "$R_{zs-}$"}, Name{"", "loose_wall_R_lower"}},
    {"loose_wall_R_upper", {"restitution, upper soft wall", "$R_{zs+}$"}, Name{"", "loose_wall_R_upper"}},
    {"loose_load", {"acceleration of the loose mass", "$g$"}, Name{"", "loose_load"}},
    {"loose_friction", {"friction of the loose mass", "$\\mu_z$"}, Name{"", "loose_friction"}},
    {"loose_friction_static", {"static friction of the loose mass", "$\\mu_{zs}$"}, Name{"", "loose_friction_static"}},
    {"loose_x0", {"initial place of the loose mass", "$z(0)$"}},
    {"loose_v0", {"initial relative velocity of the loose mass", "$z$′$(0)$"}},
    {"x0", {"initial displacement", "$x(0)$"}},
    {"v0", {"initial velocity", "$x$′$(0)$"}},
    {"start_period", {"period", "$\\bar\\tau$"}},
    {"tau", {"time", "$\\tau$"}, Name{"time", "$t$"}},
    {"x", {"displacement", "$x$"}},
    {"v", {"velocity", "$x$′"}},
    {"impact_tau", {"time", "$\\tau$"}, Name{"time", "$t$"}},
    {"impact_v_before", {"velocity before impact", "$x$′$^{{-}}$"}},
    {"impact_v_before_absolute", {"velocity before impact", "$x$′$^{{-}}$"}},
    {"impact_phase", {"forcing phase of the impact", "$\\theta$"}},
    {"section_x", {"displacement", "$x$"}},
    {"section_v", {"velocity", "$x$′"}},
    {"z", {"place in the housing", "$z$"}},
    {"w", {"velocity in the housing", "$z$′"}},
    {"section_z", {"place in the housing", "$z$"}},
    {"section_w", {"velocity in the housing", "$z$′"}},
    {"y_min", {"minimum", "$y_{\\min}$"}},
    {"y_max", {"maximum", "$y_{\\max}$"}},
    {"z_min", {"minimum", "$z_{\\min}$"}},
    {"z_max", {"maximum", "$z_{\\max}$"}},
    {"x_min", {"minimum", "$x_{\\min}$"}},
    {"x_max", {"maximum", "$x_{\\max}$"}},
    {"v_min", {"minimum", "$x$′$_{\\min}$"}},
    {"v_max", {"maximum", "$x$′$_{\\max}$"}},
    {"v_before", {"velocity before impact", "$x$′$^{{-}}$"}},
    {"v_after", {"velocity after impact", "$x$′$^{{+}}$"}},
    {"period", {"period", "$\\bar\\tau$"}, Name{"period", "$T$"}},
    {"eigenfrequency", {"eigenfrequency", "$\\bar\\omega$"}, Name{"eigenfrequency", ""}},
    {"period_ratio", {"period", "$\\nu\\bar\\tau/2\\pi$"}, Name{"period in forcing periods", ""}},
    {"velocity_ratio", {"velocity ratio", "$|x$′$^{{-}}/x_s|$"}, Name{"velocity ratio", "$|x$′$^{{-}}|$ / gap"}},
    {"base_frequency", {"base frequency", "$\\Omega$"}, Name{"base frequency", ""}},
    {"harmonic", {"harmonic", "$k$"}},
    {"x_amplitude", {"amplitude of displacement", "$a_k$"}},
    {"v_amplitude", {"amplitude of velocity", "$a$′$_k$"}},
    {"x_phase", {"phase of displacement", "$\\varphi_k$"}},
    {"v_phase", {"phase of velocity", "$\\varphi$′$_k$"}},
    {"z_amplitude", {"amplitude in the housing", "$z_k$"}},
    {"w_amplitude", {"amplitude of relative velocity", "$z$′$_k$"}},
    {"z_phase", {"phase in the housing", "$\\psi_k$"}},
    {"w_phase", {"phase of relative velocity", "$\\psi$′$_k$"}},
    {"multiplier_re", {"multipliers", "$\\mathrm{Re}\\,\\mu$"}},
    {"multiplier_im", {"multipliers", "$\\mathrm{Im}\\,\\mu$"}},
    {"lyapunov", {"Lyapunov exponent", "$\\lambda$"}},
    {"impacts_per_period", {"impacts per period", ""}},
    {"rest_fraction", {"share of time at rest", ""}},
    {"stick_fraction", {"share of time stuck", ""}},
    {"contact_fraction", {"share of time in contact", ""}},
    {"contact_force_max", {"greatest force of the stop", ""}},
    {"symmetric", {"symmetric motion", ""}},
    {"attractor", {"motion", ""}},
    {"settling_periods", {"periods until settled", ""}},
    {"time_to_rest", {"time to rest", "$\\tau_0$"}, Name{"time to rest", "$t_0$"}},
    {"work_in", {"work of force and load", "work"}},
    {"loss_damping", {"loss by damping", "damping"}},
    {"loss_friction", {"loss by friction", "friction"}},
    {"loss_impact", {"loss by impacts", ""}},
    {"impulse", {"impulse", ""}},
    {"impact_power", {"power lost in impacts", ""}},
    {"wall_impacts_per_period", {"impacts of the loose mass per period", ""}},
    {"wall_v_before", {"relative velocity before impact", "$z$′$^{{-}}$"}},
    {"wall_v_after", {"relative velocity after impact", "$z$′$^{{+}}$"}},
    {"wall_contact_fraction", {"share of time in contact with the wall", ""}},
    {"wall_contact_force_max", {"greatest force of the wall", ""}},
    {"wall_impact_speed", {"speed of the fastest impact of the loose mass", ""}},
    {"wall_rest_fraction", {"share of time pressed on the wall", ""}},
    {"wall_loss_impact", {"loss by impacts of the loose mass", ""}},
    {"wall_impulse", {"impulse on the wall", ""}},
};

/// Of the impacts of a loose mass.
constexpr NamedVariable names_in_housing[] = {
    {"impact_v_before", {"relative velocity before impact", "$z$′$^{{-}}$"}},
    {"impact_v_before_absolute", {"velocity of the loose mass before impact", "$y$′$^{{-}}$"}},
    {"v_before", {"relative velocity before impact", "$z$′$^{{-}}$"}},
    {"v_after", {"relative velocity after impact", "$z$′$^{{+}}$"}},
    {"velocity_ratio", {"velocity ratio", "$|z$′$^{{-}}/s|$"}, Name{"velocity ratio", "$|z$′$^{{-}}|$ / loose_gap"}},
    {"rest_fraction", {"share of time pressed on the wall", ""}},
};

const NamedVariable* find(std::string_view variable, bool has_loose_mass) {
  const auto of = [&](const auto& table) -> const NamedVariable* {
    const auto* const found = std::ranges::find(table, variable, &NamedVariable::variable);
    return found == std::ranges::end(table) ? nullptr : found;
  };
  const NamedVariable* const in_housing = has_loose_mass ? of(names_in_housing) : nullptr;
  return in_housing != nullptr ? in_housing : of(names);
}

/// The result and the key of a derivative d_RESULT_d_KEY; both empty if it is none.
std::pair<std::string_view, std::string_view> parts_of_derivative(std::string_view variable) {
  constexpr std::string_view begin = "d_", middle = "_d_";
  const std::size_t at = variable.find(middle, begin.size());
  if (!variable.starts_with(begin) || at == std::string_view::npos) return {};
  return {variable.substr(begin.size(), at - begin.size()), variable.substr(at + middle.size())};
}

std::string symbol_of(std::string_view variable, bool is_si) {
  const std::string symbol = drawn_name(variable, is_si).symbol;
  return symbol.empty() ? std::string(variable) : symbol;
}

}  // namespace

DrawnName drawn_name(std::string_view variable, bool is_si, bool has_loose_mass) {
  if (const auto [result, key] = parts_of_derivative(variable); !key.empty())
    return {"sensitivity", "∂" + symbol_of(result, is_si) + "/∂" + symbol_of(key, is_si)};
  const NamedVariable* const found = find(variable, has_loose_mass);
  if (found == nullptr) return {};
  const Name& name = is_si && found->in_si ? *found->in_si : found->name;
  return {std::string(name.words), std::string(name.symbol)};
}

std::string scene_names(bool is_si, bool has_loose_mass) {
  std::string lines;
  for (const NamedVariable& named : names) {
    const auto parameter = Parameter::of(named.variable);
    if (!parameter || !parameter->is_in(is_si ? "machine" : "scene")) continue;
    if (parameter->is_loose() && !has_loose_mass) continue;
    const auto put = [&](std::string_view name, std::string_view text) {  // no text has a quote
      lines.append(name).append(" = '").append(text).append("'");
    };
    lines.append(named.variable).append(" = { ");
    put("units", unit_of(parameter->row().quantity, is_si)), lines += ", ";
    put("words", named.name.words), lines += ", ";
    put("symbol", drawn_name(named.variable, is_si).symbol), lines += " }\n";
  }
  return lines;
}

}  // namespace clatter::observables
