#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include "branches/equations/flight.hpp"
#include "branches/equations/linear_system.hpp"
#include "branches/equations/orbit.hpp"

namespace clatter::branches {

/// An equation that singles out a special point on a branch, or a curve of them if two parameters vary.
struct Condition {
  enum class Kind : std::uint8_t {
    multiplier,    ///< a multiplier of the orbit as it is kept is `multiplier`, +1 or -1
    unit_product,  ///< of a loose mass: two multipliers, a complex pair, have the product 1
    graze,         ///< event number `event`, an impact or one on a soft stop, has no speed
    force,         ///< a soft stop's force, zero at event number `event`, doesn't change there
    duration,      ///< the flight from event number `event` on lasts `amount`
    level,         ///< at event number `event`, a halt, the other forces are at the static level of friction
    kinetic,       ///< there they are at the kinetic level
    tangency,      ///< at the place of that halt they only just come to the static level
    on_stop,       ///< the place of that halt is that of a stop, or `amount` beyond it
    release  ///< the force on the mass is zero at the impact, event number `event`, after which it may rest if R = 0
  };
  Kind kind = Kind::multiplier;
  int multiplier = 1;
  std::size_t event = 0;
  std::optional<std::size_t> without{};  ///< the multiplier is that of the orbit without this event, which grazes
  double amount = 0.0;                   ///< of phase, rad, in a duration; beyond a soft stop, or less than 0 before it
  Side side = Side::none;                ///< to which the other forces push the halting mass; that stop

  [[nodiscard]] bool is_of_halt() const {
    return kind == Kind::level || kind == Kind::kinetic || kind == Kind::tangency || kind == Kind::on_stop;
  }
};

/// The equations of periodic motion with given events (multiple shooting over arcs): every flight ends on the stop of
/// the next event, with its velocity, or halts in its place. Unknowns are phase and velocity of each event, or phase
/// and place of each halt, with a loose mass also place and velocity of the other one of the two masses; then one or
/// two parameters, in units of the speed and the widths that the constructor is given. Motion through stops solves
/// them, too: `violation` says whether a flight meets a stop before its end.
class OrbitEquations {
 public:
  /// One parameter, or two, in the user's units; its unit here is the width of its range.
  struct Axis {
    Parameter parameter;
    double unit = 1.0;
  };

  OrbitEquations(const FollowedScene& scene, const Orbit& shape, std::vector<Axis> axes, double speed_unit,
                 std::vector<Condition> conditions = {});

  [[nodiscard]] std::size_t equations() const { return first_axis() + conditions_.size(); }
  [[nodiscard]] std::size_t unknowns() const { return first_axis() + axes_.size(); }
  /// The number of the unknown that is an event's phase; after it come those beside it.
  [[nodiscard]] std::size_t phase_of(std::size_t event) const { return per_event_ * event; }
  /// The number of the unknown that is the first parameter.
  [[nodiscard]] std::size_t first_axis() const { return per_event_ * shape_.size(); }

  /// Residuals and their derivatives by the unknowns, [equation][unknown].
  struct Linearised {
    Vector residual;
    Matrix slope;
  };
  /// Nothing if two events have changed places, or the scene has no positive frequency, or stops in the wrong order.
  [[nodiscard]] std::optional<Linearised> at(const Vector& unknowns) const;

  [[nodiscard]] Vector unknowns_of(const FollowedScene& scene, const Orbit& orbit) const;
  [[nodiscard]] Orbit orbit_at(const Vector& unknowns) const;
  [[nodiscard]] FollowedScene scene_at(const Vector& unknowns) const;

  [[nodiscard]] const FollowedScene& scene() const { return scene_; }
  [[nodiscard]] const Orbit& shape() const { return shape_; }
  [[nodiscard]] const std::vector<Axis>& axes() const { return axes_; }
  /// Whether the stiffness of the spring, per unit mass, is one of what varies, or changes with it.
  [[nodiscard]] bool stiffness_varies() const { return stiffness_varies_; }
  [[nodiscard]] double speed_unit() const { return speed_unit_; }
  [[nodiscard]] const std::vector<Condition>& conditions() const { return conditions_; }
  /// The event that grazes by a condition, if there is one: a halt on the position of a stop does.
  [[nodiscard]] std::optional<std::size_t> grazing() const;
  /// Whether that event is the touch of a stop without speed.
  [[nodiscard]] bool grazes_outside() const;
  /// Whether a condition makes the release of a stick one at the crest of the push, where the formula of it is
  /// singular.
  [[nodiscard]] bool is_released_at_crest(std::size_t halt) const;

 private:
  /// The flights of two masses, and the equation of one of their multipliers.
  void add_flights_in_housing(const FollowedScene& scene, const Orbit& orbit, Linearised& out) const;
  /// Motion that may be anywhere comes back to where it begins by its other equations: it begins where the shape does.
  void stay_in_place(const Orbit& orbit, Linearised& out) const;
  void add_multiplier_in_housing(const FollowedScene& scene, const Orbit& orbit, const Condition& condition,
                                 std::size_t row, Linearised& out) const;
  void add_unit_product(const Vector& unknowns, std::size_t row, Linearised& out) const;
  void add_multiplier(const FollowedScene& scene, const Orbit& all, const Condition& condition, std::size_t row,
                      Linearised& out) const;
  void add_condition(const FollowedScene& scene, const Orbit& orbit, const Condition& condition, std::size_t row,
                     Linearised& out) const;

  FollowedScene scene_;
  Orbit shape_;
  std::vector<Axis> axes_;
  double speed_unit_;
  std::vector<Condition> conditions_;
  bool stiffness_varies_, is_in_housing_;
  std::size_t per_event_;  ///< unknowns
};

/// The derivative of the map of one impact to the same impact a period, or half a period, later (its phase and
/// velocity): an impact that grazes has an infinite one, so its denominators are kept apart. Of motion that meets soft
/// stops it is that of the map of states just before the first event (displacement and velocity), which is finite in
/// a graze of a soft stop: it has denominators at rigid stops alone.
struct ImpactMap {
  double denominator = 1.0;                           ///< product of velocity over nu at all impacts
  double numerator[2][2] = {{1.0, 0.0}, {0.0, 1.0}};  ///< [phase, velocity][phase, velocity]
  double determinant = 1.0;                           ///< of the map itself, by `determinant_of`

  [[nodiscard]] double trace() const { return (numerator[0][0] + numerator[1][1]) / denominator; }
  /// Zero if `multiplier`, +1 or -1, is a multiplier; finite in a graze.
  [[nodiscard]] double distance_to(int multiplier) const {
    return denominator * (1 + determinant) - multiplier * (numerator[0][0] + numerator[1][1]);
  }
};
[[nodiscard]] ImpactMap impact_map(const FollowedScene& scene, const Orbit& orbit);
/// In phase and velocity of the first event, at soft stops, too.
[[nodiscard]] ImpactMap event_map(const FollowedScene& scene, const Orbit& orbit);

/// The unit direction from a flip, or a loss of symmetry, into the motion that is born there, which passes the one
/// before twice: along the eigenvector of multiplier -1. In the equations' units, with this one of speeds.
[[nodiscard]] Vector direction_of_daughter(const FollowedScene& scene, const Orbit& orbit, const Orbit& daughter,
                                           double speed_unit);

/// [event i][phase, velocity]: how a small change of the first event spreads over the others.
[[nodiscard]] std::vector<std::array<double, 2>> spread(const FollowedScene& scene, const Orbit& orbit,
                                                        std::array<double, 2> change);

}  // namespace clatter::branches
