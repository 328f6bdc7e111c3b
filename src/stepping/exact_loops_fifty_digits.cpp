#include "math/fifty_digits.hpp"
#include "stepping/exact.hpp"
#include "stepping/long_loop.hpp"

namespace clatter::stepping {
namespace {

template <Effects E>
using Loop = EventDriven<Exact<FiftyDigits, E>, ExactArcs<FiftyDigits>, FiftyDigits, E>;

constexpr Effects one_rotating = effect_sets::with_standing_stops(Damping::light, Forcing::secular);
constexpr Effects one_decaying = effect_sets::with_standing_stops(Damping::heavy, Forcing::regular);
constexpr Effects both_rotating = effect_sets::with_everything(Damping::light, Forcing::secular);
constexpr Effects both_decaying = effect_sets::with_everything(Damping::heavy, Forcing::regular);

}  // namespace

template Outcome Loop<one_rotating>::advance_long(Loop<one_rotating>::State&, const FiftyDigits&, std::int64_t,
                                                  Loop<one_rotating>::Any&);
template Outcome Loop<one_decaying>::advance_long(Loop<one_decaying>::State&, const FiftyDigits&, std::int64_t,
                                                  Loop<one_decaying>::Any&);
template Outcome Loop<both_rotating>::advance_long(Loop<both_rotating>::State&, const FiftyDigits&, std::int64_t,
                                                   Loop<both_rotating>::Any&);
template Outcome Loop<both_decaying>::advance_long(Loop<both_decaying>::State&, const FiftyDigits&, std::int64_t,
                                                   Loop<both_decaying>::Any&);

}  // namespace clatter::stepping
