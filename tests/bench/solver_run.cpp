#include "bench/solver_run.hpp"

#include <algorithm>
#include <cmath>

#include "motion/contact_force.hpp"

namespace clatter::bench {
namespace {

// Budgets instead of a clock, so that the results are the same on every machine.
constexpr std::int64_t most_right_hand_sides = 10'000'000;
constexpr std::size_t most_contacts = 200'000;
constexpr std::size_t most_standing = 1000;  // successive contacts at the same time

double size_of(const point::Problem& scene) {
  const double half = (scene.stops.upper - scene.stops.lower) / 2;
  const double moves = std::max({std::abs(scene.oscillator.forcing), std::abs(scene.oscillator.load),
                                 std::abs(scene.start.displacement), std::abs(scene.start.velocity)});
  return std::min(half, moves);
}

}  // namespace

SolverRun::SolverRun(const point::Problem& scene, double duration)
    : scene_(scene),
      duration_(duration),
      size_(size_of(scene)),
      start_{scene.start.displacement, scene.start.velocity} {
  for (const Side side : {Side::lower, Side::upper})
    if (gap(side, start_[0]) == 0 && sign_of(side) * start_[1] > 0) start_ = contact(0.0, side, start_[1]);
}

Values SolverRun::derivative(double tau, const Values& y) {
  ++right_hand_sides_;
  return {y[1], acceleration(tau, y)};
}

double SolverRun::acceleration(double tau, const Values& y) const {
  const Oscillator& o = scene_.oscillator;
  return o.forcing * std::sin(o.frequency * tau + scene_.start.phase) + o.load - 2 * o.damping * y[1] - y[0];
}

double SolverRun::gap(Side side, double x) const {
  return side == Side::upper ? scene_.stops.upper - x : x - scene_.stops.lower;
}

double SolverRun::first_step(double tau, const Values& y) {
  const double fastest = std::max({1.0, scene_.oscillator.frequency, 2 * scene_.oscillator.damping});
  const double speed = std::abs(y[1]);
  double step = 0.01 / fastest;
  if (speed > 0)  // a tenth of the way to the other stop, and of the half of a flight back to this one
    step = std::min({step, 0.1 * half_distance() / speed, 0.1 * speed / std::abs(acceleration(tau, y))});
  return std::max(step, 16 * epsilon<double>() * tau);
}

bool SolverRun::goes_on(double tau) {
  if (outcome_ != Outcome::running) return false;
  if (contacts_.size() > moved_on_ + most_standing)
    give_up(Outcome::stuck, tau, "time stands still");
  else if (contacts_.size() >= most_contacts)
    give_up(Outcome::stuck, tau, creeps() ? "time creeps" : "budget of contacts");
  else if (right_hand_sides_ >= most_right_hand_sides)
    give_up(Outcome::stuck, tau, "budget of right-hand sides");
  return outcome_ == Outcome::running;
}

/// Whether the rest of the run would take more than a hundred times the budget at the pace of the latest contacts.
bool SolverRun::creeps() const {
  const double latest = contacts_.back() - contacts_[contacts_.size() - most_standing];
  return latest / most_standing * 100 * most_contacts < duration_ - contacts_.back();
}

Values SolverRun::contact(double tau, Side side, double v) {
  if (contacts_.empty() || tau > contacts_.back() * (1 + epsilon<double>())) moved_on_ = contacts_.size();
  contacts_.push_back(tau);
  const auto stop = motion::stop_at<double>(scene_.stops, side);
  if (!(stop.into(v) > 0)) return {stop.position, v};
  impacts_.push_back({accuracy::Event::Kind::impact, side, tau, std::abs(v), 0.0});
  return {stop.position, stop.law.after(v)};
}

void SolverRun::see(double tau, double x) {
  if (!std::isfinite(x)) fail(tau, "not finite");
  deepest_ = std::max({deepest_, -gap(Side::lower, x), -gap(Side::upper, x)});
}

void SolverRun::complete(double x) {
  if (outcome_ == Outcome::running) outcome_ = Outcome::completed, end_ = x;
}

double SolverRun::penetration() const {
  return std::isfinite(half_distance()) ? deepest_ / half_distance() : std::numeric_limits<double>::quiet_NaN();
}

void SolverRun::give_up(Outcome outcome, double tau, const std::string& why) {
  outcome_ = outcome, gave_up_at_ = tau, why_ = why;
}

}  // namespace clatter::bench
