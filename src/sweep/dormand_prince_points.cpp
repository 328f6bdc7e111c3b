#include "integrators/dormand_prince.hpp"

#include "sweep/general_points.hpp"
#include "sweep/point_run.hpp"

namespace clatter {

PointResult run_by_dormand_prince(const Scene& scene, Workshop& workshop) {
  return with_general_effects(
      scene.oscillator, [&]<Effects effects>() { return Point(scene, workshop, DormandPrince<effects>(scene)).run(); });
}

}  // namespace clatter
