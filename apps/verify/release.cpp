#include "release.hpp"

#include <algorithm>

namespace verify {
namespace {

constexpr const char* unknown_release = "whether the force ever releases the mass";

/// The phases of a turn at which a force of several orders falls to 0. The turn begins where no scene is likely to have
/// one. A part of it has none if the force isn't 0 on it, and one at most if it is monotone there.
class Falls {
 public:
  explicit Falls(const Press<Ball>& press) : press_(press) {
    look(first, first + 1, 40);
    for (std::size_t i = 0; i < phases_.size(); ++i) {
      const Ball next = i + 1 < phases_.size() ? phases_[i + 1] : phases_[0] + phase(1);
      if (!(next - phases_[i] > phase(releases_apart))) throw Undecided(unknown_release);
    }
  }

  [[nodiscard]] const std::vector<Ball>& found() const { return phases_; }

 private:
  static constexpr double first = 35.0 / 256;  ///< turns; so that all parts of the turn have exact ends

  [[nodiscard]] static Ball phase(double turns) { return Ball(turns) * Ball(2) * Ball::pi(); }
  void look(double begin, double end, int halvings) {
    const Ball all = Ball::hull(phase(begin), phase(end));
    const auto [height, slope] = press_.at(all);
    if (height.is_positive() || height.is_negative()) return;
    if (slope.is_positive() || slope.is_negative()) {
      const Ball before = press_.at(phase(begin)).first, after = press_.at(phase(end)).first;
      const bool is_known = !before.overlaps(Ball(0)) && !after.overlaps(Ball(0));
      if (is_known && before.is_positive() && after.is_negative()) phases_.push_back(root(begin, end, slope));
      if (is_known) return;
    }
    if (halvings == 0) throw Undecided(unknown_release);
    look(begin, (begin + end) / 2, halvings - 1), look((begin + end) / 2, end, halvings - 1);
  }
  /// By the mean value theorem from a place that is nearly the root.
  [[nodiscard]] Ball root(double begin, double end, const Ball& slope) const {
    double low = begin, high = end;
    for (int i = 0; i < 50; ++i) {
      const double middle = (low + high) / 2;
      (press_.at(phase(middle)).first.near() > 0 ? low : high) = middle;
    }
    Ball theta = phase((low + high) / 2);
    for (slong known = 32; known < 2 * bits; known *= 2) {
      const auto [height, steepness] = press_.at(theta);
      theta = (theta - height / steepness).middle();
    }
    if (!(phase(begin) < theta && theta < phase(end))) throw Undecided(unknown_release);
    return theta - press_.at(theta).first / slope;
  }

  const Press<Ball>& press_;
  std::vector<Ball> phases_;
};

/// Of a sine: sin(theta) is what balances the rest, and falls or rises as the press has to.
template <class Number>
std::vector<Number> falls_of_sine(const Press<Number>& press) {
  const Number& f = press.force.orders[0].in_phase;
  const Number u = -press.sign * press.constant / f;
  if (Number(1) < abs(u)) return {};
  if (!(abs(u) < Number(1))) throw Undecided(unknown_release);
  const bool falls = (f * press.sign).is_positive();
  return {falls ? Number(Ball::pi()) - asin(u) : asin(u)};
}

/// The one of some that is least far from a phase; `is_nearer` proves it of another one and its distance.
template <class Nearer>
PhaseOfRelease least_far(const std::vector<PhaseOfRelease>& releases, const std::vector<Ball>& phases, const Ball& here,
                         const Nearer& is_nearer) {
  std::vector<Ball> distances;
  for (const PhaseOfRelease& release : releases) distances.push_back(abs(release.of(phases) - here));
  const auto first = std::ranges::min_element(distances, {}, &Ball::near);
  if (first == distances.end()) throw Undecided(unknown_release);
  for (const Ball& other : distances)
    if (&other != &*first && !is_nearer(*first, other)) throw Undecided("which of two phases releases the mass");
  return releases[static_cast<std::size_t>(first - distances.begin())];
}

}  // namespace

std::vector<Ball> falls_of(const Press<Ball>& press) {
  return press.force.is_sine() ? falls_of_sine(press) : Falls(press).found();
}

std::vector<Dual> falls_of(const Press<Dual>& press) {
  if (press.force.is_sine()) return falls_of_sine(press);
  const Press<Ball> values{values_of(press.force), press.sign.value, press.constant.value};
  std::vector<Dual> falls;
  for (const Ball& theta : falls_of(values))
    falls.emplace_back(theta, -press.at(Dual(theta)).first.slope / values.at(theta).second);
  return falls;
}

PhaseOfRelease first_after(const std::vector<Ball>& phases, const Ball& here) {
  std::vector<PhaseOfRelease> releases;
  for (const Ball& theta : phases)
    releases.push_back({((here - theta) / (Ball(2) * Ball::pi())).floor() + 1, releases.size()});
  return least_far(releases, phases, here, [](const Ball& one, const Ball& other) { return one < other; });
}
PhaseOfRelease nearest_to(const std::vector<Ball>& phases, const Ball& here) {
  const Ball turn = Ball(2) * Ball::pi();
  std::vector<PhaseOfRelease> releases;
  for (const Ball& theta : phases)
    releases.push_back({((here - theta) / turn + Ball(0.5)).middle().floor(), releases.size()});
  const auto nearest = least_far(releases, phases, here, [&](const Ball& one, const Ball& other) {
    return one < other && one < turn - other;  // in the turns beside it, too
  });
  if (!(abs(nearest.of(phases) - here) < turn / Ball(2))) throw Undecided("which of two phases releases the mass");
  return nearest;
}

}  // namespace verify
