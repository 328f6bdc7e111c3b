#include "stepping/dormand_prince.hpp"

#include "point/general_points.hpp"
#include "point/point_run.hpp"

namespace clatter::point {

PointResult run_by_dormand_prince(const Problem& problem, ThreadScratch& scratch) {
  return with_general_effects(problem, [&]<Effects effects>() {
    stepping::DormandPrince<effects> integrator(problem, problem.integration, limits_of(problem));
    return Point(problem, scratch, integrator).run();
  });
}

}  // namespace clatter::point
