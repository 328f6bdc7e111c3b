#pragma once

#include <utility>
#include <vector>

#include "support/dataset.hpp"
#include "sweep/run.hpp"

namespace clatter::sweep {

/// Scene of Figs. 14-23: h = 0.1, f = -1, R = 0.7, from rest.
inline point::Problem paper_scene(double xs, double nu) {
  point::Problem scene;
  scene.oscillator = {0.1, -1.0, nu, 0.0};
  scene.stops = {-xs, xs, 0.7, 0.7};
  return scene;
}

/// A sweep whose axes cross.
inline Sweep sweep_of(const point::Problem& scene, std::vector<Axis> axes) {
  Sweep sweep{.problem = scene};
  for (Axis& axis : axes) sweep.dimensions.push_back({std::move(axis)});
  return sweep;
}

/// The dataset of a run that is done, with its values.
inline results::Dataset dataset_of(SweepRun& run) {
  results::Dataset dataset = run.result().dataset;
  collect(dataset);
  return dataset;
}

}  // namespace clatter::sweep
