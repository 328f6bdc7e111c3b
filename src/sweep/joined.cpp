#include "sweep/joined.hpp"

#include <algorithm>
#include <cstdint>
#include <memory>
#include <span>
#include <string_view>
#include <utility>

#include "observables/contacts/impact_log.hpp"
#include "sweep/attractor_table.hpp"
#include "sweep/output_variables.hpp"
#include "sweep/result_dataset.hpp"
#include "sweep/share.hpp"

namespace clatter::sweep {
namespace {

constexpr std::size_t bytes_of_text = 64;  ///< of most texts

struct Parts {
  Parts(const Sweep& sweep, const std::vector<Part>& of) : all(of), points(size(sweep)) {
    for (const Part& part : all) shares.emplace_back(sweep, part.shard);
  }

  const std::vector<Part>& all;
  std::vector<Share> shares;  ///< [part]
  std::size_t points;         ///< of the sweep
};

void require_rows(const Parts& parts, std::size_t part, const std::string& name, std::size_t wanted) {
  const std::optional<std::size_t> rows = parts.all[part].rows(name);
  if (!rows) throw PartError(part, "it has no '" + name + "'");
  if (*rows != wanted) throw PartError(part, "its '" + name + "' is of another length");
}

/// The values of some rows of a part, `width` each.
template <class T>
std::vector<T> rows_of(const Parts& parts, std::size_t part, const std::string& name, std::size_t first,
                       std::size_t rows, std::size_t width = 1) {
  results::ValueArray values = parts.all[part].values(name, first, rows);
  auto* const typed = std::get_if<std::vector<T>>(&values);
  if (typed == nullptr) throw PartError(part, "its '" + name + "' is of another type");
  if (typed->size() != rows * width) throw PartError(part, "its '" + name + "' is of another length");
  return std::move(*typed);
}

/// Values that are made in blocks and passed on in pieces of any length.
template <class T>
class Blocks {
 public:
  virtual ~Blocks() = default;

  std::vector<T> next(std::size_t count) {
    if (at_ == block_.size()) refill();
    if (at_ == 0 && block_.size() == count) return std::exchange(block_, {});
    std::vector<T> values;
    values.reserve(count);
    while (values.size() < count) {
      if (at_ == block_.size()) refill();
      if (block_.empty()) break;
      const std::size_t some = std::min(count - values.size(), block_.size() - at_);
      const auto from = block_.begin() + static_cast<std::ptrdiff_t>(at_);
      std::move(from, from + static_cast<std::ptrdiff_t>(some), std::back_inserter(values));
      at_ += some;
    }
    return values;
  }

 private:
  /// Fills an empty block with the values that come next; leaves it empty after the last one.
  virtual void fill(std::vector<T>& block) = 0;
  void refill() { block_.clear(), at_ = 0, fill(block_); }

  std::vector<T> block_;
  std::size_t at_ = 0;
};

/// The rows of a variable over all points, gathered from the parts.
template <class T>
class Rows : public Blocks<T> {
 public:
  Rows(std::shared_ptr<const Parts> parts, std::string name, std::size_t width)
      : parts_(std::move(parts)), name_(std::move(name)), width_(width) {
    for (std::size_t part = 0; part < parts_->all.size(); ++part)
      require_rows(*parts_, part, name_, parts_->shares[part].points());
  }

 private:
  void fill(std::vector<T>& block) override {
    constexpr std::size_t bytes = std::is_same_v<T, std::string> ? bytes_of_text : sizeof(T);
    const std::size_t rows = std::max<std::size_t>(1, joined_at_once / (bytes * width_));
    const std::size_t begin = begin_, end = std::min(parts_->points, begin + rows);
    std::vector<std::vector<T>> read;  // [part]
    for (std::size_t part = 0; part < parts_->all.size(); ++part) {
      const std::size_t first = parts_->shares[part].points_before(begin),
                        last = parts_->shares[part].points_before(end);
      read.push_back(first == last ? std::vector<T>() : rows_of<T>(*parts_, part, name_, first, last - first, width_));
    }
    block.resize((end - begin) * width_);
    constexpr std::size_t cached = 1UL << 18U;  // bytes that are put together at a time, since the parts alternate
    const std::size_t some = std::max<std::size_t>(1, cached / (bytes * width_));
    for (std::size_t from = begin; from < end; from += some)
      for (std::size_t part = 0; part < read.size(); ++part)
        put(part, begin, from, std::min(end, from + some), read[part], block);
    begin_ = end;
  }

  /// Puts a part's rows of the points from `from` up to `to` into a block that begins at the point `begin`.
  void put(std::size_t part, std::size_t begin, std::size_t from, std::size_t to, std::vector<T>& read,
           std::vector<T>& block) const {
    const Share& share = parts_->shares[part];
    const std::size_t before = share.points_before(begin), last = share.points_before(to);
    for (std::size_t i = share.points_before(from); i < last; ++i) {
      const std::size_t row = share.point_at(i) - begin;
      if (width_ == 1)
        block[row] = std::move(read[i - before]);
      else
        std::move(&read[(i - before) * width_], &read[(i - before) * width_] + width_, &block[row * width_]);
    }
  }

  std::shared_ptr<const Parts> parts_;
  std::string name_;
  std::size_t width_, begin_ = 0;
};

/// A column of the impact log, point after point, gathered from the parts.
template <class T>
class Log : public Blocks<T> {
 public:
  Log(std::shared_ptr<const Parts> parts, std::string name)
      : parts_(std::move(parts)),
        name_(std::move(name)),
        counts_(parts_, "impact_count", 1),
        read_(parts_->all.size(), 0) {
    for (std::size_t part = 0; part < parts_->all.size(); ++part)
      require_rows(*parts_, part, name_, parts_->all[part].rows("impact_tau").value_or(0));
  }

 private:
  void fill(std::vector<T>& block) override {
    while (block.empty() && begin_ < parts_->points) fill_points(block);
    if (block.empty()) require_all_read();
  }

  /// The impacts of the points that come next, some thousand, or fewer that have many impacts.
  void fill_points(std::vector<T>& block) {
    const std::vector<std::size_t> places = places_of_points();
    block.resize(places.back());
    const std::size_t begin = begin_, end = begin + places.size() - 1;
    for (std::size_t part = 0; part < parts_->all.size(); ++part) {
      const Share& share = parts_->shares[part];
      const std::size_t first = share.points_before(begin), last = share.points_before(end);
      std::size_t impacts = 0;
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t point = share.point_at(i) - begin;
        impacts += places[point + 1] - places[point];
      }
      if (impacts > parts_->all[part].rows(name_).value_or(0) - read_[part]) refuse(part);
      if (impacts == 0) continue;
      const std::vector<T> values = rows_of<T>(*parts_, part, name_, read_[part], impacts);
      auto from = values.begin();
      for (std::size_t i = first; i < last; ++i) {
        const std::size_t point = share.point_at(i) - begin;
        const auto to = from + static_cast<std::ptrdiff_t>(places[point + 1] - places[point]);
        std::copy(from, to, block.begin() + static_cast<std::ptrdiff_t>(places[point]));
        from = to;
      }
      read_[part] += impacts;
    }
    begin_ = end;
  }

  /// Where the impacts of the next points begin in their block, and behind the last one its length.
  [[nodiscard]] std::vector<std::size_t> places_of_points() {
    constexpr std::size_t most_points = 1UL << 16U;
    std::vector<std::size_t> places{0};
    while (places.size() <= std::min(most_points, parts_->points - begin_) &&
           places.back() * sizeof(T) < joined_at_once) {
      if (next_count_ == known_.size())
        known_ = counts_.next(std::min(most_points, parts_->points - begin_ - (places.size() - 1))), next_count_ = 0;
      const std::int64_t count = known_[next_count_++];
      if (count < 0 || static_cast<std::uint64_t>(count) > most_impacts_) refuse(owner_of(begin_ + places.size() - 1));
      places.push_back(places.back() + static_cast<std::size_t>(count));
    }
    return places;
  }

  [[nodiscard]] std::size_t owner_of(std::size_t point) const {
    std::size_t part = 0;
    while (part + 1 < parts_->all.size() &&
           parts_->shares[part].points_before(point) == parts_->shares[part].points_before(point + 1))
      ++part;
    return part;
  }

  void require_all_read() const {
    for (std::size_t part = 0; part < parts_->all.size(); ++part)
      if (parts_->all[part].rows(name_) != read_[part]) refuse(part);
  }

  [[noreturn]] static void refuse(std::size_t part) {
    throw PartError(part, "its 'impact_count' doesn't fit its 'impact_stop'");
  }

  static constexpr std::uint64_t most_impacts_ = 1ULL << 40U;  ///< of a point, which no file holds

  std::shared_ptr<const Parts> parts_;
  std::string name_;
  Rows<std::int64_t> counts_;
  std::vector<std::int64_t> known_;  ///< counts of some points
  std::size_t next_count_ = 0;       ///< of these
  std::size_t begin_ = 0;
  std::vector<std::size_t> read_;  ///< [part]: impacts
};

template <class T, template <class> class Kind, class... Arguments>
results::NextValues next_of(Arguments&&... arguments) {
  return [blocks = std::make_shared<Kind<T>>(std::forward<Arguments>(arguments)...)](std::size_t count) {
    return blocks->next(count);
  };
}

results::NextValues values_of(const Sweep& sweep, const std::shared_ptr<const Parts>& parts,
                              const std::string& variable) {
  if (variable == "status") return next_of<std::uint8_t, Rows>(parts, variable, 1UL);
  if (variable == "impact_total" || variable == "impact_count")
    return next_of<std::int64_t, Rows>(parts, variable, 1UL);
  if (variable == "impact_stop") return next_of<std::int8_t, Log>(parts, variable);
  for (const observables::LogColumn& column : observables::log_columns_of_shaken)
    if (column.name == variable) return next_of<double, Log>(parts, variable);
  for (const OutputVariable& output : outputs_of(sweep.problem)) {
    if (output.name != variable) continue;
    if (output.text) return next_of<std::string, Rows>(parts, variable, 1UL);
    return next_of<double, Rows>(parts, variable, output.width());
  }
  return next_of<double, Rows>(parts, variable, 1UL);
}

/// Throws unless the numbers of a part's points are those of its shard.
void check_points(const Parts& parts) {
  constexpr std::size_t block = joined_at_once / sizeof(std::int64_t);
  for (std::size_t part = 0; part < parts.all.size(); ++part) {
    const Share& share = parts.shares[part];
    const std::optional<std::size_t> rows = parts.all[part].rows("point");
    if (!rows) throw PartError(part, "it has no 'point'");
    bool is_right = *rows == share.points();
    for (std::size_t first = 0; is_right && first < share.points(); first += block) {
      const auto numbers = rows_of<std::int64_t>(parts, part, "point", first, std::min(block, share.points() - first));
      for (std::size_t i = 0; i < numbers.size(); ++i)
        is_right = is_right && numbers[i] == static_cast<std::int64_t>(share.point_at(first + i));
    }
    if (!is_right) throw PartError(part, "its points aren't those of its shard");
  }
}

StatusTally tally_of(const std::shared_ptr<const Parts>& parts) {
  StatusTally tally;
  Rows<std::uint8_t> statuses(parts, "status", 1);
  for (std::size_t left = parts->points, some = 0; left > 0; left -= some) {
    some = std::min(left, joined_at_once);
    tally.add(statuses.next(some));
  }
  return tally;
}

std::optional<attractors::Numbering> numbering_of(const Sweep& sweep, const std::shared_ptr<const Parts>& parts,
                                                  int threads) {
  std::vector<std::unique_ptr<std::vector<double>>> held;
  return numbering_by(sweep, {}, threads, [&](std::string_view output) -> std::span<const double> {
    Rows<double> rows(parts, std::string(output), 1);
    return *held.emplace_back(std::make_unique<std::vector<double>>(rows.next(parts->points)));
  });
}

}  // namespace

Joined joined(const Sweep& sweep, const std::vector<Part>& parts, int threads) {
  const auto all = std::make_shared<const Parts>(sweep, parts);
  check_points(*all);
  const StatusTally statuses = tally_of(all);
  std::size_t logged = 0;
  for (const Part& part : parts) logged += part.rows("impact_tau").value_or(0);
  const auto values = [&sweep, all](std::string_view variable) { return values_of(sweep, all, std::string(variable)); };
  return {result_dataset(sweep, {}, {values, logged, joined_at_once}, numbering_of(sweep, all, threads)), statuses};
}

}  // namespace clatter::sweep
