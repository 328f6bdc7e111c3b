#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {
namespace {

template <Effects E>
using Loop = EventDriven<Exact<double, E>, ExactArcs<double>, double, E>;

constexpr Effects rough_rotating = effect_sets::with_friction(Damping::light, Forcing::secular);
constexpr Effects rough_decaying = effect_sets::with_friction(Damping::heavy, Forcing::regular);

}  // namespace

template Outcome Loop<rough_rotating>::advance_long(Loop<rough_rotating>::State&, const double&, std::int64_t,
                                                    Loop<rough_rotating>::Any&);
template Outcome Loop<rough_decaying>::advance_long(Loop<rough_decaying>::State&, const double&, std::int64_t,
                                                    Loop<rough_decaying>::Any&);

}  // namespace clatter::stepping
