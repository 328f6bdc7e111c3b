#include "point/exact_points_run.hpp"

namespace clatter::point {

template class ExactPoints<effect_sets::with_loose_mass(Damping::light, Forcing::secular)>;
template class ExactPoints<effect_sets::with_loose_mass(Damping::heavy, Forcing::regular)>;

}  // namespace clatter::point
