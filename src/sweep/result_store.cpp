#include "sweep/result_store.hpp"

#include <malloc.h>

#include <algorithm>
#include <span>
#include <stdexcept>
#include <type_traits>

#include "sweep/attractor_table.hpp"
#include "sweep/dataset_axes.hpp"

namespace clatter::sweep {
namespace {

using observables::LogColumn, observables::LoggedImpact;

template <class T>
requires std::is_trivially_copyable_v<T>
void append(std::vector<std::byte>& to, std::span<const T> values) {
  const auto bytes = std::as_bytes(values);
  to.insert(to.end(), bytes.begin(), bytes.end());
}

template <class T>
requires std::is_trivially_copyable_v<T>
bool take_off(std::span<const std::byte>& from, std::span<T> values) {
  if (from.size() < values.size_bytes()) return false;
  std::ranges::copy(from.first(values.size_bytes()), std::as_writable_bytes(values).begin());
  from = from.subspan(values.size_bytes());
  return true;
}

using TextLength = std::uint32_t;

void append_text(std::vector<std::byte>& to, const std::string& text) {
  const auto length = static_cast<TextLength>(text.size());
  append(to, std::span(&length, 1)), append(to, std::span<const char>(text));
}

bool take_off_text(std::span<const std::byte>& from, std::string& text) {
  TextLength length = 0;
  if (!take_off(from, std::span(&length, 1)) || length > from.size()) return false;
  text.resize(length);
  return take_off(from, std::span<char>(text));
}

/// The number of impacts in the whole log, so that its columns are allocated at once.
std::size_t impacts_in(const std::vector<std::vector<LoggedImpact>>& log) {
  std::size_t impacts = 0;
  for (const std::vector<LoggedImpact>& of_point : log) impacts += of_point.size();
  return impacts;
}

/// The values of a variable. Throws std::runtime_error if it is missing or of another type.
template <class T>
std::vector<T>& values_in(results::Dataset& dataset, const std::string& name) {
  const auto found = std::ranges::find(dataset.variables, name, &results::Variable::name);
  if (found == dataset.variables.end()) throw std::runtime_error("it has no '" + name + "'");
  auto* const values = std::get_if<std::vector<T>>(&found->values);
  if (values == nullptr) throw std::runtime_error("its '" + name + "' is of another type");
  return *values;
}

void require_length(const std::string& name, std::size_t length, std::size_t wanted) {
  if (length != wanted) throw std::runtime_error("its '" + name + "' is of another length");
}

std::vector<std::int64_t> point_numbers(const Share& share) {
  std::vector<std::int64_t> numbers(share.points());
  for (std::size_t chain = 0; chain < share.count(); ++chain)
    for (std::size_t i = 0; i < share.length(); ++i)
      numbers[share.local_index(chain, i)] = static_cast<std::int64_t>(share.point(chain, i));
  return numbers;
}

}  // namespace

ResultStore::ResultStore(const Sweep& sweep, const std::optional<results::Shard>& shard)
    : sweep_(sweep),
      shard_(shard),
      share_(sweep, shard),
      along_(shard ? std::vector<std::string>{"point"} : axis_names(sweep)),
      status_(share_.points(), static_cast<std::uint8_t>(steady::Status::unresolved)),
      impacts_(status_.size(), 0),
      periods_(status_.size(), 0.0),
      outputs_(outputs_of(sweep.problem)) {
  for (const OutputVariable& output : outputs_) {
    values_.emplace_back(output.text ? 0 : status_.size() * output.width(), point::no_value);
    texts_.emplace_back(output.text ? status_.size() : 0);
  }
  if (sweep.problem.observe.impact_log) log_.resize(status_.size());
}

void ResultStore::store(std::size_t local_index, point::PointResult&& result, const Units& units) {
  status_[local_index] = static_cast<std::uint8_t>(result.status);
  impacts_[local_index] = static_cast<std::int64_t>(result.impacts);
  periods_[local_index] = result.periods;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text)
      texts_[i][local_index] = outputs_[i].text(result);
    else
      outputs_[i].put(result, &values_[i][local_index * outputs_[i].width()]);
  }
  if (!log_.empty())
    log_[local_index] = std::move(result.log), log_[local_index].shrink_to_fit();  // it grew by doubling
  if (units != Units{}) to_users_units(local_index, units);
}

/// Intermediate values stay as they were computed, since the motions of the whole sweep are told apart by them.
void ResultStore::to_users_units(std::size_t local_index, const Units& units) {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text || outputs_[i].intermediate) continue;
    const double factor = factor_of(units, outputs_[i].quantity);
    for (double& value : std::span(values_[i]).subspan(local_index * outputs_[i].width(), outputs_[i].width()))
      value *= factor;
  }
  if (log_.empty()) return;
  for (const LogColumn& column : observables::log_columns_of_shaken) {
    const double factor = factor_of(units, column.quantity);
    for (LoggedImpact& impact : log_[local_index]) impact.*column.member *= factor;
  }
}

std::size_t ResultStore::most_packed_without_log() const {
  std::size_t bytes = sizeof(std::uint8_t) + sizeof(std::int64_t) + sizeof(double);
  for (const OutputVariable& output : outputs_)
    bytes += output.text ? sizeof(TextLength) + output.longest_text : output.width() * sizeof(double);
  return log_.empty() ? bytes : bytes + sizeof(std::uint64_t);
}

std::size_t ResultStore::most_packed(std::size_t local_index) const {
  return most_packed_without_log() + (log_.empty() ? 0 : log_[local_index].size() * sizeof(LoggedImpact));
}

void ResultStore::pack(std::size_t local_index, std::vector<std::byte>& to) const {
  append(to, std::span(&status_[local_index], 1)), append(to, std::span(&impacts_[local_index], 1));
  append(to, std::span(&periods_[local_index], 1));
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text)
      append_text(to, texts_[i][local_index]);
    else
      append(to, std::span(values_[i]).subspan(local_index * outputs_[i].width(), outputs_[i].width()));
  }
  if (log_.empty()) return;
  const std::uint64_t count = log_[local_index].size();
  append(to, std::span(&count, 1));
  append(to, std::span<const LoggedImpact>(log_[local_index]));
}

bool ResultStore::unpack(std::size_t local_index, std::span<const std::byte>& from) {
  bool whole = take_off(from, std::span(&status_[local_index], 1)) &&
               take_off(from, std::span(&impacts_[local_index], 1)) &&
               take_off(from, std::span(&periods_[local_index], 1));
  for (std::size_t i = 0; whole && i < outputs_.size(); ++i) {
    const std::size_t width = outputs_[i].width();
    whole = outputs_[i].text ? take_off_text(from, texts_[i][local_index])
                             : take_off(from, std::span(values_[i]).subspan(local_index * width, width));
  }
  std::uint64_t count = 0;
  if (!whole || log_.empty()) return whole;
  if (!take_off(from, std::span(&count, 1)) || count > from.size() / sizeof(LoggedImpact)) return false;
  log_[local_index].resize(static_cast<std::size_t>(count));
  return take_off(from, std::span(log_[local_index]));
}

void ResultStore::add_coordinates(results::Dataset& dataset) const {
  const auto coordinate = [&](std::string name, results::ValueArray values, std::string long_name) {
    dataset.variables.push_back({name, {name}, std::move(values), std::move(long_name), "1"});
  };
  add_axes(sweep_, dataset);
  if (shard_) {
    dataset.dimensions.push_back({"point", share_.points()});
    coordinate("point", point_numbers(share_), "index of the point in the sweep, row-major over its axes");
  }
  for (observables::Coordinate& added : observables::All::coordinates(sweep_.problem.observe)) {
    dataset.dimensions.push_back({added.name, added.length});
    const auto add = [&]<class T>(T& values) {
      if constexpr (!std::is_same_v<T, std::monostate>)
        coordinate(added.name, std::move(values), std::move(added.long_name));
    };
    std::visit(add, added.values);
  }
}

void ResultStore::take(results::Dataset& dataset, const results::Shard& shard) {
  const std::vector<std::int64_t> numbers = point_numbers(Share(sweep_, shard));
  if (values_in<std::int64_t>(dataset, "point") != numbers)
    throw std::runtime_error("its points aren't those of its shard");
  const auto scatter = [&]<class T>(const std::string& name, std::size_t width, std::vector<T>& to) {
    std::vector<T>& from = values_in<T>(dataset, name);
    require_length(name, from.size(), numbers.size() * width);
    for (std::size_t i = 0; i < numbers.size(); ++i)
      std::ranges::move(std::span(from).subspan(i * width, width), &to[static_cast<std::size_t>(numbers[i]) * width]);
    std::vector<T>().swap(from);
  };
  scatter("status", 1, status_), scatter("impact_total", 1, impacts_), scatter("simulated_periods", 1, periods_);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text)
      scatter(outputs_[i].name, 1, texts_[i]);
    else
      scatter(outputs_[i].name, outputs_[i].width(), values_[i]);
  }
  if (sweep_.problem.observe.impact_log) take_impact_log(dataset, numbers);
}

void ResultStore::take_impact_log(results::Dataset& dataset, std::span<const std::int64_t> numbers) {
  const auto& counts = values_in<std::int64_t>(dataset, "impact_count");
  const auto& stops = values_in<std::int8_t>(dataset, "impact_stop");
  require_length("impact_count", counts.size(), numbers.size());
  const auto columns = observables::log_columns(is_shaken(sweep_));
  std::vector<const std::vector<double>*> values;
  for (const LogColumn& column : columns) {
    values.push_back(&values_in<double>(dataset, std::string(column.name)));
    require_length(std::string(column.name), values.back()->size(), stops.size());
  }
  std::size_t at = 0;
  for (std::size_t i = 0; i < numbers.size(); ++i) {
    const auto end = at + static_cast<std::size_t>(counts[i]);
    if (end < at || end > stops.size()) throw std::runtime_error("its 'impact_count' doesn't fit its 'impact_stop'");
    Log& log = log_[static_cast<std::size_t>(numbers[i])];
    log.assign(end - at, {});
    for (std::size_t k = 0; k < log.size(); ++k) log[k].side = static_cast<Side>(stops[at + k]);
    for (std::size_t c = 0; c < columns.size(); ++c)
      for (std::size_t k = 0; k < log.size(); ++k) log[k].*columns[c].member = (*values[c])[at + k];
    at = end;
  }
  require_length("impact_stop", stops.size(), at);
}

void ResultStore::add_always(results::Dataset& dataset) {
  dataset.variables.push_back({"status", along_, std::move(status_), "what became of the point", "1"});
  dataset.variables.back().attributes = status_flags();
  dataset.variables.push_back({"impact_total", along_, std::move(impacts_), "impacts simulated", "1"});
  dataset.variables.push_back({"simulated_periods", along_, std::move(periods_), "forcing periods simulated", "1"});
}

void ResultStore::add_impact_log(results::Dataset& dataset) {
  const auto columns = observables::log_columns(is_shaken(sweep_));
  std::vector<std::int64_t> counts;
  std::vector<std::int8_t> stops;
  std::vector<std::vector<double>> values(columns.size());
  const std::size_t total = impacts_in(log_);
  counts.reserve(log_.size()), stops.reserve(total);
  for (std::vector<double>& of_column : values) of_column.reserve(total);
  for (Log& impacts : log_) {
    counts.push_back(static_cast<std::int64_t>(impacts.size()));
    for (const LoggedImpact& impact : impacts) {
      stops.push_back(static_cast<std::int8_t>(impact.side));
      for (std::size_t i = 0; i < columns.size(); ++i) values[i].push_back(impact.*columns[i].member);
    }
    Log().swap(impacts);
  }
  log_ = {};
  malloc_trim(0);  // otherwise blocks between others stay with the process
  dataset.dimensions.push_back({"impact", total});
  dataset.variables.push_back({"impact_count", along_, std::move(counts), "impacts in the log of the point", "1"});
  dataset.variables.back().attributes = {{"sample_dimension", "impact"}};
  name_observable("impact_log", dataset.variables.back());
  for (std::size_t i = 0; i < columns.size(); ++i) {
    const LogColumn& column = columns[i];
    if (i == 1)  // after the times
      dataset.variables.push_back(
          {"impact_stop", {"impact"}, std::move(stops), "stop that is hit, -1: lower, +1: upper", "1"});
    dataset.variables.push_back({std::string(column.name),
                                 {"impact"},
                                 std::move(values[i]),
                                 std::string(column.long_name),
                                 std::string(unit_of(column.quantity, sweep_.problem.is_si))});
    name_frame(sweep_, column.frame, dataset.variables.back());
    dataset.variables.back().missing_if = column.missing_if;
  }
}

results::Dataset ResultStore::dataset() {
  results::Dataset dataset;
  add_coordinates(dataset);
  add_always(dataset);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    OutputVariable& output = outputs_[i];
    std::vector<std::string> dimensions = along_;
    for (const observables::Coordinate& along : output.along) dimensions.push_back(along.name);
    results::ValueArray values = std::move(values_[i]);
    if (output.text) values = std::move(texts_[i]);
    if (output.intermediate && !shard_) continue;
    const bool is_si = sweep_.problem.is_si;
    const std::string& long_name = is_si && !output.name_in_si.empty() ? output.name_in_si : output.long_name;
    const Quantity quantity = output.intermediate ? Quantity::number : output.quantity;
    dataset.variables.push_back({output.name, std::move(dimensions), std::move(values), long_name,
                                 unit_of_derivative(quantity, output.per, is_si)});
    const bool is_on_ground = output.intermediate && sweep_.problem.observe.loose_attractor;  // as it is computed
    const bool is_framed = output.frame != observables::FrameOf::any;
    name_frame(sweep_, is_on_ground && is_framed ? observables::FrameOf::absolute : output.frame,
               dataset.variables.back());
    if (!output.observable.empty()) name_observable(output.observable, dataset.variables.back());
    std::string& missing_if = dataset.variables.back().missing_if;
    missing_if = output.missing_if.empty() ? "the point failed" : "the point failed, or ";
    missing_if += output.missing_if;
  }
  if (numbering_) add_attractors(sweep_, shard_.has_value(), along_, std::move(*numbering_), dataset);
  if (sweep_.problem.observe.impact_log) add_impact_log(dataset);
  add_drawn_names(sweep_.problem.is_si, dataset, has_loose_mass(sweep_));
  name_linked_axes(sweep_, dataset);
  name_samples(sweep_, dataset);
  return dataset;
}

std::vector<double>& ResultStore::values_of(std::string_view output) {
  const auto found = std::ranges::find(outputs_, output, &OutputVariable::name);
  return values_[static_cast<std::size_t>(found - outputs_.begin())];
}

void ResultStore::number_motions(int threads) {
  if (!sweep_.problem.observe.attractor) return;
  const std::vector<double>&x = values_of("attractor_x"), &v = values_of("attractor_v"),
        &periods = values_of("attractor_periods");
  const std::vector<std::int64_t> numbers = shard_ ? point_numbers(share_) : std::vector<std::int64_t>{};
  const auto index = [&](std::size_t point) -> std::optional<std::size_t> {
    if (!shard_) return point;
    const auto found = std::ranges::lower_bound(numbers, static_cast<std::int64_t>(point));
    if (found == numbers.end() || *found != static_cast<std::int64_t>(point)) return std::nullopt;
    return static_cast<std::size_t>(found - numbers.begin());
  };
  const bool loose = sweep_.problem.observe.loose_attractor;
  const std::vector<double>*const z = loose ? &values_of("attractor_z") : nullptr, *const w =
                                                                                       loose ? &values_of("attractor_w")
                                                                                             : nullptr;
  const auto ending = [&](std::size_t i) {
    return attractors::Ending{{x[i], v[i], loose ? (*z)[i] : 0.0, loose ? (*w)[i] : 0.0}, periods[i]};
  };
  numbering_ = numbering_of(sweep_, threads, {status_.size(), index, ending});
}

results::Dataset ResultStore::description() {
  if (sweep_.problem.observe.attractor)
    numbering_ = {.number = std::vector<std::int32_t>(status_.size(), attractors::undecided), .motions = {{}}};
  return dataset();
}

std::size_t ResultStore::failed_points() const {
  return static_cast<std::size_t>(std::count_if(
      status_.begin(), status_.end(), [](std::uint8_t status) { return failed(static_cast<steady::Status>(status)); }));
}

}  // namespace clatter::sweep
