// Scenes without stops, and scenes without a force.

#include "point/exact_points_run.hpp"

namespace clatter::point {

template class ExactPoints<effect_sets::free_of_stops(Damping::none, Forcing::none)>;
template class ExactPoints<effect_sets::free_of_stops(Damping::light, Forcing::regular)>;
template class ExactPoints<effect_sets::free_of_stops(Damping::heavy, Forcing::regular)>;
template class ExactPoints<effect_sets::free_of_stops(Damping::light, Forcing::secular)>;
template class ExactPoints<effect_sets::complete(Damping::none, Forcing::none)>;
template class ExactPoints<effect_sets::complete(Damping::light, Forcing::none)>;
template class ExactPoints<effect_sets::complete(Damping::heavy, Forcing::none)>;

}  // namespace clatter::point
