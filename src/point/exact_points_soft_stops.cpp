#include "point/exact_points_run.hpp"

namespace clatter::point {

template class ExactPoints<effect_sets::with_soft_stops(Damping::light, Forcing::secular)>;
template class ExactPoints<effect_sets::with_soft_stops(Damping::heavy, Forcing::regular)>;
template class ExactPoints<effect_sets::with_soft_stops(Damping::light, Forcing::regular)>;

}  // namespace clatter::point
