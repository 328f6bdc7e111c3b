#include "point/exact_points_run.hpp"

namespace clatter::point {

template class ExactPoints<effect_sets::complete(Damping::none, Forcing::regular)>;
template class ExactPoints<effect_sets::complete(Damping::light, Forcing::regular)>;
template class ExactPoints<effect_sets::complete(Damping::heavy, Forcing::regular)>;
template class ExactPoints<effect_sets::complete(Damping::none, Forcing::secular)>;
template class ExactPoints<effect_sets::complete(Damping::light, Forcing::secular)>;

}  // namespace clatter::point
