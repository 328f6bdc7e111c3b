#pragma once

#include <memory>
#include <optional>
#include <vector>

#include "event.hpp"
#include "first_crossing.hpp"
#include "moving_set.hpp"
#include "release.hpp"

namespace verify {

/// A scene that changes with a parameter, and how fast the end of its motion does.
struct Family {
  MovingScene scene;
  Ball end_slope;
};

/// The motion of a set of states (x, x', z, z') from event to event, in proved bounds. The main mass is free, in
/// contact with a soft stop or beyond one, held by a stop or by friction; a loose mass flies in its housing, or a wall
/// presses it. Without a loose mass z and z' are 0, exactly; of one that a wall presses they are z of the wall and 0.
class Motion {
 public:
  /// Of all states at most `width` from the start.
  Motion(const Scene& scene, const Start& start, const Four& width);
  /// In a scene whose parameter may have all values of its balls, with derivatives by that parameter.
  Motion(const Scene& scene, const Family& family, const Start& start);

  /// The next event before a time, or the end there, at which the motion stays.
  Event next(const Ball& end);
  /// Whether no event is before a time, or at it.
  [[nodiscard]] bool is_clear_until(const Ball& time) const;
  /// Passes the place near a time at which the motion turns without meeting a stop, or a soft stop's force turns
  /// without falling to 0, or at which it is taken to do so: that margin is believed there.
  Event graze(Side side, const Ball& about, const Ball& end);
  /// The end of the chatter that the last impact began; or, if none ends in time, an event that shows it, or the end of
  /// the motion. Throws Undecided if neither is proved.
  Event finish_chatter(const ChatterAim& aim);
  /// The rest or the press that begins now, up to its release, an event of the main mass or a time.
  Event finish_rest(const Ball& end);

  /// Whether a stop holds the main mass, or a wall presses the loose one: what comes next is the end of that.
  [[nodiscard]] bool is_resting() const { return (resting_ || pressed_) && !due_ && !hits_at_start_; }
  [[nodiscard]] bool is_sticking() const { return sticks_; }
  /// Whether the motion has come to its end, after which nothing happens.
  [[nodiscard]] bool is_at_end() const { return at_end_; }
  [[nodiscard]] bool is_within_stop() const { return mode_ == Mode::contact; }  ///< a soft one
  [[nodiscard]] bool has_loose_mass() const { return scene_.loose.has_value(); }
  /// The wall that presses a loose mass.
  [[nodiscard]] std::optional<Side> pressed_by() const {
    return pressed_ && on_wall_ ? std::optional(wall_) : std::nullopt;
  }
  /// Whether a wall, or friction, makes the loose mass move with the main one.
  [[nodiscard]] bool is_carrying() const { return pressed_; }
  /// How much the wall that the loose mass is on can press with, and hold by friction, until it would have to pull, as
  /// an acceleration.
  [[nodiscard]] Ball pressing() const { return hold_left(sign_of(wall_)); }

  [[nodiscard]] Four state() const { return set_.hull(); }                   ///< at the end
  [[nodiscard]] Four centre() const { return set_.image_of_centre(); }       ///< at the end, of the middle one
  [[nodiscard]] FourByFour derivative() const { return set_.derivative(); }  ///< of the state at the end by the start
  [[nodiscard]] Four by_parameter() const { return set_.by_parameter(); }
  [[nodiscard]] Ball start_time() const { return start_time_; }
  /// The last release of a stop.
  [[nodiscard]] const PhaseOfRelease& release() const { return release_; }

  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
  /// Places at which the mass was held, and displacements that hold those of the flights of chatters that aren't
  /// followed.
  [[nodiscard]] const std::vector<Ball>& other_places() const { return other_places_; }

  /// The oscillator of the present mode, and what its motion must stay clear of until the next event.
  [[nodiscard]] const Flow& flow() const {
    if (resting_ || sticks_) return flows_->held;
    return pressed_ ? flows_->as_one[number_of_flow()] : alone();
  }
  [[nodiscard]] std::vector<Margin> margins() const;

 private:
  enum class Mode { free, contact, beyond };
  struct State {
    Ball time;
    Four y;  ///< x, x', z, z'
  };
  /// Free, in contact with the lower stop, with the upper one; with friction of slips down, then the same of slips up.
  /// Those of the main mass alone are then given for slides of the loose one down, and for slides up.
  struct Flows {
    explicit Flows(const Scene& scene);
    std::optional<Scene> both{};  ///< of both masses as one, while a wall presses the loose one (eq. 71)
    std::vector<Scene> drawn{};   ///< beside a loose mass that slides down, or up: its friction is a load (eq. 80)
    std::vector<Flow> alone, as_one;
    Flow held;  ///< of a main mass that stays where it is
  };
  struct Spring {
    Ball k, load;
  };
  /// Bounds of all rebounds that follow an impact.
  struct Rebounds {
    Ball time, height;                            ///< that they take, and that none exceeds
    Four shift = Four::zero();                    ///< in a housing: of x, v beside a motion pressed at once,
    FourByFour uncertainty = FourByFour::zero();  ///< and of its derivative by the coordinates of that impact
  };
  class ChatterInHousing;

  [[nodiscard]] std::size_t number_of_flow() const {
    return (mode_ == Mode::contact ? 1 + index_of(side_) : 0) + (heading_ > 0 ? 3 : 0);
  }
  [[nodiscard]] const Flow& alone() const {
    return flows_->alone[number_of_flow() + (slide_ > 0 ? flows_->alone.size() / 2 : 0)];
  }
  [[nodiscard]] const Scene& acting() const {
    return pressed_ ? *flows_->both : slide_ != 0 ? flows_->drawn[slide_ > 0 ? 1 : 0] : scene_;
  }
  /// Whether a loose mass rubs on its housing.
  [[nodiscard]] bool rubs() const { return scene_.loose && scene_.loose->is_rough(); }
  [[nodiscard]] Ball loose_load() const;
  void begin_at(const Start& start, const Four& width);
  void start_on_stop(const Start& start);
  void start_in_housing();
  void begin(Mode mode, Side side, int vanishing) { mode_ = mode, side_ = side, vanishing_ = vanishing; }

  // The coordinates of the set, and flights of its states.
  [[nodiscard]] State state_of(const Four& coordinates) const;
  [[nodiscard]] MachineFlight flight_from(const State& state) const;
  [[nodiscard]] Four state_at(const Moment& moment) const;
  [[nodiscard]] Four rates_at(const Moment& moment) const;
  [[nodiscard]] FourByFour into_flight(const Moment& start) const;
  [[nodiscard]] FourByFour over(const Ball& duration) const;
  [[nodiscard]] Four by_parameter_after(const Ball& duration, const Ball& slope) const;
  void require_bounds() const;
  void require_inside(const MachineFlight& all, const std::vector<Margin>& list) const;

  // Events.
  Event fly(const Ball& end);
  void move_to_end(const MachineFlight& all, const Ball& end, const Ball& slope);
  void move_to_surface(const MachineFlight& all, const Margin& margin, const Ball& instant);
  Event pass(std::size_t index, const Margin& margin);
  Event hit_at_start();

  // Of the main mass: rest.cpp, friction.cpp.
  void rebound(Side side, const Ball& time);
  [[nodiscard]] std::optional<Dual> time_of_release(Side side, const Ball& after, bool nearest);
  void let_main_go(Side side);
  void collapse_on(Side side);
  void start_with_release(const Start& start);
  bool strikes_before(const Ball& time);
  /// Bounds of the acceleration towards a stop.
  struct Pull {
    Ball least, most;
  };
  [[nodiscard]] Ball press_of(Side side, const Ball& time) const;
  [[nodiscard]] Pull pull_in(Side side, const Ball& window, const Ball& height, const Ball& fastest) const;
  void require_far_off(Side side, const Ball& height) const;
  [[nodiscard]] Rebounds rebounds(Side side, const Ball& time, const Ball& w) const;
  [[nodiscard]] Rebounds slowing_rebounds(Side side, const Ball& time, const Ball& w) const;
  void require_off_walls(const Rebounds& left) const;
  Event finish_chatter_on_stop(const ChatterAim& aim);
  Event finish_rest_on_stop(const Ball& end);
  void begin_rough(const Start& start);
  void become_still(const Ball& time);
  [[nodiscard]] Spring spring() const;
  [[nodiscard]] int way_of_push() const;
  [[nodiscard]] std::vector<Margin> rough_margins() const;
  struct Release {
    int way;
    Ball time, slope;  ///< by the place
  };
  [[nodiscard]] std::optional<Release> release_to(int way, const Ball& time, const Ball& x) const;
  Event stop_moving(const Ball& end);
  Event stay(const Ball& end);
  void move_to_release(const Release& all);

  // Of the loose one: press.cpp.
  Event strike(Side side);
  void add_loose_margins(std::vector<Margin>& list) const;
  [[nodiscard]] Ball hold_left(int sign) const;
  [[nodiscard]] int way_in_housing() const;
  void slide_to(int way, int wall_vanishing, int still_for);
  void press_or_leave();
  void press_on();
  void shake(const Event& event);
  Event stop_in_housing(const Ball& end);
  Event let_go(int sign);
  Event finish_chatter_in_housing(const ChatterAim& aim);
  void press_at_last(const Rebounds& left);
  Event finish_press(const Ball& end);

  const Scene& scene_;
  const Family* family_ = nullptr;
  std::shared_ptr<const Flows> flows_;
  std::shared_ptr<const std::vector<BasicFlow<Dual>>> moving_flows_;  ///< likewise, of a family
  MovingSet set_;  ///< in (x, x', z, z') at `time_`, or before the event on a surface with the time in place of one
  std::optional<std::size_t> surface_{};  ///< which: 0: x + q x' = place, 1: x' = 0, 2: z is that of a wall, 3: z' = 0
  Dual time_, place_, q_;
  Rebound main_{};   ///< what the event does to x', while y' goes on,
  Rebound loose_{};  ///< or to z', while the common centre goes on
  Mode mode_ = Mode::free;
  Side side_ = Side::lower;                     ///< of the stop of the mode, or that was left
  int vanishing_ = 0;                           ///< `Margin::vanishing` of the margin that the last event crossed
  int heading_ = 0;                             ///< with friction: the sign of the velocity
  int still_for_ = 0;                           ///< `Margin::vanishing` of the velocity
  bool sticks_ = false;                         ///< friction holds the mass
  bool resting_ = false;                        ///< a stop does
  Side wall_ = Side::lower;                     ///< that the loose mass has struck, or that presses it
  int loose_vanishing_ = 0;                     ///< `Margin::vanishing` of that wall
  bool pressed_ = false;                        ///< it does, or friction holds the loose mass: both move as one
  bool on_wall_ = true;                         ///< of a pressed one; else friction alone holds it
  int slide_ = 0;                               ///< with friction in the housing: the sign of z'
  int loose_still_for_ = 0;                     ///< `Margin::vanishing` of z'
  std::optional<std::size_t> hits_at_start_{};  ///< what the start moves into: a stop, 0, or a wall, 2
  std::optional<Event> due_{};                  ///< the event that ended a press
  Ball rest_begin_, press_begin_, start_time_;
  PhaseOfRelease release_{};
  std::vector<Stretch> stretches_{};
  std::vector<Ball> other_places_{};
  bool at_end_ = false;
};

}  // namespace verify
