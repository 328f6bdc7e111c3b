#pragma once

#include "observables/attractor.hpp"
#include "observables/contacts/impact_log.hpp"
#include "observables/contacts/impact_word.hpp"
#include "observables/contacts/impacts.hpp"
#include "observables/energy/energy.hpp"
#include "observables/extremes/extrema.hpp"
#include "observables/harmonics/harmonics.hpp"
#include "observables/observable_list.hpp"
#include "observables/period.hpp"
#include "observables/samples/section.hpp"
#include "observables/samples/trajectory.hpp"
#include "observables/sensitivity/sensitivity.hpp"
#include "observables/settling.hpp"
#include "observables/stability/stability.hpp"
#include "observables/time_to_rest.hpp"

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
