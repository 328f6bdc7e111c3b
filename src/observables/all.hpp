#pragma once

#include "observables/attractor.hpp"
#include "observables/energy.hpp"
#include "observables/extrema.hpp"
#include "observables/harmonics.hpp"
#include "observables/impact_log.hpp"
#include "observables/impact_word.hpp"
#include "observables/impacts.hpp"
#include "observables/observable_list.hpp"
#include "observables/period.hpp"
#include "observables/section.hpp"
#include "observables/sensitivity.hpp"
#include "observables/settling.hpp"
#include "observables/stability.hpp"
#include "observables/time_to_rest.hpp"
#include "observables/trajectory.hpp"

namespace clatter::observables {

/// Every observable, in the order of keys and results. Configuration keys, help, observers, results, plan and memory
/// are made from this list.
using All = ObservableList<Extrema, Harmonics, Impacts, ImpactLog, Trajectory, Section, ImpactWord, Period, Stability,
                           Energy, Sensitivity, Settling, TimeToRest, Attractor>;

/// The observables that are computed and stored; nothing else is.
struct Observe : All::Settings {
  Frame frame = Frame::relative;  ///< of displacements and velocities
};

}  // namespace clatter::observables
