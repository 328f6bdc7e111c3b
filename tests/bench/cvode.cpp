// SUNDIALS CVODE finds roots of functions of the solution itself. A careful user sets it up like this: both gaps as
// such functions, of which only falling ones count; Adams' methods, or BDF if damping makes the equation stiff, with
// Newton's iteration and the exact Jacobian; after each root the law of impact and CVodeReInit at the same time; a stop
// time at the end. The first step of each flight is CVODE's own choice. Steps are taken one by one only so that points
// within them can be checked.
#include <cvode/cvode.h>
#include <nvector/nvector_serial.h>
#include <sunlinsol/sunlinsol_dense.h>
#include <sunmatrix/sunmatrix_dense.h>

#include <array>
#include <cstdlib>
#include <stdexcept>
#include <string>

#include "bench/cvode_handles.hpp"
#include "bench/solver_run.hpp"

namespace clatter::bench {
namespace {

Values values(N_Vector y) { return {NV_Ith_S(y, 0), NV_Ith_S(y, 1)}; }

void set(N_Vector y, const Values& to) { NV_Ith_S(y, 0) = to[0], NV_Ith_S(y, 1) = to[1]; }

int equation(sunrealtype tau, N_Vector y, N_Vector rate, void* run) {
  set(rate, static_cast<SolverRun*>(run)->derivative(tau, values(y)));
  return 0;
}

int jacobian(sunrealtype, N_Vector, N_Vector, SUNMatrix J, void* run, N_Vector, N_Vector, N_Vector) {
  SM_ELEMENT_D(J, 0, 0) = 0, SM_ELEMENT_D(J, 0, 1) = 1;
  SM_ELEMENT_D(J, 1, 0) = -1, SM_ELEMENT_D(J, 1, 1) = -2 * static_cast<SolverRun*>(run)->damping();
  return 0;
}

int gaps(sunrealtype, N_Vector y, sunrealtype* gap, void* run) {
  for (const Side side : {Side::lower, Side::upper})
    *gap++ = static_cast<const SolverRun*>(run)->gap(side, NV_Ith_S(y, 0));
  return 0;
}

void check(int flag) {
  if (flag < 0) throw std::runtime_error("CVODE cannot be set up");
}

/// CVODE, set up for a run.
class Cvode {
 public:
  explicit Cvode(SolverRun& run) : run_(run) {
    SUNContext context = nullptr;
    check(SUNContext_Create(nullptr, &context));
    context_.reset(context);
    y_.reset(N_VNew_Serial(2, context)), look_.reset(N_VNew_Serial(2, context));
    matrix_.reset(SUNDenseMatrix(2, 2, context));
    solver_.reset(SUNLinSol_Dense(y_.get(), matrix_.get(), context));
    cvode_.reset(CVodeCreate(run.damping() >= 10 ? CV_BDF : CV_ADAMS, context));
    set(y_.get(), run.start());
    void* const cvode = cvode_.get();
    check(CVodeInit(cvode, equation, 0.0, y_.get()));
    check(CVodeSetErrFile(cvode, nullptr));
    check(CVodeSetUserData(cvode, &run));
    check(CVodeSStolerances(cvode, run.relative_tolerance(), run.absolute_tolerance()));
    check(CVodeSetLinearSolver(cvode, solver_.get(), matrix_.get()));
    check(CVodeSetJacFn(cvode, jacobian));
    check(CVodeRootInit(cvode, 2, gaps));
    std::array<int, 2> falling{-1, -1};
    check(CVodeSetRootDirection(cvode, falling.data()));
  }

  void integrate() {
    while (run_.goes_on(tau_)) {
      const double from = tau_;
      check(CVodeSetStopTime(cvode_.get(), run_.duration()));
      const int flag = CVode(cvode_.get(), run_.duration(), y_.get(), &tau_, CV_ONE_STEP);
      if (flag == CV_TOO_CLOSE) return run_.complete(values(y_.get())[0]);  // the rest of the run is below rounding
      if (flag < 0) return run_.fail(tau_, name_of(flag));
      look_into_step(from);
      if (flag == CV_ROOT_RETURN)
        rebound();
      else if (flag == CV_TSTOP_RETURN)
        return run_.complete(values(y_.get())[0]);
    }
  }

 private:
  void look_into_step(double from) {
    for (int i = 1; i < looks_per_step; ++i) {
      const double tau = from + (tau_ - from) * i / looks_per_step;
      if (CVodeGetDky(cvode_.get(), tau, 0, look_.get()) == CV_SUCCESS) run_.see(tau, values(look_.get())[0]);
    }
    run_.see(tau_, values(y_.get())[0]);
  }

  void rebound() {
    std::array<int, 2> found{};
    check(CVodeGetRootInfo(cvode_.get(), found.data()));
    set(y_.get(), run_.contact(tau_, found[0] != 0 ? Side::lower : Side::upper, values(y_.get())[1]));
    check(CVodeReInit(cvode_.get(), tau_, y_.get()));
  }

  static std::string name_of(int flag) {
    char* const name = CVodeGetReturnFlagName(flag);
    std::string copy(name);
    std::free(name);
    return copy;
  }

  SolverRun& run_;
  double tau_ = 0.0;
  Owned<SUNContext> context_;
  Owned<N_Vector> y_, look_;
  Owned<SUNMatrix> matrix_;
  Owned<SUNLinearSolver> solver_;
  Owned<void*> cvode_;
};

}  // namespace

void run_cvode(SolverRun& run) { Cvode(run).integrate(); }

}  // namespace clatter::bench
