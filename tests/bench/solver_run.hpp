#pragma once

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "point/problem.hpp"
#include "support/deviation.hpp"

namespace clatter::bench {

/// x and x', the solvers' variables.
using Values = std::array<double, 2>;

/// A scene as a user writes it for a general solver, and the record of the solver's run.
///
/// The user supplies the equation, the gaps and the law of impact, begins with a reflection if the start moves into a
/// stop, puts the mass exactly onto the stop at each located contact, reverses its velocity only if it moves in, and
/// chooses tolerances and first steps that suit the scene. Chatter and rest are left to the solver, impact by impact.
class SolverRun {
 public:
  enum class Outcome : std::uint8_t { running, completed, stuck, failed };

  SolverRun(const point::Problem& scene, double duration);

  // The interface for the solver's questions.
  [[nodiscard]] const Values& start() const { return start_; }  ///< after the reflection, if there was one
  [[nodiscard]] double duration() const { return duration_; }
  [[nodiscard]] double damping() const { return scene_.oscillator.damping; }
  [[nodiscard]] double relative_tolerance() const { return 1e-10; }
  [[nodiscard]] double absolute_tolerance() const { return 1e-10 * size_; }
  [[nodiscard]] Values derivative(double tau, const Values& y);  ///< counted
  [[nodiscard]] double gap(Side side, double x) const;           ///< to a stop, < 0 beyond it; inf: no such stop
  [[nodiscard]] double first_step(double tau,
                                  const Values& y);  ///< well below the length of the flight that begins here
  [[nodiscard]] bool goes_on(double tau);            ///< false: out of budget, or complete

  // The interface for the solver's reports.
  Values contact(double tau, Side side,
                 double v);        ///< a contact, and an impact if it moves in; returns the state after
  void see(double tau, double x);  ///< a displacement on the way
  void complete(double x);
  void fail(double tau, const std::string& why) { give_up(Outcome::failed, tau, why); }

  // The result.
  [[nodiscard]] Outcome outcome() const { return outcome_; }
  [[nodiscard]] const std::string& why() const { return why_; }    ///< why it did not complete; else empty
  [[nodiscard]] double gave_up_at() const { return gave_up_at_; }  ///< tau; completed: NaN
  [[nodiscard]] const std::vector<accuracy::Event>& impacts() const { return impacts_; }  ///< in the order of time
  [[nodiscard]] double penetration() const;  ///< largest reported, over half the distance of the stops; NaN: no stops
  [[nodiscard]] double end() const { return end_; }  ///< x at the end; NaN if it was not reached
  [[nodiscard]] std::int64_t right_hand_sides() const { return right_hand_sides_; }

 private:
  void give_up(Outcome outcome, double tau, const std::string& why);
  [[nodiscard]] bool creeps() const;
  [[nodiscard]] double acceleration(double tau, const Values& y) const;
  [[nodiscard]] double half_distance() const { return (scene_.stops.upper - scene_.stops.lower) / 2; }

  point::Problem scene_;
  double duration_;
  double
      size_;  ///< of the motion: half the distance of the stops, or the size that start and force suggest, if smaller
  Values start_;
  Outcome outcome_ = Outcome::running;
  std::string why_{};
  double gave_up_at_ = std::numeric_limits<double>::quiet_NaN();
  std::vector<accuracy::Event> impacts_{};
  std::vector<double> contacts_{};  ///< times of all contacts, impacts or not
  std::size_t moved_on_ = 0;        ///< the last contact that was later than the one before
  double deepest_ = 0.0;
  double end_ = std::numeric_limits<double>::quiet_NaN();
  std::int64_t right_hand_sides_ = 0;
};

/// Points in each step of a solver, its end included, at which motion beyond a stop is looked for.
inline constexpr int looks_per_step = 8;

void run_odeint(SolverRun& run);  ///< Boost.Odeint: Dormand and Prince's pair of orders 5 and 4, with dense output
void run_cvode(SolverRun& run);   ///< SUNDIALS CVODE with its own root finder; only if CLATTER_CVODE is defined

}  // namespace clatter::bench
