#pragma once

#include <memory>
#include <vector>

#include "first_crossing.hpp"
#include "followed.hpp"
#include "moving_set.hpp"

namespace verify {

/// A scene that changes with a parameter, and how fast the end of its motion does.
struct Family {
  MovingScene scene;
  Ball end_slope;
};

/// The motion of a set of states from event to event, in proved bounds.
class Motion : public Followed {
 public:
  /// Of all states at most `width` from the start in x and in v.
  Motion(const Scene& scene, const Start& start, const Vector& width);
  /// In a scene whose parameter may have all values of its balls, with derivatives by that parameter.
  Motion(const Scene& scene, const Family& family, const Start& start);

  Event next(const Ball& end) override;
  [[nodiscard]] bool is_clear_until(const Ball& time) const override;
  Event graze(Side side, const Ball& about, const Ball& end) override;
  Event finish_chatter(const ChatterAim& aim) override;
  Event finish_rest(const Ball& end) override;

  [[nodiscard]] bool is_resting() const override { return resting_; }
  [[nodiscard]] bool is_within_stop() const { return mode_ == Mode::contact; }  ///< a soft one
  [[nodiscard]] bool is_sticking() const override { return sticks_; }
  [[nodiscard]] Vector state() const { return set_.hull(); }              ///< x and v at the end
  [[nodiscard]] Vector centre() const { return set_.image_of_centre(); }  ///< x and v at the end of the middle one
  [[nodiscard]] Matrix derivative() const { return set_.derivative(); }   ///< of the state at the end by the start
  [[nodiscard]] Vector by_parameter() const { return set_.by_parameter(); }
  [[nodiscard]] Ball start_time() const { return start_time_; }
  [[nodiscard]] slong turns_of_release() const { return turns_; }  ///< of the last release; equal phases differ by it

  /// The oscillator of the present mode, and what its motion must stay clear of until the next event.
  [[nodiscard]] const Flow& flow() const { return (*flows_)[number_of_flow()]; }
  [[nodiscard]] std::vector<Margin> margins() const;

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
  bool resting_ = false, hits_at_start_ = false;
  Ball rest_begin_, start_time_;
  slong turns_ = 0;
};

}  // namespace verify
