#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "motion/walls.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/housing_map.hpp"
#include "steady/loose_escape.hpp"
#include "steady/loose_standstill.hpp"
#include "steady/observed_time.hpp"
#include "steady/passage_observer.hpp"
#include "steady/repeat.hpp"
#include "steady/time_settings.hpp"
#include "stepping/run.hpp"

namespace clatter::steady {

/// Finds the steady state of motion with a loose mass, section by section: by Newton's method once successive states
/// contract, else by repetition of its displacement and velocity, and the place of the loose mass in its housing with
/// z'; without a force by the standstill at which all motion ends that loses energy.
template <stepping::Integrator I>
class HousingSearch {
 public:
  /// Repeats count from the stroboscopic section `from` on.
  HousingSearch(I& integrator, const Scene& scene, const TimeSettings& time, bool by_newton, std::int64_t from)
      : integrator_(integrator),
        scene_(scene),
        time_(time),
        by_newton_(by_newton),
        from_(from),
        beyond_contact_(scene, integrator.period()),
        repeat_(time.tolerance),
        watch_(passage_observer(integrator, scene)),
        map_(integrator, scene, time.tolerance) {
    if (scene.oscillator.forcing == 0) standstill_.emplace(scene, time);
  }

  /// Runs from `state`, at a section, until the steady state is known.
  [[nodiscard]] ObservedTime run(motion::State<double> state) {
    const SineCosine<double> phase = integrator_.phase(motion::State<double>{});
    for (;; ++section_) {
      recent_[place_of(section_) % recent_.size()] = state;
      if (standstill_)
        if (auto found = standstill_->from(state, settled(), by_newton_)) return std::move(*found);
      if (section_ >= from_ && !(standstill_ && standstill_->is_due()))
        if (const std::size_t n = repeats(state)) return repetition(n);
      if (loose_mass_escapes(scene_, state, phase) || both_escape(scene_, state)) return escape(state, simulated());
      if (section_ == time_.max_periods)
        return {Status::aperiodic, state, static_cast<double>(time_.window), simulated(), FoundBy::nothing};
      if (by_newton_ && !standstill_)
        if (auto found = attractor(state)) return std::move(*found);
      watch_.begin_section();
      const stepping::Outcome outcome = advance_to_section(integrator_, state, state.periods, watch_);
      if (outcome != stepping::Outcome::completed)
        return {status_of(outcome), state, 0.0, simulated(), FoundBy::nothing};
      itineraries_[place_of(section_) % itineraries_.size()] = watch_.passage().itinerary;
    }
  }

 private:
  static constexpr std::int64_t long_settling = 128;
  static constexpr std::size_t longest = BasicRepeatFinder<3>::longest;

  [[nodiscard]] static std::size_t place_of(std::int64_t section) { return static_cast<std::size_t>(section); }
  [[nodiscard]] double settled() const { return static_cast<double>(section_); }
  [[nodiscard]] double simulated() const { return settled() + static_cast<double>(map_.simulated()); }

  /// The forcing periods after which the motion repeats, 0 while it doesn't.
  [[nodiscard]] std::size_t repeats(const motion::State<double>& state) {
    const Passage& passage = watch_.passage();
    const double log_volume = passage.log_area - 2 * integrator_.constants().h * integrator_.period();
    const auto place = motion::place_in_housing(state, scene_.loose);
    const auto [x, v, z, w] = beyond_contact_({state.x, state.v, place.z, place.w});
    return repeat_.add(x, {v, z, w}, log_volume, {passage.size, passage.loose_size});
  }
  [[nodiscard]] ObservedTime repetition(std::size_t n) const {
    const std::size_t ago = repeat_.first_of_last(n, BeginsBefore(scene_.oscillator.forcing));
    ObservedTime found{Status::periodic, recent_[(place_of(section_) - ago) % recent_.size()], static_cast<double>(n),
                       simulated(), FoundBy::repetition};
    found.settling = settled();
    return found;
  }

  /// Once states have begun to contract, the periodic motion that they contract to, if Newton's method finds it.
  [[nodiscard]] std::optional<ObservedTime> attractor(const motion::State<double>& state) {
    const bool pays = section_ <= long_settling || section_ % 8 == 0;
    const bool is_on_wall = state.loose.pressed && state.loose.place == 0;
    if (!pays || is_on_wall) return std::nullopt;
    const auto contacts_of = [this](std::size_t ago) { return itinerary(ago); };
    const std::size_t n = contracting_.periods(repeat_, contacts_of, [](std::size_t) { return false; });
    const auto spent = static_cast<std::int64_t>(map_.simulated() + n * HousingMap<I>::most_turns);
    if (n == 0 || spent > std::min<std::int64_t>(64, time_.max_periods) + section_ / 4) return std::nullopt;
    contracting_.attempt(n, repeat_.distance_over(n));
    std::vector<std::uint64_t> contacts;
    for (std::size_t ago = n; ago > 0; --ago) contacts.push_back(itinerary(ago));
    auto orbit = map_.attractor_of(state, contacts, watch_.passage());
    return orbit ? std::optional(observed(*orbit)) : std::nullopt;
  }
  /// Of the forcing period that began so many sections ago.
  [[nodiscard]] std::uint64_t itinerary(std::size_t ago) const {
    return itineraries_[(place_of(section_) - ago) % itineraries_.size()];
  }
  [[nodiscard]] ObservedTime observed(const HousingOrbit& orbit) const {
    const BeginsBefore before(scene_.oscillator.forcing);
    const std::size_t n = least_divisor(orbit.periods(), [&](std::size_t m) {
      return map_.distance(orbit.states[0], orbit.states[m]) <= RepeatFinder::divisor_tolerances * time_.tolerance;
    });
    const auto first = std::ranges::min_element(
        std::span(orbit.states).first(n), [&](const auto& a, const auto& b) { return before(a.x, a.v, b.x, b.v); });
    ObservedTime found{Status::periodic, *first, static_cast<double>(n), simulated(), FoundBy::newton};
    found.settling = settled() + orbit.settling;
    return found;
  }

  I& integrator_;
  const Scene& scene_;
  TimeSettings time_;
  bool by_newton_;
  std::int64_t from_, section_ = 0;
  BeyondContact beyond_contact_;
  BasicRepeatFinder<3> repeat_;
  Contracting contracting_{};
  HousingObserver watch_;
  HousingMap<I> map_;
  std::optional<LooseStandstill> standstill_{};           ///< without a force
  std::array<motion::State<double>, longest> recent_{};   ///< [section modulo its size]
  std::array<std::uint64_t, 2 * longest> itineraries_{};  ///< [section modulo its size], of the period from it
};

}  // namespace clatter::steady
