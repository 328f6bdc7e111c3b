#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {
namespace {

template <Effects E>
using Loop = EventDriven<Exact<double, E>, ExactArcs<double>, double, E>;

constexpr Effects both_rotating = effect_sets::with_everything(Damping::light, Forcing::secular);
constexpr Effects both_decaying = effect_sets::with_everything(Damping::heavy, Forcing::regular);

}  // namespace

template Outcome Loop<both_rotating>::advance_long(Loop<both_rotating>::State&, const double&, std::int64_t,
                                                   Loop<both_rotating>::Any&);
template Outcome Loop<both_decaying>::advance_long(Loop<both_decaying>::State&, const double&, std::int64_t,
                                                   Loop<both_decaying>::Any&);

}  // namespace clatter::stepping
