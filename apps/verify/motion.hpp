#pragma once

#include <memory>
#include <vector>

#include "first_crossing.hpp"
#include "moving_set.hpp"

namespace verify {

enum class Kind { impact, touch, separation, renewal, graze, reversal, chatter, rest, stick, end };

[[nodiscard]] const char* name_of(Kind kind);

/// The derivative of an event's velocity by the state at the start and by the parameter.
struct Slopes {
  Ball by_x, by_v, by_parameter;
};

/// Something that happens to all motions of a set.
struct Event {
  Kind kind = Kind::end;
  Side side = Side::lower;
  Ball time, v;  ///< v: before an impact
  Ball until;    ///< of a chatter, a rest or a stick
  Ball gap{};    ///< of a graze: the least that is left to the stop, or of its force; below 0 the motion passes through
  Slopes slopes{};
  Ball x{};  ///< of a reversal or a stick: the place
};

[[nodiscard]] inline bool is_of_friction(Kind kind) { return kind == Kind::reversal || kind == Kind::stick; }

/// The state that a motion starts from.
struct Start {
  Ball time;
  Ball x, v;
  bool released = false;  ///< by a stop, at the phase nearest to `time` at which the force that presses falls to 0
  Side side = Side::lower;
};

/// A scene that changes with a parameter, and how fast the end of its motion does.
struct Family {
  MovingScene scene;
  Ball end_slope;
};

/// The motion of a set of states from event to event, in proved bounds.
class Motion {
 public:
  /// Of all states at most `width` from the start in x and in v.
  Motion(const Scene& scene, const Start& start, const Vector& width);
  /// In a scene whose parameter may have all values of its balls, with derivatives by that parameter.
  Motion(const Scene& scene, const Family& family, const Start& start);

  /// The next event before a time, or the end there.
  Event next(const Ball& end);
  /// Whether no event is before a time, or at it.
  [[nodiscard]] bool is_clear_until(const Ball& time) const;
  /// Passes the place near a time at which the motion turns without meeting a stop, or a soft stop's force turns
  /// without falling to 0, or at which it is taken to do so: that margin is believed there.
  Event graze(Side side, const Ball& about, const Ball& end);
  /// The end of the chatter that the last impact began, told to this accuracy; or, if there is none that ends before a
  /// time, an event that shows it. Throws Undecided if neither is proved.
  /// Its flights are followed until the others stay within so much of the stop.
  Event finish_chatter(double accuracy, const Ball& latest, double height);
  /// The rest that begins now, up to its release or to a time.
  Event finish_rest(const Ball& end);

  [[nodiscard]] bool is_resting() const { return resting_; }
  [[nodiscard]] bool is_sticking() const { return sticks_; }              ///< up to the end
  [[nodiscard]] Vector state() const { return set_.hull(); }              ///< x and v at the end
  [[nodiscard]] Vector centre() const { return set_.image_of_centre(); }  ///< x and v at the end of the middle one
  [[nodiscard]] Matrix derivative() const { return set_.derivative(); }   ///< of the state at the end by the start
  [[nodiscard]] Vector by_parameter() const { return set_.by_parameter(); }
  [[nodiscard]] Ball start_time() const { return start_time_; }
  [[nodiscard]] slong turns_of_release() const { return turns_; }  ///< of the last release; equal phases differ by it
  [[nodiscard]] bool was_exact() const { return was_exact_; }      ///< a rest has wiped out what was before

  /// The oscillator of the present mode, and what its motion must stay clear of until the next event.
  [[nodiscard]] const Flow& flow() const { return (*flows_)[number_of_flow()]; }
  [[nodiscard]] std::vector<Margin> margins() const;

  /// A stretch of motion without an event, for those who look into it.
  struct Stretch {
    Flow::Flight flight;
    Ball length;
  };
  [[nodiscard]] const std::vector<Stretch>& stretches() const { return stretches_; }
  /// Displacements that hold those of the flights of chatters that aren't followed.
  [[nodiscard]] const std::vector<Ball>& other_places() const { return other_places_; }

 private:
  enum class Mode { free, contact, beyond };
  struct State {
    Ball time, x, v;
  };

  [[nodiscard]] std::size_t number_of_flow() const {
    return (mode_ == Mode::contact ? 1 + index_of(side_) : 0) + (heading_ > 0 ? 3 : 0);
  }
  void begin_at(const Start& start, const Vector& width);
  void begin_rough(const Start& start);
  void become_still(const Ball& time);
  struct Spring {
    Ball k, load;
  };
  [[nodiscard]] Spring spring() const;
  [[nodiscard]] int way_of_push() const;
  [[nodiscard]] std::vector<Margin> rough_margins() const;
  Event stop_moving(const Flow::Flight& all, const Ball& instant, const Margin& margin, const Ball& end);
  Event stay(const Ball& end);
  void rebound(Side side, const Ball& time);
  [[nodiscard]] State state_of(const Vector& coordinates) const;
  [[nodiscard]] Matrix into_flight(const Flow::Instant& start) const;
  Event hit_at_start();
  /// The derivative by the parameter after a time in flight, at an instant that moves with this slope.
  [[nodiscard]] Vector by_parameter_after(const Ball& duration, const Ball& slope) const;
  void move_to_end(const Flow::Flight& all, const Ball& end, const Ball& slope);
  Event move_to_event(const Flow::Flight& all, const Margin& margin, const Ball& between, std::size_t index);
  Event pass(std::size_t margin, Side side);
  void begin(Mode mode, Side side, int vanishing) { mode_ = mode, side_ = side, vanishing_ = vanishing; }
  void start_on_stop(const Start& start);
  void release(Side side, const Ball& after, bool nearest);
  struct Rebounds {
    Ball time, height;  ///< that they take, and that none exceeds
  };
  [[nodiscard]] Rebounds rebounds(Side side, const Ball& time, const Ball& w) const;

  const Scene& scene_;
  const Family* family_ = nullptr;
  std::shared_ptr<const std::vector<Flow>> flows_;  ///< free, in contact with the lower stop, with the upper one; with
                                                    ///< friction of slips down, then the same of slips up
  std::shared_ptr<const std::vector<BasicFlow<Dual>>> moving_flows_;  ///< likewise, of a family
  MovingSet set_;  ///< in (x, v) at `time_`, or in (time, v) on the surface of an event
  bool on_surface_ = false;
  bool still_ = false;                 ///< that surface is x' = 0, with the coordinates (time, x)
  int heading_ = 0;                    ///< with friction: the sign of the velocity
  int still_for_ = 0;                  ///< `Margin::vanishing` of the velocity
  bool sticks_ = false;                ///< friction holds the mass
  Dual time_, place_, q_, factor_{1};  ///< surface: x + q v = place; then the velocity is multiplied by the factor
  Mode mode_ = Mode::free;
  Side side_ = Side::lower;  ///< of the stop of the mode, or that was left
  int vanishing_ = 0;        ///< `Margin::vanishing` of the margin that the last event crossed
  bool resting_ = false, was_exact_ = false, hits_at_start_ = false;
  Ball rest_begin_, start_time_;
  slong turns_ = 0;
  std::vector<Stretch> stretches_;
  std::vector<Ball> other_places_;
};

}  // namespace verify
