#pragma once

#include <array>
#include <complex>
#include <cstdint>
#include <optional>
#include <vector>

#include "lanes/block_state.hpp"
#include "lanes/instruction_set.hpp"
#include "lanes/lane_effects.hpp"
#include "motion/arc_constants.hpp"
#include "motion/state.hpp"
#include "observables/all.hpp"
#include "observables/extremes/range.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/scene.hpp"

namespace clatter::lanes {

/// The displacement and velocity of a lane at a forcing phase, in turns since the last stroboscopic section, and its
/// place at a soft stop (`motion::State`).
struct LaneState {
  double x, v, phase_turns;
  Side within = Side::none;
  bool pressed = false;
  double offset = 0.0;
};

/// A stroboscopic section that a lane has passed.
struct LaneSection {
  double x, v;
  double impacts;           ///< met by the lane up to here
  std::uint64_t itinerary;  ///< the same for the same stops in the same order since the last section, 0 for none
  double log_area;          ///< logarithm of the factor by which soft stops have shrunk areas of states since then
};

/// A section as the lane reports it: its displacement from the load's equilibrium, its itinerary as a number.
struct LaneReport {
  double y, v, impacts, itinerary, log_area;
};

struct Observed;

/// Whether a scene can run in a lane: forced motion between stops, lightly damped, away from resonance, with lengths
/// and frequencies that leave an enclosure room; without a spring it must be bounded. Soft stops stand beside a spring.
[[nodiscard]] bool accepts(const Scene& scene);

/// Advances every lane: to its next contact, past the next section, or by a few steps, whichever comes first.
using StepFunction = void (*)(BlockState&);

/// The step functions of one instruction set, plain and, but for soft stops, with observers.
struct StepFunctions {
  StepFunction plain, observed;
};

/// The step functions for an instruction set that this machine has, not scalar, and the effects of lanes.
template <Effects E = sprung>
[[nodiscard]] StepFunctions step_functions_of(InstructionSet arch);

/// Clears a lane: it stands still and reports nothing.
void clear_lane(BlockState& block, std::size_t lane);

/// A lane in the units of its scene. It alone knows the rows of a block, the lane's unit of time, and that lanes count
/// displacements from the load's equilibrium.
class LaneView {
 public:
  template <Effects E = sprung>
  using Constants = motion::ArcConstants<double, E.arc()>;

  LaneView(BlockState& block, std::size_t lane, const Scene& scene) : block_(&block), lane_(lane), scene_(&scene) {}

  /// Loads the scene at its start, with the constants of its arcs and the stops that it may meet.
  template <Effects arcs>
  void load(const motion::ArcConstants<double, arcs>& constants, const Stops& stops);
  [[nodiscard]] LaneState state() const;
  /// Sets the state, so many sections being passed before the next one that is reported.
  void set_state(const LaneState& state, double sections_between);
  /// Sections that the lane passes before the next one that it reports.
  [[nodiscard]] double sections_between() const;
  [[nodiscard]] double impacts() const { return at(block_->impacts); }  ///< met since the lane was loaded
  /// Numbers that no motion leaves as they are: a mark of its present instant.
  [[nodiscard]] std::array<double, 3> mark() const {
    return {at(block_->free_x), at(block_->free_v), at(block_->sine)};
  }
  [[nodiscard]] double turns_of_two_steps() const { return 2 * at(block_->step) / at(block_->period); }

  /// The section that the lane has passed.
  [[nodiscard]] LaneReport report() const {
    return {at(block_->section_y), at(block_->section_v), at(block_->section_impacts), at(block_->section_itinerary),
            at(block_->cushioned.section_log_area)};
  }
  [[nodiscard]] LaneSection section_of(const LaneReport& report) const;
  [[nodiscard]] LaneSection section() const { return section_of(report()); }
  /// Its state there, from the load's equilibrium.
  [[nodiscard]] PhaseState section_from_load() const;
  /// Replaces its state there, given from the load's equilibrium.
  void set_section(double y, double v);
  /// Passes and reports a section for the lane; returns the number of sections between it and the next report.
  [[nodiscard]] double pass_section(double x, double v);

  /// Begins to observe.
  void begin_observing(const observables::Observe& observe);
  /// Says, at a report, whether the next one ends the observation, and whether the lane has to stop short of it or may
  /// overshoot, and how many periods after it the one after that is due.
  void expect_section(bool ends, bool stop_short, std::int64_t periods_after);
  /// Notes a stop that the scalar loop has met, and the areas that a soft one has shrunk there.
  void add_to_itinerary(Side side);
  void add_to_log_area(double part) { at(block_->cushioned.log_area) += part; }
  /// Adds what the scalar loop has observed.
  void include(const Observed& observed);
  [[nodiscard]] std::size_t highest_harmonic() const { return block_->harmonics; }  ///< that is summed

  /// Whether the extrema seen so far hold all motion that is the response plus a transient up to this size.
  [[nodiscard]] bool extrema_hold(double transient) const;
  /// The ranges of displacement and velocity seen so far.
  [[nodiscard]] observables::Range x_range() const;
  [[nodiscard]] observables::Range v_range() const;
  [[nodiscard]] std::array<observables::Impacts::OfStop, 2> stops() const;  ///< [stop]
  [[nodiscard]] double first_speed() const;  ///< of the first impact on either stop; NaN without one
  [[nodiscard]] std::vector<std::complex<double>> velocity_jumps() const;  ///< [harmonic], eq. 38

 private:
  [[nodiscard]] double& at(LaneArray& row) const { return row.lane[lane_]; }
  [[nodiscard]] bool is_cushioned() const { return at(block_->cushioned.k) > 0; }  ///< among soft stops
  [[nodiscard]] double x_of(double y) const;
  [[nodiscard]] double y_of(double x) const;
  [[nodiscard]] double acceleration(double y, double v, double sine) const;
  template <Effects arcs>
  void load_arc(const motion::ArcConstants<double, arcs>& constants, const Stops& stops);
  template <Effects arcs>
  void load_unsprung(const motion::ArcConstants<double, arcs>& constants, double step);
  void load_phases(const Constants<cushioned>& between, const Stops& stops);
  void load_phase(std::size_t phase, const Constants<cushioned>& constants, const Stops& bounds);
  template <Effects arcs>
  void set_bounds(const motion::ArcConstants<double, arcs>& constants, const Stops& stops, double step);
  [[nodiscard]] double enter_phase(const LaneState& state);

  BlockState* block_;
  std::size_t lane_;
  const Scene* scene_;
};

}  // namespace clatter::lanes
