#include "io/keys.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "dynamics/scene.hpp"
#include "io/suggestion.hpp"
#include "io/value_grammar.hpp"

namespace clatter {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

constexpr Range any{};
constexpr Range any_or_infinite{.infinite = true};
constexpr Range not_negative{.low = 0};
constexpr Range positive{.low = 0, .open = true};
constexpr Range not_zero{.not_zero = true};
constexpr Range zero_to_one{.low = 0, .high = 1};

constexpr std::array<std::string_view, 2> modes{"steady", "transient"};
constexpr std::array<std::string_view, 2> harmonics_methods{"fft", "exact"};
constexpr std::array<std::string_view, 2> effects{"required", "all"};

using enum Kind;

constexpr std::array all_keys{
    Key{"", "title", text, "", "what the configuration shows; the output file keeps it"},
    Key{"", "source", text, "", "where it comes from, e.g. a DOI; the output file keeps it"},

    Key{"scene", "h", number, "0", "damping ratio: 2 h is the factor of x'", not_negative},
    Key{"scene", "f", number, "0", "force amplitude over stiffness; negative: a phase shift of pi", any},
    Key{"scene", "nu", number, "1", "excitation frequency over natural frequency", positive},
    Key{"scene", "phase", number, "0", "phase of the force at tau = 0, rad; pi/2: a cosine", any},
    Key{"scene", "R", number, "1", "restitution of velocity on both stops", zero_to_one},
    Key{"scene", "xs", number, "", "symmetric stops at -|xs| and +|xs|", not_zero, {}, "-1.0"},
    Key{"scene", "stop_lower", number, "", "lower stop, in place of xs; -inf: none", any_or_infinite, {}, "-1.0"},
    Key{"scene", "stop_upper", number, "", "upper stop, in place of xs; inf: none", any_or_infinite, {}, "inf"},
    Key{"scene", "R_lower", number, "1", "restitution of the lower stop, in place of R", zero_to_one, {}, "1.0", "R"},
    Key{"scene", "R_upper", number, "1", "restitution of the upper stop, in place of R", zero_to_one, {}, "1.0", "R"},
    Key{"scene", "load", number, "0", "constant force over stiffness", any},
    Key{"scene", "x0", number, "0", "displacement at tau = 0, between the stops", any},
    Key{"scene", "v0", number, "0", "velocity at tau = 0", any},
    Key{"scene",
        "start_period",
        number,
        "",
        "period of the motion to start on, just after its contact with the lower stop; "
        "in place of x0 and v0, where h = f = load = 0, R = 1 and xs is given",
        Range{.low = 0, .high = 2 * std::numbers::pi, .open = true},
        {},
        "3.0"},

    Key{"sweep", "linked", names, "",
        "axes of equal length that run together instead of crossing, e.g. nu, f; the first names the dimension"},
    Key{"sweep", "follow", names, "",
        "one axis (or linked ones) along which each point starts from the end of the one before"},

    Key{"time",
        "mode",
        choice,
        "steady",
        "steady: run until the motion repeats, observe one period; transient: observe from tau = 0",
        {},
        modes},
    Key{"time", "max_periods", integer, "5000", "steady: forcing periods after which settling is given up",
        Range{.low = 1, .high = 1e12}},
    Key{"time", "window", integer, "64", "steady: forcing periods observed of a motion that does not repeat",
        Range{.low = 1, .high = 1e9}},
    Key{"time", "duration", number, "0", "transient: observed time in tau; greater than 0 there", not_negative},
    Key{"time", "tolerance", number, "1e-12", "steady: distance of the states at a repeat",
        Range{.low = 0, .high = 1, .open = true}},
    Key{"time", "max_impacts", integer, "1e8", "impacts after which a point is given up, with the status event_budget",
        Range{.low = 1, .high = 1e15}},

    Key{"observe", "extrema", flag, "false", "x_min x_max v_min v_max, exact, between samples too"},
    Key{"observe", "harmonics", integer, "0", "constant part and amplitudes 1 ... K of x and of x'; 0: none",
        Range{.low = 0, .high = 1e5}},
    Key{"observe",
        "harmonics_method",
        choice,
        "fft",
        "fft: from samples, by FFTW; exact: from the arcs, without aliasing",
        {},
        harmonics_methods},
    Key{"observe", "harmonics_samples", integer, "4096", "FFT samples over the observed time",
        Range{.low = 2, .high = 16777216}},
    Key{"observe", "impacts", flag, "false",
        "per stop: impacts per period, velocity before and after the first, share of time at rest"},
    Key{"observe", "impact_log", flag, "false", "every observed impact"},
    Key{"observe", "trajectory", integer, "0", "samples of tau, x, x' over the observed time; 0: none",
        Range{.low = 2, .high = 1e7, .or_zero = true}},
    Key{"observe", "period", flag, "false", "period of the motion, in tau and in forcing periods"},
    Key{"observe", "stability", flag, "false", "multipliers of the periodic motion, largest Lyapunov exponent"},

    Key{"integrator",
        "method",
        choice,
        "exact",
        "exact: closed-form arcs, proved contacts; to compare with, dopri5: Dormand-Prince pair of orders 5 and 4, "
        "contacts on its dense output; moreau: Moreau-Jean time stepping",
        {},
        method_names},
    Key{"integrator", "tolerance", number, "1e-10",
        "dopri5: error of a step, relative to the size of the motion that start, force and stops suggest",
        Range{.low = 1e-14, .high = 0.1}},
    Key{"integrator", "step", number, "1e-3", "moreau: in forcing periods, without forcing in 2 pi",
        Range{.low = 1e-9, .high = 1}},
    Key{"integrator", "theta", number, "0.5",
        "moreau: weight of a step's end; 1/2: the trapezoidal rule, 1: implicit Euler; below 1/2 stable only for "
        "short steps",
        zero_to_one},
    Key{"integrator",
        "effects",
        choice,
        "required",
        "required: simulate what a scene calls for; all: to compare with, simulate every effect, run max_periods, and "
        "look for the repeat only then",
        {},
        effects},

    Key{"output", "compression", integer, "0", "deflate level of the output file; 0: none", Range{.low = 0, .high = 9}},
};

constexpr std::array<std::string_view, 6> all_sections{"scene", "sweep", "time", "observe", "integrator", "output"};

/// A bound as people write it: 1e9, not 1e+09, and 1e-9, not 1e-09.
std::string bound_text(double bound) {
  if (bound == 2 * std::numbers::pi) return "2*pi";
  std::string number = number_text(bound);
  const std::size_t at = number.find('e');
  if (at == std::string::npos) return number;
  if (number[at + 2] == '0') number.erase(at + 2, 1);
  if (number[at + 1] == '+') number.erase(at + 1, 1);
  return number;
}

std::string describe(const Range& range) {
  if (range.infinite) return "any number, -inf or inf";
  if (range.not_zero) return "any number but 0";
  if (range.low == -infinity) return "any number";
  const std::string low = bound_text(range.low);
  const std::string zero = range.or_zero ? "0 or " : "";
  if (range.high == infinity) return zero + (range.open ? "> " : ">= ") + low;
  const std::string high = bound_text(range.high);
  return range.open ? "> " + low + " and < " + high : zero + low + " ... " + high;
}

}  // namespace

std::span<const Key> keys() { return all_keys; }

std::span<const std::string_view> sections() { return all_sections; }

const Key* find_key(std::string_view section, std::string_view name) {
  for (const Key& key : all_keys) {
    const bool axis = section == "sweep" && key.section == "scene";
    if (key.name == name && (key.section == section || axis)) return &key;
  }
  return nullptr;
}

std::vector<std::string_view> key_names(std::string_view section) {
  std::vector<std::string_view> names_of_section;
  for (const Key& key : all_keys) {
    if (find_key(section, key.name) == &key) names_of_section.push_back(key.name);
  }
  return names_of_section;
}

bool is_free_text(std::string_view section, std::string_view name) {
  const Key* const key = find_key(section, name);
  return key != nullptr && key->kind == text;
}

bool contains(const Range& range, double value) {
  if (std::isinf(value)) return range.infinite;
  if (value == 0 && range.or_zero) return true;
  if (value == 0 && range.not_zero) return false;
  return range.open ? value > range.low && value < range.high : value >= range.low && value <= range.high;
}

std::string permitted(const Key& key) {
  switch (key.kind) {
    case text:
      return "text";
    case names:
      return "names of axes";
    case flag:
      return "true or false";
    case choice:
      return joined(key.choices);
    case integer:
      return "a whole number, " + describe(key.range);
    case number:
      break;
  }
  return describe(key.range);
}

}  // namespace clatter
