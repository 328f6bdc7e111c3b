#include "stepping/moreau.hpp"

#include "point/general_points.hpp"
#include "point/point_run.hpp"

namespace clatter::point {

PointResult run_by_moreau(const Problem& scene, ThreadScratch& scratch) {
  return with_general_effects(scene.oscillator, [&]<Effects effects>() {
    const stepping::Moreau<effects> integrator(scene, scene.integration, limits_of(scene));
    return Point(scene, scratch, integrator).run();
  });
}

}  // namespace clatter::point
