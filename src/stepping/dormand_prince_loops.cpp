#include "stepping/dormand_prince.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {

template struct CompiledLoop<DormandPrince<effect_sets::with_standing_stops(Damping::light, Forcing::regular)>>;
template struct CompiledLoop<DormandPrince<effect_sets::with_standing_stops(Damping::heavy, Forcing::regular)>>;
template struct CompiledLoop<DormandPrince<effect_sets::with_everything(Damping::light, Forcing::regular)>>;
template struct CompiledLoop<DormandPrince<effect_sets::with_everything(Damping::heavy, Forcing::regular)>>;

}  // namespace clatter::stepping
