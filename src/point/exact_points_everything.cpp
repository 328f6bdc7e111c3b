#include "point/exact_points_run.hpp"

namespace clatter::point {

template class ExactPoints<effect_sets::with_everything(Damping::light, Forcing::secular)>;
template class ExactPoints<effect_sets::with_everything(Damping::heavy, Forcing::regular)>;

}  // namespace clatter::point
