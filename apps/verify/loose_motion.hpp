#pragma once

#include <memory>
#include <vector>

#include "first_crossing.hpp"
#include "followed.hpp"
#include "loose_flight.hpp"
#include "moving_set.hpp"

namespace verify {

/// The motion of a set of states (x, x', z, z') of a main mass and a loose one from event to event, in proved bounds. A
/// loose mass that a wall presses has z at the wall and z' = 0, exactly.
class LooseMotion : public Followed {
 public:
  /// Of all states at most `width` from the start.
  LooseMotion(const Scene& scene, const Start& start, const Four& width);

  Event next(const Ball& end) override;
  [[nodiscard]] bool is_clear_until(const Ball& time) const override;
  Event graze(Side side, const Ball& about, const Ball& end) override;
  Event finish_chatter(const ChatterAim& aim) override;
  /// The time for which a wall presses the loose mass.
  Event finish_rest(const Ball& end) override;

  [[nodiscard]] bool is_resting() const override { return pressed_; }
  [[nodiscard]] bool is_sticking() const override { return false; }
  [[nodiscard]] Side wall() const { return wall_; }                          ///< that was struck, or presses
  [[nodiscard]] Four state() const { return set_.hull(); }                   ///< at the end
  [[nodiscard]] Four centre() const { return set_.image_of_centre(); }       ///< at the end, of the middle one
  [[nodiscard]] FourByFour derivative() const { return set_.derivative(); }  ///< of the state at the end by the start
  /// The acceleration z'' with which the loose mass is driven into the wall that it is on.
  [[nodiscard]] Ball pressing() const;

 private:
  /// The two masses as one (eq. 71), and what moves: the main mass alone, and both.
  struct Flows {
    explicit Flows(const Scene& scene);
    Scene both;
    Flow alone, as_one;
  };
  struct State {
    Ball time, x, v, z, w;
  };
  /// Bounds of all rebounds that follow an impact.
  struct Rebounds {
    Ball time, height;       ///< that they take, and that none exceeds
    Four shift;              ///< of x, v after them beside a motion that the wall presses at once
    FourByFour uncertainty;  ///< of its derivative by (time, x, v, w) at that impact
  };
  class Chatter;

  [[nodiscard]] const Flow& flow() const { return pressed_ ? flows_->as_one : flows_->alone; }
  [[nodiscard]] State state_of(const Four& coordinates) const;
  [[nodiscard]] FlightInHousing in_housing(const Flow::Flight& main, const State& from) const {
    return {main, from.z, from.w, loose_.load};
  }
  [[nodiscard]] std::vector<Margin> margins() const;
  void begin_at_wall(Side side, const Ball& w);
  [[nodiscard]] FourByFour into_flight(const Flow::Instant& start, const Ball& w) const;
  [[nodiscard]] FourByFour over(const Ball& duration) const;
  void move_to_end(const Flow::Flight& main, const Ball& end);
  void require_bounds() const;
  Event strike(const Flow::Flight& main, const FlightInHousing& all, const Margin& margin, const Ball& instant);
  Event hit_at_start();
  void rebound(Side side);
  void rest_or_leave();
  void release(const Flow::Flight& main, const Margin& force, const Ball& instant);
  void press(const Rebounds& left);

  const Scene& scene_;
  const LooseMass& loose_;
  std::shared_ptr<const Flows> flows_;
  FourSet set_;                    ///< (x, x', z, z') at `time_`, or (time, x, x', z') before the event on a surface
  bool on_surface_ = false;        ///< z is that of `wall_`
  Ball time_, kick_{0}, turn_{1};  ///< on the surface of an impact x' grows by kick z', and z' is multiplied by turn
  Side wall_ = Side::lower;
  int vanishing_ = 0;  ///< `Margin::vanishing` of that wall
  bool pressed_ = false, hits_at_start_ = false;
  Ball press_begin_;
};

}  // namespace verify
