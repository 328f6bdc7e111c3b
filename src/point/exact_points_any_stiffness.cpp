#include "point/exact_points_run.hpp"

namespace clatter::point {

template class ExactPoints<effect_sets::of_any_stiffness(Damping::light, Forcing::secular)>;
template class ExactPoints<effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular)>;

}  // namespace clatter::point
