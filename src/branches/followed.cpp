#include "branches/followed.hpp"

#include "sweep/scaling.hpp"

namespace clatter::branches {

point::Problem start_problem(const sweep::Sweep& sweep) {
  point::Problem problem = sweep.problem;
  if (sweep.start_period) sweep::set(problem, sweep::Parameter::start_period, *sweep.start_period);
  if (sweep.machine) sweep::to_computed_units(problem, *sweep.machine);
  return problem;
}

Followed followed(sweep::Parameter key, const point::Problem& start) {
  using enum sweep::Parameter;
  Followed followed(key);
  const Units& units = start.units;
  if (!units.is_si) return followed;
  followed.section = "machine", followed.factor = factor_of(units, sweep::quantity_of(key));
  switch (key) {
    case mass:  // all other numbers are per unit mass, so linear in its inverse
      followed.is_inverse = true;
      break;
    case frequency:
      followed.parameter = nu;
      break;
    case force:
      followed.parameter = f;
      break;
    case gap:
      followed.parameter = xs;
      break;
    case damping:  // c = 2 h m
      followed.parameter = h, followed.factor *= 2;
      break;
    case damping_ratio:  // in these units |k| = 1
      followed.parameter = h;
      break;
    case quality:
      followed.parameter = h, followed.factor = 0.5, followed.is_inverse = true;
      break;
    default:
      break;
  }
  return followed;
}

}  // namespace clatter::branches
