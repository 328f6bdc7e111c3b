#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {
namespace {

template <Effects E>
using Loop = EventDriven<Exact<double, E>, ExactArcs<double>, double, E>;

constexpr Effects rigid_rotating = effect_sets::of_any_stiffness(Damping::light, Forcing::secular);
constexpr Effects rigid_decaying = effect_sets::of_any_stiffness(Damping::heavy, Forcing::regular);
constexpr Effects soft_rotating = effect_sets::with_soft_stops(Damping::light, Forcing::secular);
constexpr Effects soft_in_lanes = effect_sets::with_soft_stops(Damping::light, Forcing::regular);
constexpr Effects soft_decaying = effect_sets::with_soft_stops(Damping::heavy, Forcing::regular);

}  // namespace

template Outcome Loop<rigid_rotating>::advance_long(Loop<rigid_rotating>::State&, const double&, std::int64_t,
                                                    Loop<rigid_rotating>::Any&);
template Outcome Loop<rigid_decaying>::advance_long(Loop<rigid_decaying>::State&, const double&, std::int64_t,
                                                    Loop<rigid_decaying>::Any&);
template Outcome Loop<soft_rotating>::advance_long(Loop<soft_rotating>::State&, const double&, std::int64_t,
                                                   Loop<soft_rotating>::Any&);
template Outcome Loop<soft_in_lanes>::advance_long(Loop<soft_in_lanes>::State&, const double&, std::int64_t,
                                                   Loop<soft_in_lanes>::Any&);
template Outcome Loop<soft_decaying>::advance_long(Loop<soft_decaying>::State&, const double&, std::int64_t,
                                                   Loop<soft_decaying>::Any&);

}  // namespace clatter::stepping
