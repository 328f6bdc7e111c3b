#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <utility>

#include "scene/oscillator.hpp"

namespace clatter::steady {

/// The least proper divisor of n for which a predicate holds, else n.
template <class Predicate>
[[nodiscard]] std::size_t least_divisor(std::size_t n, Predicate&& holds) {
  for (std::size_t m = 1; m < n; ++m)
    if (n % m == 0 && holds(m)) return m;
  return n;
}

/// Orders the states of a periodic motion; its observed period begins with the first of them. Under a force f < 0 that
/// has the lesser x, then the lesser v; under f > 0 the greater, so that a mirrored scene begins with the mirrored
/// state.
class BeginsBefore {
 public:
  explicit BeginsBefore(double forcing) : sign_(forcing > 0 ? -1 : 1) {}

  [[nodiscard]] bool operator()(double x, double v, double other_x, double other_v) const {
    return sign_ * x < sign_ * other_x || (x == other_x && sign_ * v < sign_ * other_v);
  }

 private:
  double sign_;
};

/// Finds the number of forcing periods after which a motion repeats, from its states at the sections (the stroboscopic
/// sections of `motion::State`): a displacement and one other number, its velocity, or with a loose mass three, the
/// velocity, and the place of the loose mass in its housing with z'. Each pair is compared by the size of its motion:
/// the larger of its numbers and, if they are given, of those at the events of a period, since a mass may stand near 0
/// at each section. A repeat counts once the whole rest of the transient is below the tolerance, not just the part that
/// n periods remove, which is small if motion contracts slowly. It must also hold for another n periods: motion that
/// forgets its past on a stop, and is chaotic after it, returns to a state to rounding and then diverges.
template <std::size_t others>
class BasicRepeatFinder {
 public:
  using Others = std::array<double, others>;           ///< of a state, without its displacement
  using Sizes = std::array<double, (others + 1) / 2>;  ///< of the motion of each pair

  static constexpr std::size_t longest = 64;         ///< forcing periods of the longest motion looked for
  static constexpr double divisor_tolerances = 100;  ///< a divisor counts as the period within so many

  /// Looks for a repeat at every `looks_every`-th section: rarely, if a period costs less than a look.
  explicit BasicRepeatFinder(double tolerance, std::size_t looks_every = 1)
      : tolerance_(tolerance), looks_every_(looks_every) {}

  /// Takes the next section's state, and the logarithm of the factor by which the period before it changed a small area
  /// (with more numbers, volume) of states; returns the n after which the motion repeats, 0 while it doesn't.
  [[nodiscard]] std::size_t add(double x, double v, double log_area, double size = 0) requires(others == 1) {
    return add(x, Others{v}, log_area, Sizes{size});
  }
  [[nodiscard]] std::size_t add(double x, const Others& other, double log_area, const Sizes& sizes = {}) {
    const std::size_t now = keep(x, other, log_area, sizes);
    if (candidate_ > 0 && !repeats(now, candidate_, divisor_tolerances * tolerance_)) candidate_ = 0;
    if (candidate_ > 0 && --left_ == 0) return shortest(now, std::exchange(candidate_, 0));
    if (candidate_ > 0 || ++waited_ < looks_every_) return 0;
    waited_ = 0;
    const std::size_t least = next_within(tolerance_, 1);
    for (std::size_t n = least; n > 0; n = next_within(tolerance_, n + 1)) {
      waited_ = looks_every_;  // a hit that doesn't stand now may stand at the next section
      if (!(stands(now, n) && settled(now, n)) && !(n == least && stalls(now, n))) continue;
      candidate_ = left_ = n;
      break;
    }
    return 0;
  }

  /// Whether `add` looks for a repeat at the next section, or has one to confirm.
  [[nodiscard]] bool looks_next() const { return candidate_ > 0 || waited_ + 1 >= looks_every_; }
  /// Takes the next section's state, at which it doesn't.
  void pass(double x, double v, double log_area) requires(others == 1) {
    ++waited_;
    keep(x, Others{v}, log_area, {});
  }

  /// Takes a later section's state, sections having been left out before it; returns whether it is that of one of the
  /// last `longest` states taken.
  [[nodiscard]] bool sample(double x, double v) requires(others == 1) {
    keep(x, Others{v}, 0, {});
    return next_within(tolerance_, 1) > 0;
  }

  /// Whether a repeat is being confirmed.
  [[nodiscard]] bool confirms() const { return candidate_ > 0; }

  /// Begins anew.
  void restart() { candidate_ = stalled_n_ = size_ = 0, waited_ = looks_every_; }

  /// The least period, from `n` on, over which the newest state and the earlier one are within `distance` of each
  /// other; 0 for none.
  [[nodiscard]] std::size_t next_within(double distance, std::size_t n) const {
    const std::size_t now = size_ - 1, last = std::min(longest, now);
    if (n == 1 && !comes_near(now, last, distance)) return 0;  // a first one is rare
    while (n <= last && !repeats(now, n, distance)) ++n;
    return n <= last ? n : 0;
  }

  /// Relative distance, `ago` sections ago, of the newest state then and the one m sections before it; infinite if
  /// there is no such state (any more).
  [[nodiscard]] double distance_over(std::size_t m, std::size_t ago = 0) const {
    return m + ago < size_ ? distance(size_ - 1 - ago, m) : std::numeric_limits<double>::infinity();
  }

  /// Displacement and velocity so many sections ago, at most 2 longest.
  [[nodiscard]] double x(std::size_t ago) const { return x_[size_ - 1 - ago]; }
  [[nodiscard]] double v(std::size_t ago) const { return v_at(size_ - 1 - ago); }

  /// Index among the last n states, 0 for the newest, of the one at which the observed period begins.
  [[nodiscard]] std::size_t first_of_last(std::size_t n, const BeginsBefore& before) const {
    const std::size_t now = size_ - 1;
    std::size_t best = 0;
    for (std::size_t i = 1; i < n; ++i)
      if (before(x_[now - i], v_at(now - i), x_[now - best], v_at(now - best))) best = i;
    return best;
  }

 private:
  static constexpr std::size_t capacity = 256;
  static constexpr double ulps = 8 * std::numeric_limits<double>::epsilon();
  static constexpr double rounding = 2048 * std::numeric_limits<double>::epsilon();  ///< of a period with its impacts
  static constexpr double most_left = 1e-8;            ///< of a transient that rounding has stopped
  static constexpr std::ptrdiff_t kept = 2 * longest;  // two rounds of the longest motion

  /// Keeps a state; returns its index.
  std::size_t keep(double x, const Others& other, double log_area, const Sizes& sizes) {
    if (size_ == capacity) forget();
    x_[size_] = x, others_[size_] = {other, log_area, sizes};
    has_sizes_ = has_sizes_ || sizes != Sizes{};
    return size_++;
  }
  void forget() {
    std::copy(x_.end() - kept, x_.end(), x_.begin());
    std::copy(others_.end() - kept, others_.end(), others_.begin());
    size_ = static_cast<std::size_t>(kept);
  }

  /// Whether one of the n displacements before that at `now` is within `distance` of it.
  [[nodiscard]] bool comes_near(std::size_t now, std::size_t n, double distance) const {
    const double x = x_[now], limit = distance * size(now, n, 0);
    std::int64_t near = 0;  // as wide as double, and without branches, so that compilers use vectors
    for (std::size_t i = now - n; i < now; ++i) near = std::abs(x - x_[i]) <= limit ? std::int64_t{1} : near;
    return near != 0;
  }

  /// Whether the states at `now` and n sections before are the same, to a tolerance.
  [[nodiscard]] bool repeats(std::size_t now, std::size_t n, double tolerance) const {
    const double limit = tolerance * size(now, n, 0);
    bool same = std::abs(x_[now] - x_[now - n]) <= limit && std::abs(v_at(now) - v_at(now - n)) <= limit;
    for (std::size_t i = 1; i + 1 < others; i += 2) same = same && change(now, n, i) <= tolerance * size(now, n, i + 1);
    return same;
  }
  [[nodiscard]] double v_at(std::size_t i) const { return others_[i].other[0]; }
  /// The larger change over n sections of the i-th of the other numbers and the next one.
  [[nodiscard]] double change(std::size_t now, std::size_t n, std::size_t i) const {
    const Others &a = others_[now].other, &b = others_[now - n].other;
    return std::max(std::abs(a[i] - b[i]), std::abs(a[i + 1] - b[i + 1]));
  }
  /// The size of the motion of the pair that begins with the i-th number of a state, over the last n periods.
  [[nodiscard]] double size(std::size_t now, std::size_t n, std::size_t i) const {
    const double place = i == 0 ? x_[now] : others_[now].other[i - 1];
    double size = std::max(std::abs(place), std::abs(others_[now].other[i]));
    if (!has_sizes_) return size;
    for (std::size_t section = now - n; section < now; ++section)
      size = std::max(size, others_[section + 1].sizes[i / 2]);
    return size;
  }

  /// Distance of the states at `now` and m sections before, over the size of the motion; of the two pairs the larger.
  [[nodiscard]] double distance(std::size_t now, std::size_t m) const {
    const double difference = std::max(std::abs(x_[now] - x_[now - m]), std::abs(v_at(now) - v_at(now - m)));
    double largest = difference / size(now, m, 0);
    for (std::size_t i = 1; i + 1 < others; i += 2)
      if (const double other = change(now, m, i) / size(now, m, i + 1); other > largest) largest = other;
    return largest;
  }

  /// Whether no divisor's distance is still shrinking at a hit at n: else a slowly alternating transient would pass for
  /// a longer period.
  [[nodiscard]] bool stands(std::size_t now, std::size_t n) const {
    for (std::size_t m = 1; m < n; ++m)
      if (n % m == 0 && (now < n + m || distance(now, m) < distance(now - n, m))) return false;
    return true;
  }

  /// The modulus of the multipliers of n periods, if all are the same, by the factor by which areas shrank in them.
  [[nodiscard]] double area_rate(std::size_t now, std::size_t n) const {
    double log_area = 0;
    for (std::size_t i = 0; i < n; ++i) log_area += others_[now - i].log_area;
    return std::exp(log_area / (others + 1));
  }

  /// Distance to the motion that a hit at n settles to: the sum of a geometric series. Its ratio is that of the last
  /// two distances, but no less than `area_rate`, since under a complex pair of multipliers distances rise and fall.
  [[nodiscard]] double left(std::size_t now, std::size_t n) const {
    const double latest = distance(now, n);
    if (!(latest > 0)) return 0;
    const double seen = now >= 2 * n ? latest / distance(now - n, n) : 0.0, rate = std::max(seen, area_rate(now, n));
    return rate < 1 ? latest / (1 - rate) : std::numeric_limits<double>::infinity();
  }

  /// Whether a hit at n is within the tolerance of the motion that it settles to, or as near as rounding allows.
  [[nodiscard]] bool settled(std::size_t now, std::size_t n) const {
    if (left(now, n) <= tolerance_) return true;
    const double latest = distance(now, n);
    return latest <= ulps && !(now >= 2 * n && latest < distance(now - n, n));
  }

  /// Whether the distance at the least hit, already down to the rounding of a period, has not fallen for as long as a
  /// pair of multipliers takes to quarter it, at least 16 rounds, and none of the divisors' distances has fallen
  /// throughout: rounding, in which a motion may go round for ever, makes each fall and rise.
  [[nodiscard]] bool stalls(std::size_t now, std::size_t n) {
    const double latest = distance(now, n), rate = area_rate(now, n);
    if (!(latest <= rounding)) return false;
    if (stalled_n_ != n || latest < closest_) {
      stalled_n_ = n, closest_ = latest, stalled_for_ = 0, falling_ = divisors_of(n);
      return false;
    }
    for (std::size_t m = 1; m < n; ++m)
      if (now >= n + m && distance(now, m) >= distance(now - n, m)) falling_ &= ~bit(m);
    return static_cast<double>(++stalled_for_) >
               static_cast<double>(n) * std::max(16.0, -std::log(4.0) / std::log(rate)) &&
           falling_ == 0;
  }
  [[nodiscard]] static std::uint64_t bit(std::size_t m) { return std::uint64_t{1} << m; }
  /// A bit for each divisor but n itself.
  [[nodiscard]] static std::uint64_t divisors_of(std::size_t n) {
    std::uint64_t set = 0;
    for (std::size_t m = 1; m < n; ++m)
      if (n % m == 0) set |= bit(m);
    return set;
  }

  /// The period of a hit at n: a divisor whose distance is down to a few tolerances and shrinks no further is as near a
  /// repeat as rounding allows (with a multiplier near -1 the states then lock into a cycle of a few hundred ulps). So
  /// is one whose distance is that of a transient which rounding has stopped.
  [[nodiscard]] std::size_t shortest(std::size_t now, std::size_t n) const {
    const double near = divisor_tolerances * std::max(tolerance_, std::min(left(now, n), most_left));
    return least_divisor(n, [&](std::size_t m) { return distance(now, m) < near; });
  }

  double tolerance_;
  std::size_t looks_every_, waited_ = 0;         ///< sections between two looks, and those since the last
  std::size_t candidate_ = 0, left_ = 0;         ///< a repeat to be confirmed, and the sections until then
  std::size_t stalled_n_ = 0, stalled_for_ = 0;  ///< a hit that comes no nearer, and the sections since it last did
  double closest_ = 0.0;                         ///< its least distance
  std::uint64_t falling_ = 0;                    ///< a bit for each divisor whose distance has only fallen since
  std::size_t size_ = 0;
  bool has_sizes_ = false;  ///< of the motion
  /// Of a section: the other numbers of its state, and the area's factor of the period before it.
  struct OthersAndArea {
    Others other;
    double log_area;
    Sizes sizes;  ///< at the events of the period before it
  };
  std::array<double, capacity> x_;  ///< the first `size_` are set; apart from the others, since they are compared first
  std::array<OthersAndArea, capacity> others_;
};
using RepeatFinder = BasicRepeatFinder<1>;

/// The section from which on a run with all effects looks for a repeat: early enough before max_periods to find a
/// motion of 64 periods, and to see a slow transient come to a halt at rounding (`RepeatFinder`).
[[nodiscard]] inline std::int64_t last_look(const Oscillator& oscillator, std::int64_t max_periods) {
  const double decay = oscillator.damping * period_of(oscillator), half = static_cast<double>(max_periods) / 2;
  const double slow = decay > 0 ? std::min(half, 3 * std::log(4.0) / decay) : 0.0;
  return max_periods - static_cast<std::int64_t>(3 * RepeatFinder::longest) - static_cast<std::int64_t>(slow);
}

/// Tells when to look for the periodic motion that states at sections contract to.
class Contracting {
 public:
  Contracting() { near_enough_.fill(nearest_first); }

  /// The least n for which states n apart come closer than at the last attempt, over the same contacts in the same
  /// order, `itinerary(ago)` of the period that began so many sections ago; 0 for none. `waits(n)`: an attempt doesn't
  /// pay.
  template <std::size_t others, class Itinerary, class Waits>
  [[nodiscard]] std::size_t periods(const BasicRepeatFinder<others>& repeat, const Itinerary& itinerary,
                                    const Waits& waits) const {
    for (std::size_t n = repeat.next_within(nearest_first, 1); n > 0; n = repeat.next_within(nearest_first, n + 1)) {
      const double now = repeat.distance_over(n);
      if (!(now <= near_enough_[n] && now > 8 * epsilon<double>() && now < repeat.distance_over(n, n))) continue;
      if (waits(n)) continue;
      bool same = true, meets = false;
      for (std::size_t ago = 1; same && ago <= n; ++ago)
        same = itinerary(ago) == itinerary(n + ago), meets = meets || itinerary(ago) != 0;
      if (same && meets) return n;
    }
    return 0;
  }
  /// An attempt is made at this distance of states n apart; the next one at a quarter of it.
  void attempt(std::size_t n, double distance) { near_enough_[n] = distance / 4; }

 private:
  static constexpr double nearest_first = 0.02;  ///< relative distance below which a first attempt is made
  std::array<double, RepeatFinder::longest + 1> near_enough_;  ///< [n]: distance below which an attempt is made
};

}  // namespace clatter::steady
