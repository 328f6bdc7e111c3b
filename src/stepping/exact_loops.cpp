#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {

template struct CompiledLoop<Exact<double, effect_sets::of_any_stiffness(Damping::light, Forcing::secular)>>;
template struct CompiledLoop<Exact<double, effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular)>>;
template struct CompiledLoop<Exact<double, effect_sets::with_soft_stops(Damping::light, Forcing::secular)>>;
template struct CompiledLoop<Exact<double, effect_sets::with_soft_stops(Damping::heavy, Forcing::regular)>>;
template struct CompiledLoop<Exact<double, effect_sets::with_soft_stops(Damping::light, Forcing::regular)>>;

}  // namespace clatter::stepping
