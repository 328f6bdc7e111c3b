#include "sweep/result_store.hpp"

#include <algorithm>
#include <cstring>
#include <type_traits>
#include <utility>

#include "sweep/attractor_table.hpp"
#include "sweep/result_dataset.hpp"

namespace clatter::sweep {
namespace {

using observables::LogColumn, observables::LoggedImpact;

/// Puts a value, or several, at a place, and returns the place behind them.
template <class T>
requires std::is_trivially_copyable_v<T> std::byte* put(std::byte* place, const T& value) {
  std::memcpy(place, &value, sizeof value);
  return place + sizeof value;
}
template <class T>
std::byte* put_all(std::byte* place, std::span<const T> values) {
  for (const T& value : values) place = put(place, value);
  return place;
}

template <class T>
requires std::is_trivially_copyable_v<T>
bool take_off(std::span<const std::byte>& from, std::span<T> values) {
  if (from.size() < values.size_bytes()) return false;
  if (!values.empty()) std::memcpy(values.data(), from.data(), values.size_bytes());
  from = from.subspan(values.size_bytes());
  return true;
}

using TextLength = std::uint32_t;

/// Whether the motions of the whole sweep are told apart by an output: numbering them needs it in memory.
bool is_numbered_by(const Sweep& sweep, const OutputVariable& output) {
  return sweep.problem.observe.attractor && output.intermediate;
}

std::size_t size_of(const OutputVariable& output) {
  return output.text ? sizeof(void*) : output.width() * sizeof(double);
}

/// Bytes of a point whose place may be in files.
std::size_t bytes_in_scratch(const Sweep& sweep, std::span<const OutputVariable> outputs) {
  std::size_t bytes = sizeof(std::uint8_t) + sizeof(std::int64_t) + sizeof(double);
  for (const OutputVariable& output : outputs)
    if (!is_numbered_by(sweep, output)) bytes += size_of(output);
  return sweep.problem.observe.impact_log ? bytes + sizeof(void*) : bytes;
}

/// Bytes of a point in the journal at most, without its log.
std::size_t most_packed_of(std::span<const OutputVariable> outputs) {
  std::size_t bytes = sizeof(std::uint8_t) + sizeof(std::int64_t) + sizeof(double);
  for (const OutputVariable& output : outputs)
    bytes += output.text ? sizeof(TextLength) + output.longest_text : output.width() * sizeof(double);
  return bytes;
}

/// The values of a column, one part after the other, which each are `made` of values there.
template <class T, class There, class Make>
results::NextValues next_of(std::shared_ptr<const storage::Region> column, std::shared_ptr<storage::Scratch> scratch,
                            Make made) {
  return
      [column = std::move(column), scratch = std::move(scratch), made, at = std::size_t{0}](std::size_t count) mutable {
        std::vector<T> values(count);
        std::ranges::transform(column->as<There>().subspan(at, count), values.begin(), made);
        at += count;
        scratch->touched(count);
        return values;
      };
}

}  // namespace

ResultStore::ResultStore(const Sweep& sweep, const std::optional<results::Shard>& shard,
                         std::shared_ptr<storage::Scratch> scratch)
    : sweep_(sweep),
      shard_(shard),
      share_(sweep, shard),
      scratch_(std::move(scratch)),
      arena_(std::make_shared<storage::Arena>(*scratch_)),
      outputs_(outputs_of(sweep.problem)) {
  const std::size_t points = share_.points();
  scratch_->expect(static_cast<double>(points) * static_cast<double>(bytes_in_scratch(sweep, outputs_)));
  status_ = scratch_->region(points * sizeof(std::uint8_t));
  impacts_ = scratch_->region(points * sizeof(std::int64_t)), periods_ = scratch_->region(points * sizeof(double));
  for (const OutputVariable& output : outputs_) {
    const std::size_t bytes = points * size_of(output);
    columns_.push_back(is_numbered_by(sweep, output) ? storage::Scratch::region_in_memory(bytes)
                                                     : scratch_->region(bytes));
    rows_.push_back({columns_.back()->as<double>().data(), output.text ? 0 : output.width()});
  }
  if (sweep.problem.observe.impact_log) log_ = scratch_->region(points * sizeof(Kept));
  most_packed_without_log_ = most_packed_of(outputs_) + (log_ ? sizeof(std::uint64_t) : 0);
  pages_of_point_ = 4 + 2 * outputs_.size() + bytes_in_scratch(sweep, outputs_) / 4096;
}

template <class Part>
ResultStore::Kept ResultStore::keep(std::span<const Part> parts) {
  if (parts.empty()) return nullptr;
  static_assert(alignof(Part) <= alignof(std::uint64_t));
  std::byte* const room = arena_->room_for(sizeof(std::uint64_t) + parts.size_bytes());
  const std::uint64_t count = parts.size();
  std::memcpy(room, &count, sizeof count), std::memcpy(room + sizeof count, parts.data(), parts.size_bytes());
  scratch_->touched(parts.size_bytes() / 4096);
  return reinterpret_cast<Kept>(room);
}

void ResultStore::store(std::size_t local_index, point::PointResult&& result, const Units& units) {
  status_->as<std::uint8_t>()[local_index] = static_cast<std::uint8_t>(result.status);
  impacts_->as<std::int64_t>()[local_index] = static_cast<std::int64_t>(result.impacts);
  periods_->as<double>()[local_index] = result.periods;
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text)
      texts(i)[local_index] = keep(std::span<const char>(outputs_[i].text(result)));
    else
      outputs_[i].put(result, values(i, local_index).data());
  }
  if (units != Units{}) to_users_units(local_index, units);
  if (log_) {
    for (const LogColumn& column : observables::log_columns_of_shaken) {
      if (units == Units{}) break;
      const double factor = factor_of(units, column.quantity);
      for (LoggedImpact& impact : result.log) impact.*column.member *= factor;
    }
    logs()[local_index] = keep(std::span<const LoggedImpact>(result.log));
  }
  scratch_->touched(pages_of_point_);
}

/// Intermediate values stay as they were computed, since the motions of the whole sweep are told apart by them.
void ResultStore::to_users_units(std::size_t local_index, const Units& units) {
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text || outputs_[i].intermediate) continue;
    const double factor = factor_of(units, outputs_[i].quantity);
    for (double& value : values(i, local_index)) value *= factor;
  }
}

std::size_t ResultStore::most_packed(std::size_t local_index) const {
  return most_packed_without_log_ + (log_ ? parts_of<LoggedImpact>(logs()[local_index]).size_bytes() : 0);
}

void ResultStore::pack(std::size_t local_index, std::vector<std::byte>& to) const {
  const std::size_t before = to.size();
  to.resize(before + most_packed(local_index));
  std::byte* place = to.data() + before;
  place = put(place, status_->as<std::uint8_t>()[local_index]);
  place = put(place, impacts_->as<std::int64_t>()[local_index]);
  place = put(place, periods_->as<double>()[local_index]);
  for (std::size_t i = 0; i < outputs_.size(); ++i) {
    if (outputs_[i].text) {
      const auto text = parts_of<char>(texts(i)[local_index]);
      place = put_all(put(place, static_cast<TextLength>(text.size())), text);
    } else {
      place = put_all<double>(place, values(i, local_index));
    }
  }
  if (log_) {
    const auto log = parts_of<LoggedImpact>(logs()[local_index]);
    place = put_all(put(place, std::uint64_t{log.size()}), log);
  }
  to.resize(static_cast<std::size_t>(place - to.data()));
  scratch_->touched(pages_of_point_);
}

bool ResultStore::unpack(std::size_t local_index, std::span<const std::byte>& from) {
  bool whole = take_off(from, status_->as<std::uint8_t>().subspan(local_index, 1)) &&
               take_off(from, impacts_->as<std::int64_t>().subspan(local_index, 1)) &&
               take_off(from, periods_->as<double>().subspan(local_index, 1));
  const auto take_parts = [&]<class Part, class Count>(Kept& kept, Part, Count count) {
    if (!take_off(from, std::span(&count, 1)) || count > from.size() / sizeof(Part)) return false;
    std::vector<Part> parts(static_cast<std::size_t>(count));
    const bool is_whole = take_off(from, std::span(parts));
    kept = keep(std::span<const Part>(parts));
    return is_whole;
  };
  for (std::size_t i = 0; whole && i < outputs_.size(); ++i)
    whole = outputs_[i].text ? take_parts(texts(i)[local_index], char{}, TextLength{})
                             : take_off(from, values(i, local_index));
  scratch_->touched(pages_of_point_);
  return whole && (!log_ || take_parts(logs()[local_index], LoggedImpact{}, std::uint64_t{}));
}

std::size_t ResultStore::logged() const {
  std::size_t impacts = 0;
  if (!log_) return impacts;
  for (const Kept log : logs()) impacts += parts_of<LoggedImpact>(log).size();
  return impacts;
}

namespace {

/// The values of the impact log, point after point: `value_of` an impact.
template <class T, class Log, class ValueOf>
results::NextValues next_of_log(std::size_t points, std::shared_ptr<storage::Scratch> scratch, Log log_of,
                                ValueOf value_of) {
  return [=, point = std::size_t{0}, at = std::size_t{0}](std::size_t count) mutable {
    std::vector<T> values;
    values.reserve(count);
    while (values.size() < count && point < points) {
      const std::span<const LoggedImpact> log = log_of(point);
      const auto some = log.subspan(at, std::min(log.size() - at, count - values.size()));
      for (const LoggedImpact& impact : some) values.push_back(value_of(impact));
      at += some.size();
      if (at == log.size()) ++point, at = 0;
      scratch->touched(1 + some.size_bytes() / 4096);
    }
    return values;
  };
}

}  // namespace

results::NextValues ResultStore::values_of(std::string_view variable) {
  const auto as_it_is = [](const auto& value) { return value; };
  if (variable == "status") return next_of<std::uint8_t, std::uint8_t>(status_, scratch_, as_it_is);
  if (variable == "impact_total") return next_of<std::int64_t, std::int64_t>(impacts_, scratch_, as_it_is);
  if (variable == "simulated_periods") return next_of<double, double>(periods_, scratch_, as_it_is);
  const auto log_of = [log = log_, arena = arena_](std::size_t point) {
    return parts_of<LoggedImpact>(log->as<Kept>()[point]);
  };
  if (variable == "impact_count")
    return next_of<std::int64_t, Kept>(log_, scratch_, [arena = arena_](Kept log) {
      return static_cast<std::int64_t>(parts_of<LoggedImpact>(log).size());
    });
  if (variable == "impact_stop")
    return next_of_log<std::int8_t>(share_.points(), scratch_, log_of,
                                    [](const LoggedImpact& impact) { return impact.stop; });
  for (const LogColumn& column : observables::log_columns_of_shaken)
    if (column.name == variable)
      return next_of_log<double>(share_.points(), scratch_, log_of,
                                 [member = column.member](const LoggedImpact& impact) { return impact.*member; });
  const auto i =
      static_cast<std::size_t>(std::ranges::find(outputs_, variable, &OutputVariable::name) - outputs_.begin());
  std::shared_ptr<const storage::Region> column = std::move(columns_[i]);  // its place is free once it is written
  if (!outputs_[i].text) return next_of<double, double>(std::move(column), scratch_, as_it_is);
  return next_of<std::string, Kept>(std::move(column), scratch_, [arena = arena_](Kept text) {
    const auto letters = parts_of<char>(text);
    return std::string(letters.begin(), letters.end());
  });
}

results::Dataset ResultStore::dataset() {
  return result_dataset(sweep_, shard_, {[this](std::string_view name) { return values_of(name); }, logged()},
                        std::move(numbering_));
}

std::span<const double> ResultStore::numbers_of(std::string_view output) const {
  const auto found = std::ranges::find(outputs_, output, &OutputVariable::name);
  return columns_[static_cast<std::size_t>(found - outputs_.begin())]->as<double>();
}

void ResultStore::number_motions(int threads) {
  numbering_ = numbering_by(sweep_, shard_, threads, [this](std::string_view output) { return numbers_of(output); });
}

StatusTally ResultStore::statuses() const {
  StatusTally tally;
  tally.add(status_->as<std::uint8_t>());
  return tally;
}

}  // namespace clatter::sweep
