// SUNDIALS CVODE as a user sets it up for speed: Adams' methods with Newton's iteration and the exact Jacobian, which
// take fewer steps here than fixed-point iteration; both gaps as root functions, of which only falling ones count, the
// gap that the mass has just closed not until the velocity points there again; after each root the law of impact and
// CVodeReInit at the same time; a stop time at the end. The first step of each flight is CVODE's own choice.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <array>
#include <stdexcept>

#include "bench/cvode_handles.hpp"
#include "bench/transient.hpp"

namespace clatter::bench {
namespace {

/// The data of CVODE's callbacks.
struct Problem {
  Equation equation;
  Stops stops;
  double damping;
  int left = 0;  ///< -1, 1: the stop that the mass left last; 0: none yet
};

Phase values(N_Vector y) { return {NV_DATA_S(y)[0], NV_DATA_S(y)[1]}; }

int rate(sunrealtype tau, N_Vector y, N_Vector dy, void* problem) {
  const auto [x, v] = values(y);
  NV_DATA_S(dy)[0] = v, NV_DATA_S(dy)[1] = static_cast<const Problem*>(problem)->equation.acceleration(tau, x, v);
  return 0;
}

int jacobian(sunrealtype, N_Vector, N_Vector, SUNMatrix J, void* problem, N_Vector, N_Vector, N_Vector) {
  SM_ELEMENT_D(J, 0, 0) = 0, SM_ELEMENT_D(J, 0, 1) = 1;
  SM_ELEMENT_D(J, 1, 0) = -1, SM_ELEMENT_D(J, 1, 1) = -2 * static_cast<const Problem*>(problem)->damping;
  return 0;
}

int roots(sunrealtype, N_Vector y, sunrealtype* root, void* problem) {
  const auto& [equation, stops, damping, left] = *static_cast<const Problem*>(problem);
  const auto [x, v] = values(y);
  root[0] = left == -1 && v > 0 ? 1.0 : x - stops.lower;
  root[1] = left == 1 && v < 0 ? 1.0 : stops.upper - x;
  root[2] = v;
  return 0;
}

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE fails");
}

/// CVODE, set up for a run.
class Run {
 public:
  Run(const point::Problem& scene, double tolerance)
      : problem_{Equation(scene), scene.stops, scene.oscillator.damping},
        duration_(scene.time.duration),
        run_{scene.start.displacement, scene.start.displacement} {
    SUNContext context = nullptr;
    check(SUNContext_Create(nullptr, &context));
    context_.reset(context);
    y_.reset(N_VNew_Serial(2, context));
    NV_DATA_S(y_.get())[0] = scene.start.displacement, NV_DATA_S(y_.get())[1] = scene.start.velocity;
    cvode_.reset(CVodeCreate(CV_ADAMS, context));
    matrix_.reset(SUNDenseMatrix(2, 2, context));
    solver_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context));
    set_up(tolerance);
  }

  Transient to_end() {
    while (true) {
      double tau = 0;
      const int flag = CVode(cvode_.get(), duration_, y_.get(), &tau, CV_NORMAL);
      check(flag);
      const auto [x, v] = values(y_.get());
      run_.pass(x);
      if (flag != CV_ROOT_RETURN) {
        run_.x = x, run_.v = v;
        return run_;
      }
      std::array<int, 3> found{};
      check(CVodeGetRootInfo(cvode_.get(), found.data()));
      if (found[0] != 0 || found[1] != 0) rebound(tau, v, found[1] != 0);
    }
  }

 private:
  void set_up(double tolerance) {
    void* const cvode = cvode_.get();
    check(CVodeInit(cvode, rate, 0.0, y_.get()));
    check(CVodeSetUserData(cvode, &problem_));
    check(CVodeSStolerances(cvode, tolerance, tolerance));
    check(CVodeSetLinearSolver(cvode, solver_.get(), matrix_.get()));
    check(CVodeSetJacFn(cvode, jacobian));
    check(CVodeRootInit(cvode, 3, roots));
    check(CVodeSetNoInactiveRootWarn(cvode));
    std::array<int, 3> directions{-1, -1, 0};
    check(CVodeSetRootDirection(cvode, directions.data()));
    check(CVodeSetStopTime(cvode, duration_));
  }

  /// Starts anew from an impact.
  void rebound(double tau, double v, bool upper) {
    const Stops& stops = problem_.stops;
    problem_.left = upper ? 1 : -1;
    NV_DATA_S(y_.get())[0] = upper ? stops.upper : stops.lower;
    NV_DATA_S(y_.get())[1] = -(upper ? stops.restitution_upper : stops.restitution_lower).R * v;
    check(CVodeReInit(cvode_.get(), tau, y_.get()));
    check(CVodeSetStopTime(cvode_.get(), duration_));
  }

  Problem problem_;
  double duration_;
  Transient run_;
  Owned<SUNContext> context_;
  Owned<N_Vector> y_;
  Owned<SUNMatrix> matrix_;
  Owned<SUNLinearSolver> solver_;
  Owned<void*> cvode_;
};

}  // namespace

Transient cvode_transient(const point::Problem& scene, double tolerance) { return Run(scene, tolerance).to_end(); }

}  // namespace clatter::bench
