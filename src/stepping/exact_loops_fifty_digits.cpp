#include "math/fifty_digits.hpp"
#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {

template struct CompiledLoop<Exact<FiftyDigits, effect_sets::with_standing_stops(Damping::light, Forcing::secular)>>;
template struct CompiledLoop<Exact<FiftyDigits, effect_sets::with_standing_stops(Damping::heavy, Forcing::regular)>>;
template struct CompiledLoop<Exact<FiftyDigits, effect_sets::with_everything(Damping::light, Forcing::secular)>>;
template struct CompiledLoop<Exact<FiftyDigits, effect_sets::with_everything(Damping::heavy, Forcing::regular)>>;

}  // namespace clatter::stepping
