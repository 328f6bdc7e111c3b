#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <utility>

#include "branches/equations/followed_scene.hpp"
#include "branches/equations/orbit.hpp"
#include "motion/relative_arc.hpp"
#include "motion/walls.hpp"
#include "scene/smooth_effects.hpp"

namespace clatter::branches {

/// Calls `function.operator()<E>()` with the effects of the arcs of a main mass: those of any stiffness, which have
/// derivatives by it, too.
template <class Function>
decltype(auto) with_arcs_of_main(const Scene& scene, Function&& function) {
  return with_smooth_effects<true>(oscillator_in_frame(scene), std::forward<Function>(function));
}

/// An impact of a loose mass on a wall of its housing: its phase (rad) and what both masses do before it.
template <class Number>
struct WallImpact {
  Side wall;
  Number phase;
  Number w;      ///< z'
  Number place;  ///< displacement of the main mass less `SceneNumbers::middle`
  Number v;      ///< its velocity
};

[[nodiscard]] inline WallImpact<double> wall_impact(const OrbitEvent& impact) {
  return {impact.side, impact.phase, impact.before, impact.main.place, impact.main.before};
}

/// The flights of a loose mass in its housing at given parameters (eqs. 68 and 70). Arcs refer to it.
template <class Number, Effects E>
class HousingFlights {
 public:
  using Arc = motion::RelativeArc<Number, E>;

  explicit HousingFlights(const SceneNumbers<Number>& parameters) : HousingFlights(parameters, parameters.force()) {}
  HousingFlights(const HousingFlights&) = delete;
  HousingFlights& operator=(const HousingFlights&) = delete;

  [[nodiscard]] const motion::ArcConstants<Number, E>& constants() const { return constants_; }
  [[nodiscard]] const SceneNumbers<Number>& parameters() const { return p_; }
  [[nodiscard]] const Number& wall(Side side) const { return side == Side::upper ? p_.loose.upper : p_.loose.lower; }
  [[nodiscard]] motion::WallRule<Number> rule() const { return motion::WallRule<Number>(p_.loose); }

  /// The motion of the main mass alone from a state on.
  [[nodiscard]] motion::Arc<Number, E> main_from(const Number& phase, const Number& place, const Number& v) const {
    using std::cos, std::sin;
    const Number of_force = phase + lead_, sine = sin(of_force), cosine = cos(of_force), x = p_.middle() + place;
    const Number a = constants_.acceleration(Number(x - constants_.equilibrium), v, sine);
    return {constants_, {Number(0), x, v, a, sine, cosine}};
  }
  /// The flight that begins with an impact.
  [[nodiscard]] Arc after(const WallImpact<Number>& impact) const {
    const Number v = rule().main_after(impact.v, impact.w), w = rule().law(impact.wall).after(impact.w);
    return {main_from(impact.phase, impact.place, v), {wall(impact.wall), Number(0), w, Number(w + v)}, p_.loose.load};
  }
  /// A flight `advance` of the phase after its beginning, beside a wall: z less the place of that, z', and place and
  /// velocity of the main mass. It goes through walls, if it meets any.
  [[nodiscard]] std::array<Number, 4> end(const WallImpact<Number>& from, const Number& phase, Side to) const {
    const Arc arc = after(from);
    const motion::Motion<Number> m = arc.at(Number((phase - from.phase) / p_.oscillator.frequency)),
                                 main = arc.main_at(m);
    const Number beside = to == from.wall ? m.offset : Number((wall(from.wall) - wall(to)) + m.offset);
    return {beside, m.v, main.x - p_.middle(), main.v};
  }

 private:
  HousingFlights(const SceneNumbers<Number>& parameters, const LeadingForce<Number>& force)
      : p_(parameters),
        lead_(force.lead),
        constants_(motion::ArcConstants<Number, E>::of(p_.oscillator.damping, force.amplitude, p_.oscillator.frequency,
                                                       p_.oscillator.load, p_.oscillator.stiffness)) {}

  SceneNumbers<Number> p_;
  Number lead_;
  motion::ArcConstants<Number, E> constants_;
};

}  // namespace clatter::branches
