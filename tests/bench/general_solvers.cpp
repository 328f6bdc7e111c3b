// Runs the hard cases, or those of one row, through general solvers of differential equations, and writes one JSON
// object a line: the comparison of each solver's run of each case with clatter's.
#include <cmath>
#include <iomanip>
#include <iostream>
#include <stdexcept>
#include <string>
#include <vector>

#include "bench/comparison.hpp"
#include "bench/solver_run.hpp"
#include "hard/cases.hpp"

namespace {

using namespace clatter;
using namespace clatter::bench;

struct Solver {
  const char* name;
  void (*run)(SolverRun&);
};

constexpr Solver solvers[] = {
    {"Odeint dopri5", run_odeint},
#ifdef CLATTER_CVODE
    {"CVODE", run_cvode},
#endif
};

/// JSON has no number for what doesn't exist.
struct OrNull {
  double value;
  int digits = 4;
};

std::ostream& operator<<(std::ostream& out, const OrNull& number) {
  if (!std::isfinite(number.value)) return out << "null";
  return out << std::setprecision(number.digits) << number.value;
}

std::string quoted(const std::string& text) { return text.empty() ? "null" : '"' + text + '"'; }

void print(const hard::Case& one, const Solver& solver, const SolverRun& run, const Comparison& comparison) {
  static const char* const names[] = {"running", "completed", "stuck", "failed"};
  std::cout << "{\"row\": " << quoted(one.row) << ", \"what\": " << quoted(one.what)
            << ", \"solver\": " << quoted(solver.name) << ", \"outcome\": \"" << names[static_cast<int>(run.outcome())]
            << "\", \"why\": " << quoted(run.why()) << ", \"gave_up_at\": " << OrNull{run.gave_up_at(), 17}
            << ", \"duration\": " << OrNull{one.duration, 17} << ", \"impacts\": " << run.impacts().size()
            << ", \"expected\": " << comparison.expected << ", \"missed\": " << comparison.missed
            << ", \"unreached\": " << comparison.unreached << ", \"extra\": " << comparison.extra
            << ", \"penetration\": " << OrNull{run.penetration()}
            << ", \"error_time\": " << OrNull{comparison.error_time} << ", \"error_x\": " << OrNull{comparison.error_x}
            << ", \"right_hand_sides\": " << run.right_hand_sides() << "}" << std::endl;
}

/// The solvers integrate a spring of k = 1 between rigid stops, without dry friction.
bool is_solvable(const point::Problem& scene) {
  return scene.oscillator.stiffness == 1.0 && !has_soft_stop(scene.stops) && !has_friction(scene.friction);
}

void measure(const hard::Case& one) {
  if (!is_solvable(one.scene)) return;
  const accuracy::RunRecord record = accuracy::record_of(one.scene, one.duration);
  if (record.outcome != stepping::Outcome::completed)
    throw std::runtime_error("clatter fails on " + one.row + ", " + one.what);
  for (const Solver& solver : solvers) {
    SolverRun run(one.scene, one.duration);
    solver.run(run);
    print(one, solver, run, compare(run, record, one.scene.stops));
  }
}

}  // namespace

int main(int argc, char** argv) {
  try {
    for (const hard::Case& one : argc > 1 ? hard::cases_of(argv[1]) : hard::cases()) measure(one);
    return 0;
  } catch (const std::exception& error) {
    std::cerr << "general_solvers: " << error.what() << '\n';
    return 1;
  }
}
