#include "certify/reproduced.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <string_view>
#include <type_traits>
#include <variant>

#include "math/number.hpp"
#include "tables/file_points.hpp"

namespace clatter::app {
namespace {

using results::Variable;

/// Results that tell how a run came to its motion or how far rounding was off, or that other points share in.
constexpr std::array<std::string_view, 11> not_of_the_motion{
    "impact_total",   "simulated_periods", "settling_estimate", "settling_periods", "energy_residual",  "motion_points",
    "motion_example", "motion_count",      "motion_share",      "motion_share_low", "motion_share_high"};
constexpr std::array<std::string_view, 4> extreme_values{"x_min", "x_max", "v_min", "v_max"};

/// The key of [observe] that asks for a variable; empty: none.
std::string_view observable_of(const Variable& variable) {
  const auto found = std::ranges::find(variable.attributes, "observable", &results::Attribute::first);
  const auto* const text = found == variable.attributes.end() ? nullptr : std::get_if<std::string>(&found->second);
  return text != nullptr ? *text : std::string_view();
}

/// The largest number of a point in a variable, and in the others of its observable and unit, since a small one of them
/// may be a difference of large ones.
double scale_of(const PointRows& rows, const Variable& like, std::size_t point) {
  double largest = 0.0;
  for (const Variable& variable : rows.dataset().variables) {
    const auto* const values = std::get_if<std::vector<double>>(&variable.values);
    const bool is_alike = variable.name == like.name || (variable.units == like.units && !observable_of(like).empty() &&
                                                         observable_of(variable) == observable_of(like));
    if (values == nullptr || !is_alike || !rows.has_rows(variable)) continue;
    const auto [first, count] = rows.row(variable, point);
    for (const double value : std::span(*values).subspan(first, count))
      if (std::isfinite(value)) largest = std::max(largest, std::abs(value));
  }
  return largest;
}

/// The amplitudes to which the phases of a variable belong; null if it has none. The less one is, the less its phase
/// means.
const std::vector<double>* amplitudes_of(const PointRows& rows, const Variable& phases) {
  constexpr std::string_view phase = "phase";
  if (!phases.name.ends_with(phase)) return nullptr;
  return results::values_of<double>(rows.dataset(),
                                    phases.name.substr(0, phases.name.size() - phase.size()) + "amplitude");
}

bool are_near(double one, double other, double most, bool is_angle) {
  if (one == other || (std::isnan(one) && std::isnan(other))) return true;
  return std::abs(is_angle ? std::remainder(one - other, 2 * pi<double>()) : one - other) <= most;
}

/// Compares one variable of a run with that of a file.
class ComparisonOfPoints {
 public:
  ComparisonOfPoints(const PointRows& run, std::size_t point, const PointRows& file, std::size_t point_of_file)
      : run_(run), file_(file), point_(point), point_of_file_(point_of_file) {}

  [[nodiscard]] bool are_same(const Variable& ran, const Variable& stored, double tolerance) const {
    if (stored.values.index() != ran.values.index()) return false;
    return std::visit(
        [&]<class T>(const std::vector<T>& values) {
          const auto one = part(values, run_.row(ran, point_));
          const auto other = part(std::get<std::vector<T>>(stored.values), file_.row(stored, point_of_file_));
          if constexpr (std::is_same_v<T, double>) {
            return std::ranges::equal(one, other) || are_near(ran, one, other, tolerance);
          } else if constexpr (std::is_same_v<T, std::string>) {  // an empty text says nothing
            return std::ranges::equal(one, other, [](auto& p, auto& q) { return q.empty() || p == q; });
          } else {
            return std::ranges::equal(one, other);
          }
        },
        ran.values);
  }

 private:
  [[nodiscard]] bool are_near(const Variable& ran, std::span<const double> one, std::span<const double> other,
                              double tolerance) const {
    const bool is_angle = ran.units == "rad";
    const auto* const amplitudes = is_angle ? amplitudes_of(run_, ran) : nullptr;
    const auto sizes = amplitudes != nullptr ? part(*amplitudes, run_.row(ran, point_)) : std::span<const double>();
    const double largest = sizes.empty() ? scale_of(run_, ran, point_) : std::ranges::max(sizes);
    std::size_t i = 0;
    return std::ranges::equal(one, other, [&](double p, double q) {
      const double most = tolerance * (i < sizes.size() ? largest / sizes[i] : largest);
      return ++i, app::are_near(p, q, most, is_angle);
    });
  }
  template <class T>
  static std::span<const T> part(const std::vector<T>& values, const PointRows::Row& row) {
    return std::span(values).subspan(row.first, row.count);
  }

  const PointRows &run_, &file_;
  std::size_t point_, point_of_file_;
};

constexpr double of_derived_results = 1e-9;

/// How far results may differ that count as the same, relative to the largest of their kind.
struct Tolerances {
  double extrema = of_derived_results;      ///< of displacement and velocity
  double derivatives = of_derived_results;  ///< of multipliers, and of what follows from the derivative of the motion
  double others = of_derived_results;       ///< of all else that follows from the motion

  [[nodiscard]] double of(std::string_view name) const {
    if (name.starts_with(special_prefix)) name.remove_prefix(special_prefix.size());
    if (std::ranges::find(extreme_values, name) != extreme_values.end()) return extrema;
    const bool derives = name.starts_with("multiplier_") || name == "lyapunov" || name.starts_with("d_");
    return derives ? derivatives : others;
  }
};

/// The errors that a certificate states, but no less than the rounding of a run on another machine.
Tolerances tolerances_of(const certificates::Certificate& certificate) {
  constexpr double of_a_run = 1e-12;
  double speed = 0.0, error = certificate.x_error, late = 0.0, multipliers = 0.0;
  for (const certificates::ClaimedEvent& event : certificate.events) {
    late = std::max(late, event.time.error);
    if (event.kind != motion::Event::Kind::impact) continue;
    speed = std::max(speed, std::abs(event.then.value)), error = std::max(error, event.then.error);
  }
  const double size = std::max({std::abs(certificate.x_min.value), std::abs(certificate.x_max.value),
                                certificate.x_max.value - certificate.x_min.value, speed});
  if (certificate.end) error = std::max({error, certificate.end->x.error, certificate.end->v.error});
  if (certificate.period && certificate.period->multipliers)
    for (const auto& [re, im, off] : *certificate.period->multipliers)
      multipliers = std::max(multipliers, off / std::max(1.0, std::hypot(re, im)));
  const double extremum = std::max(certificate.x_min.error, certificate.x_max.error) / size;
  const double time = late / period_of(certificate.scene.oscillator);
  return {std::max(of_a_run, extremum), std::max(of_derived_results, multipliers),
          std::max({of_derived_results, extremum, error / size, time})};
}

}  // namespace

std::optional<std::string> difference(const PointRows& run, std::size_t point, const PointRows& file,
                                      std::size_t point_of_file,
                                      const std::optional<certificates::Certificate>& certificate,
                                      std::string_view only) {
  const ComparisonOfPoints comparison(run, point, file, point_of_file);
  const Tolerances tolerances = certificate ? tolerances_of(*certificate) : Tolerances{};
  for (const Variable& ran : run.dataset().variables) {
    const bool is_asked =
        only.empty() ? std::ranges::find(not_of_the_motion, ran.name) == not_of_the_motion.end() : ran.name == only;
    const Variable* const stored = is_asked && run.has_rows(ran) ? file.find(ran.name) : nullptr;
    if (stored == nullptr) continue;
    if (!comparison.are_same(ran, *stored, tolerances.of(ran.name))) return ran.name;
  }
  return std::nullopt;
}

}  // namespace clatter::app
