#include "answers/quantiles.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <span>
#include <sstream>

#include "answers/per_period.hpp"
#include "config/suggestion.hpp"
#include "steady/status.hpp"
#include "storage/input_file.hpp"
#include "storage/utf8.hpp"
#include "tables/file_points.hpp"
#include "tables/point_filter.hpp"
#include "terminal/amounts.hpp"
#include "terminal/format.hpp"

namespace clatter::app {
namespace {

using Entry = results::FileSummary::Entry;

constexpr std::size_t most_components = 16;  ///< of a result: samples of a trajectory aren't results of a point

/// Whether an entry is a result of numbers of each point, or of a few components, over one dimension of points.
bool is_result(const Entry& entry, const results::NamedLength& points, const std::vector<std::string>& axes) {
  if (entry.type != "float64" || entry.dimensions.empty() || !are_same(entry.dimensions[0], points)) return false;
  const bool is_few =
      entry.dimensions.size() == 1 || (entry.dimensions.size() == 2 && entry.dimensions[1].length <= most_components);
  return is_few && entry.name != "settling_estimate" && entry.name != "simulated_periods" &&
         std::ranges::find(axes, entry.name) == axes.end();
}

Quantiles of_values(std::string result, std::string units, std::string per, std::vector<double> values) {
  Quantiles quantiles{std::move(result), std::move(units), std::move(per), values.size()};
  std::ranges::sort(values);
  for (std::size_t i = 0; i < told_shares.size(); ++i) {
    if (values.empty()) {
      quantiles.values[i] = std::nan("");
      continue;
    }
    const double at = told_shares[i] * static_cast<double>(values.size() - 1), below = std::floor(at);
    const auto first = static_cast<std::size_t>(below);
    const double low = values[first], high = values[std::min(first + 1, values.size() - 1)];
    quantiles.values[i] = low + (at - below) * (high - low);
  }
  return quantiles;
}

/// The values of a component, without those of failed points and NaN.
std::vector<double> known_values(const std::vector<double>& values, std::size_t part, std::size_t width,
                                 const std::vector<std::uint8_t>& status) {
  std::vector<double> known;
  for (std::size_t point = 0; point < status.size(); ++point)
    if (const double value = values[point * width + part];
        !std::isnan(value) && !failed(static_cast<steady::Status>(status[point])))
      known.push_back(value);
  return known;
}

/// The largest component of each point.
std::vector<double> harder_of(const std::vector<double>& values, std::size_t width) {
  std::vector<double> harder(values.size() / width, std::nan(""));
  for (std::size_t i = 0; i < values.size(); ++i) harder[i / width] = std::fmax(harder[i / width], values[i]);
  return harder;
}

}  // namespace

std::vector<std::string> sampled_axes(const results::FileSummary& summary) {
  std::vector<std::string> names;
  for (const auto& [name, text] : summary.attributes) {
    if (name != "sampled_axes") continue;
    std::istringstream words(text);
    for (std::string word; words >> word;) names.push_back(word);
  }
  return names;
}

std::vector<Quantiles> quantiles_of(const results::FileSummary& summary, const std::string& path) {
  if (sampled_axes(summary).empty() || holds_accuracy(summary)) return {};
  const std::vector<results::NamedLength> points = dimensions_of_points(summary, path);
  if (points.size() != 1) return {};
  const std::vector<std::string> axes = coordinates_along(summary, points[0]);
  std::vector<std::string> names{"status"};
  std::vector<const Entry*> found;
  for (const Entry& entry : summary.variables)
    if (is_result(entry, points[0], axes)) {
      found.push_back(&entry), names.push_back(entry.name);
      if (entry.dimensions.size() == 2 && find_variable(summary, entry.dimensions[1].name) != nullptr)
        names.push_back(entry.dimensions[1].name);
    }
  std::ranges::sort(names);
  names.erase(std::unique(names.begin(), names.end()), names.end());
  const Compared compared(summary, path);
  const results::Dataset dataset = compared.read(names);
  const auto* const status = results::values_of<std::uint8_t>(dataset, "status");
  std::vector<Quantiles> all;
  for (const Entry* const entry : found) {
    const std::size_t width = entry->dimensions.size() == 2 ? entry->dimensions[1].length : 1;
    const auto* const values = results::values_of<double>(dataset, entry->name);
    if (status == nullptr || values == nullptr || values->size() != status->size() * width)
      storage::refuse_reading(path, "is damaged: " + config::in_quotes(entry->name) + " has another length",
                              "run its configuration again");
    if (width > 1 && has_harder_stop(entry->name))
      all.push_back(of_values(entry->name, entry->units, compared.per(entry->name),
                              known_values(harder_of(*values, width), 0, 1, *status)));
    for (std::size_t part = 0; part < width; ++part) {
      const std::string name = entry->dimensions.size() == 1
                                   ? entry->name
                                   : entry->name + '[' + component_name(dataset, entry->dimensions[1].name, part) + ']';
      all.push_back(
          of_values(name, entry->units, compared.per(entry->name), known_values(*values, part, width, *status)));
    }
  }
  return all;
}

std::string quantiles_text(const results::FileSummary& summary, const std::vector<Quantiles>& quantiles,
                           const AskedUnits& asked) {
  const std::vector<std::string> axes = sampled_axes(summary);
  if (axes.empty()) return {};
  std::string over;
  for (const std::string& axis : axes) over += (over.empty() ? "" : ", ") + storage::printable(axis);
  if (quantiles.empty()) return "\nQuantiles over " + over + ": only for a sweep without other axes\n";
  const auto aligned = [](std::string text, std::size_t width) {
    return std::string(width - std::min(width, text.size()), ' ') + text;
  };
  constexpr std::size_t number_width = 14;  // -1.23457e-17 and two blanks
  std::size_t name_width = 0;
  for (const Quantiles& of_result : quantiles) name_width = std::max(name_width, of_result.result.size());
  std::string text = "\nQuantiles over " + over + '\n' + std::string(name_width + 2, ' ');
  for (const double share : told_shares) text += aligned(formatted("%.0f %%", 100 * share), number_width);
  text += '\n';
  for (const auto& [result, units, per, points, values] : quantiles) {
    if (points == 0) continue;
    const Amounts amounts(units, values, asked);
    std::string name = "  " + storage::printable(result);
    name.resize(std::max(name.size(), name_width + 2), ' ');
    text += name;
    for (const double value : values) text += aligned(amounts.number("%.6g", value), number_width);
    const std::string unit = amounts.unit() + (amounts.unit().empty() || per.empty() ? "" : " ") + per;
    text += "  " + unit + (unit.empty() ? "" : ", ") + counted(static_cast<double>(points), "point");
    text += '\n';
  }
  return text;
}

}  // namespace clatter::app
