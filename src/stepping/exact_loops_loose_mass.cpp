#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {
namespace {

template <Effects E>
using Loop = EventDriven<Exact<double, E>, ExactArcs<double>, double, E>;

constexpr Effects loose_rotating = effect_sets::with_loose_mass(Damping::light, Forcing::secular);
constexpr Effects loose_decaying = effect_sets::with_loose_mass(Damping::heavy, Forcing::regular);

}  // namespace

template Outcome Loop<loose_rotating>::advance_long(Loop<loose_rotating>::State&, const double&, std::int64_t,
                                                    Loop<loose_rotating>::Any&);
template Outcome Loop<loose_decaying>::advance_long(Loop<loose_decaying>::State&, const double&, std::int64_t,
                                                    Loop<loose_decaying>::Any&);

}  // namespace clatter::stepping
