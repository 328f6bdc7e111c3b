#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {

template struct CompiledLoop<Exact<double, effect_sets::with_everything(Damping::light, Forcing::secular)>>;
template struct CompiledLoop<Exact<double, effect_sets::with_everything(Damping::heavy, Forcing::regular)>>;

}  // namespace clatter::stepping
