#include "scene/force_table.hpp"

#include <algorithm>
#include <cmath>
#include <deque>
#include <limits>
#include <mutex>
#include <numbers>
#include <utility>

namespace clatter {
inline namespace scene {
namespace {

/// Whether half a period after each knot there is one at which the force is the opposite.
bool is_odd(const std::vector<ForceTable::Knot>& knots) {
  constexpr double rounding = 4 * std::numeric_limits<double>::epsilon();
  const std::size_t half = knots.size() / 2;
  if (knots.size() % 2 != 0) return false;
  for (std::size_t i = 0; i < half; ++i) {
    const ForceTable::Knot &one = knots[i], &other = knots[i + half];
    if (std::abs(other.turns - one.turns - 0.5) > rounding) return false;
    if (other.before != -one.before || other.after != -one.after) return false;
  }
  return true;
}

}  // namespace

ForceTable::ForceTable(std::vector<Knot> knots) : knots_(std::move(knots)), is_odd_(is_odd(knots_)) {
  for (const Knot& knot : knots_) peak_ = std::max({peak_, std::abs(knot.before), std::abs(knot.after)});
  least_ = 1, most_ = -1;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const bool is_last = i + 1 == knots_.size();
    const double end = knots_[is_last ? 0 : i + 1].before / peak_, begin = knots_[i].after / peak_,
                 length = (is_last ? 1.0 : knots_[i + 1].turns) - knots_[i].turns;
    least_ = std::min({least_, begin, end}), most_ = std::max({most_, begin, end});
    mean_ += length * (begin + end) / 2;
    steepest_ = std::max(steepest_, std::abs(end - begin) / (2 * std::numbers::pi * length));
  }
}

ForceTable::Harmonics ForceTable::harmonics(std::size_t count) const {
  Harmonics found{peak_ * mean_, {}, 0.0};
  double square = 0, told = found.mean * found.mean;
  for (std::size_t i = 0; i < knots_.size(); ++i) {
    const bool is_last = i + 1 == knots_.size();
    const double from = knots_[i].turns, to = is_last ? 1.0 : knots_[i + 1].turns, begin = knots_[i].after,
                 end = knots_[is_last ? 0 : i + 1].before;
    square += (to - from) * (begin * begin + begin * end + end * end) / 3;
    for (std::size_t j = 1; j <= count; ++j) {  // 2 int F e^{iwt}, by parts
      const double w = 2 * std::numbers::pi * static_cast<double>(j), slope = (end - begin) / (to - from);
      const auto first = sine_cosine_of_turns(static_cast<double>(j) * from),
                 last = sine_cosine_of_turns(static_cast<double>(j) * to);
      auto& [a, b] = found.orders.of[j - 1];
      a += 2 * ((begin * first.cosine - end * last.cosine) / w + slope * (last.sine - first.sine) / (w * w));
      b += 2 * ((end * last.sine - begin * first.sine) / w + slope * (last.cosine - first.cosine) / (w * w));
    }
  }
  for (std::size_t j = 1; j <= count; ++j) told += std::pow(found.orders.size(j), 2) / 2;
  found.left_out = std::max(0.0, 1 - told / square);
  return found;
}

const ForceTable* kept(ForceTable table) {
  static std::mutex mutex;
  static std::deque<ForceTable> all;  // which never move
  const std::lock_guard lock(mutex);
  const auto same = std::ranges::find(all, table);
  return same != all.end() ? &*same : &all.emplace_back(std::move(table));
}

}  // namespace scene
}  // namespace clatter
