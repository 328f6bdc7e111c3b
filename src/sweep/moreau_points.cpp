#include "integrators/moreau.hpp"

#include "sweep/general_points.hpp"
#include "sweep/point_run.hpp"

namespace clatter {

PointResult run_by_moreau(const Scene& scene, Workshop& workshop) {
  return with_general_effects(scene.oscillator,
                              [&]<Effects effects>() { return Point(scene, workshop, Moreau<effects>(scene)).run(); });
}

}  // namespace clatter
