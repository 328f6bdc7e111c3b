#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <utility>

#include "motion/soft_stop.hpp"
#include "scene/displacement_bound.hpp"
#include "scene/response.hpp"
#include "steady/coasting.hpp"
#include "steady/contact_at_section.hpp"
#include "steady/doubt.hpp"
#include "steady/observed_time.hpp"
#include "steady/slipping.hpp"
#include "steady/standing.hpp"
#include "steady/stroboscopic_map.hpp"
#include "steady/time_settings.hpp"
#include "stepping/exact.hpp"

namespace clatter::steady {

/// Whether the search itself or lanes advance a motion from one stroboscopic section to the next. In lanes a forcing
/// period costs so little that plain repetition is quickest unless states contract slowly. Under dry friction, whose
/// reversals and sticks make most motions settle soon, it is tried first, too.
enum class AdvancedBy : std::uint8_t { search, lanes };

/// Finds the steady state of forced motion, section by section, in as few forcing periods as possible: in closed form
/// once no stop can be reached any more, by Newton's method once successive states contract, else by repetition.
template <Effects E>
class ForcedSearch {
 public:
  ForcedSearch(stepping::Exact<double, E>& integrator, const Scene& scene, const TimeSettings& time,
               AdvancedBy advanced_by = AdvancedBy::search)
      : integrator_(integrator),
        scene_(scene),
        time_(time),
        in_lanes_(advanced_by == AdvancedBy::lanes),
        is_rough_(integrator.is_rough()),
        stops_move_(move_by_themselves(integrator.stops())),
        coasting_(integrator, scene, time.tolerance),
        log_area_of_damping_(-2 * integrator.constants().h * integrator.period()),
        repeat_(time.tolerance, in_lanes_ ? 4 : 1),
        begins_before_(scene.oscillator.forcing),
        beyond_contact_(scene, integrator.period()),
        watch_(integrator.stops()),
        map_(integrator, time.tolerance, pace_of(scene.oscillator)),
        slipping_(map_, integrator, scene, time.tolerance) {}

  /// Runs from `state`, at a section, until the steady state is known.
  [[nodiscard]] ObservedTime run(motion::State<double> state) {
    for (;;) {
      if (auto found = at_section(state)) return std::move(*found);
      const stepping::Outcome outcome = advance(state);
      if (outcome != stepping::Outcome::completed) return failure(outcome, state);
      ++section_;
    }
  }

  /// The steady state, if it is known at the next section; nothing: the motion has to go on.
  [[nodiscard]] std::optional<ObservedTime> at_section(const motion::State<double>& state) {
    if (auto found = closed_form(state)) return found;
    if constexpr (E.soft)
      if (auto found = pressed(state)) return found;
    if constexpr (E.friction)
      if (section_ >= settles_soon)
        if (auto orbit = slipping_.from(state)) return observed(*orbit);
    if constexpr (E.stiffness || E.forcing == Forcing::secular)
      if (escapes(scene_, state.x, state.v, integrator_.phase(motion::State<double>{})))
        return escape(state, simulated());
    if (!in_lanes_) keep(state);
    const bool stays = stays_in_contact(state), last = section_ == time_.max_periods;
    const std::size_t n = repeats(state);
    if (n > 0 && !stays) return repetition(n);
    if constexpr (E.friction)
      if (auto found = standing(integrator_, scene_, state, settled(), simulated())) return found;
    if (n > 0) in_contact_for_ = n;
    if (last && stays && in_contact_for_ > 0) return repetition(in_contact_for_);
    if (last) return aperiodic(state, simulated(), time_, rests_);
    if (stays) return std::nullopt;
    return attractor(state);
  }
  /// Lanes: records the forcing periods that lead to the next section that is looked at.
  void pass_periods(const Passage& passage, std::int64_t periods) {
    keep(passage), section_ += periods;
    if ((periods > 1) != samples_) samples_ = periods > 1, closing_in_ = 0, repeat_.restart();
  }
  /// Lanes: takes a section if nothing can be found there: stops were met since the one before, no repeat is looked for
  /// or confirmed, nor is it time for Newton's method. False: it is for `at_section`.
  [[nodiscard]] bool skips(double x, double v) {
    if constexpr (E.soft || E.stiffness) return false;
    const Passage& passage = passages_[index(1)];
    if (samples_ || passage.itinerary == 0 || closing_in_ > 0 || repeat_.looks_next()) return false;
    if (section_ == time_.max_periods || pays()) return false;
    note_cut(x, v);
    const auto [at_x, at_v, z, w] = beyond_contact_({x, v});
    repeat_.pass(at_x, at_v, passage.log_area + log_area_of_damping_);
    return true;
  }
  /// Lanes: whether a section has been within rounding of an impact. Lanes don't tell on which side of it they are.
  [[nodiscard]] bool is_cut() const { return is_cut_; }
  /// Lanes: forcing periods from a section ahead to the next one to look at. Motion that hasn't settled for long is
  /// sampled, until it comes back to a sample, but for some time before each attempt by Newton's method.
  [[nodiscard]] std::int64_t periods_from(std::int64_t section) const {
    return section >= look_until_ && may_sample(section) ? between_samples : 1;
  }
  /// Lanes: whether sections after this one may be left out, if no motion seems to have come back then.
  [[nodiscard]] bool may_sample(std::int64_t section) const {
    const std::int64_t attempt = std::min<std::int64_t>(
        static_cast<std::int64_t>(std::bit_ceil(static_cast<std::uint64_t>(section) + 1)), time_.max_periods - 1);
    return section >= first_sample && section + between_samples + looked_at <= attempt;
  }

  [[nodiscard]] ObservedTime failure(stepping::Outcome outcome, const motion::State<double>& state) const {
    return {status_of(outcome), state, 0.0, simulated(), FoundBy::nothing};
  }

 private:
  static constexpr std::int64_t long_settling = 128;
  static constexpr std::int64_t settles_soon = 8;  ///< much motion under friction, before other ways pay
  static constexpr std::size_t kept = 2 * RepeatFinder::longest;
  static constexpr std::int64_t first_sample = 256, between_samples = 8;
  static constexpr std::int64_t looked_at = 3 * RepeatFinder::longest;  ///< sections in a row that an attempt looks at

  [[nodiscard]] std::size_t index(std::size_t ago) const { return (static_cast<std::size_t>(section_) - ago) % kept; }
  [[nodiscard]] double settled() const { return static_cast<double>(section_); }  ///< forcing periods of the motion
  [[nodiscard]] double simulated() const {
    return static_cast<double>(section_ - taken_) + static_cast<double>(map_.simulated());
  }

  /// Runs to the next section, or takes its state from a failed attempt that has already computed it.
  [[nodiscard]] stepping::Outcome advance(motion::State<double>& state) {
    if (approach_ && next_ < approach_->periods) {
      keep(approach_->passages[next_]);
      state = approach_->states[++next_];
      ++taken_;
      return stepping::Outcome::completed;
    }
    watch_.begin_section();
    const stepping::Outcome outcome = advance_to_section(integrator_, state, state.periods, watch_);
    keep(watch_.passage());
    return outcome;
  }

  /// The forcing periods after which the motion repeats, 0 while it doesn't. In lanes the motion goes on until the
  /// states at the sections are as close as rounding allows, since no Newton step brings them there.
  [[nodiscard]] std::size_t repeats(const motion::State<double>& state) {
    if (in_lanes_ && section_ > 0) note_cut(state.x, state.v);
    if (samples_) {
      if (repeat_.sample(state.x, state.v)) look_until_ = section_ + looked_at;
      return 0;
    }
    const double log_area = section_ > 0 ? passages_[index(1)].log_area + log_area_of_damping_ : 0.0;
    const auto [x, v, z, w] = beyond_contact_({state.x, state.v});
    const double size = is_rough_ && section_ > 0 ? passages_[index(1)].size : 0.0;  // a mass may stick near 0
    const std::size_t n = repeat_.add(x, v, log_area, size);
    if (repeat_.confirms()) look_until_ = section_ + looked_at;
    if (!in_lanes_ || (n == 0 && closing_in_ == 0)) return n;
    if (closing_in_ == 0) closing_in_ = n, closest_ = std::numeric_limits<double>::infinity();
    const double distance = repeat_.distance_over(closing_in_);
    if (distance < closest_) closest_ = distance, closest_at_ = section_;
    const bool as_close_as_it_gets = section_ - closest_at_ > static_cast<std::int64_t>(2 * closing_in_ + 4);
    const bool close = distance <= 8 * epsilon<double>() || as_close_as_it_gets || section_ == time_.max_periods;
    return close ? closing_in_ : 0;
  }

  void note_cut(double x, double v) { is_cut_ = is_cut_ || beyond_contact_.is_beside(x, v); }

  [[nodiscard]] ObservedTime repetition(std::size_t n) const {
    return repeated(recent(repeat_.first_of_last(n, begins_before_)), n, simulated(), section_, rests_);
  }
  /// Keeps the summary of the forcing period from this section on.
  void keep(const Passage& passage) {
    passages_[index(0)] = passage;
    rests_.pass(passage, section_);
  }
  void keep(const motion::State<double>& state) {
    if (!recent_) recent_.emplace();
    (*recent_)[index(0) % recent_->size()] = state;
  }
  /// The state so many sections ago. Lanes know no more of it than displacement and velocity.
  [[nodiscard]] motion::State<double> recent(std::size_t ago) const {
    if (!in_lanes_) return (*recent_)[index(ago) % recent_->size()];
    motion::State<double> state;
    state.x = repeat_.x(ago), state.v = repeat_.v(ago), state.periods = section_ - static_cast<std::int64_t>(ago);
    return state;
  }

  /// The steady forced response, if no stop is in reach from now on.
  [[nodiscard]] std::optional<ObservedTime> closed_form(const motion::State<double>& state) const {
    if (section_ > 0 && passages_[index(1)].itinerary != 0) return std::nullopt;
    return coasting_.from(state, settled(), simulated());
  }

  /// The soft stop that a state is in contact with.
  [[nodiscard]] motion::Within<double> contact_of(const motion::State<double>& state) const {
    if (in_lanes_) return motion::soft_stop_around(integrator_.stops(), state.x, state.v);
    return {state.within, state.offset, state.pressed};
  }
  /// Whether the last forcing period was spent in one contact. Its motion may be small beside the displacement that
  /// repeats are told by, so it isn't told by them.
  [[nodiscard]] bool stays_in_contact(const motion::State<double>& state) const {
    if (!E.soft || is_rough_ || stops_move_ || section_ == 0) return false;
    const motion::Within<double> within = contact_of(state);
    const std::uint64_t itinerary = in_lanes_ ? 0 : PassageObserver::itinerary_in_contact(within.side);
    return within.side != Side::none && within.pressed && passages_[index(1)].itinerary == itinerary;
  }

  /// The steady motion in contact with a soft stop, if the stop pushes for ever: if its force on the balanced mass is
  /// larger than the forces that response and transient can take from it. The transient's energy norm never grows.
  [[nodiscard]] std::optional<ObservedTime> pressed(const motion::State<double>& state) const {
    if (is_rough_ || stops_move_ || !scene_.oscillator.shape.is_sine()) return std::nullopt;
    const motion::Within<double> within = contact_of(state);
    if (within.side == Side::none || !within.pressed) return std::nullopt;
    const auto stop = motion::soft_stop_at<double>(integrator_.stops(), within.side);
    Oscillator in_contact = scene_.oscillator;
    in_contact.damping += stop.damping, in_contact.stiffness += stop.stiffness;
    if (!(in_contact.damping > 0 && in_contact.stiffness > 0)) return std::nullopt;
    const double balance = constant_force(scene_.oscillator, stop.position) / in_contact.stiffness;  // from the stop
    const auto [sine, cosine] = integrator_.phase(motion::State<double>{});
    const PhasePoint response = response_at(in_contact, sine, cosine),
                     left = transient_of(in_contact, {within.offset - balance, state.v, sine, cosine});
    const double nu = in_contact.frequency, natural = natural_frequency(in_contact);
    const double taken = steady_response(in_contact).amplitude * std::hypot(stop.stiffness, 2 * stop.damping * nu) +
                         std::hypot(natural * left.x, left.v) * std::hypot(stop.stiffness / natural, 2 * stop.damping);
    if (!(taken < stop.stiffness * stop.into(balance) * (1 - 64 * epsilon<double>()))) return std::nullopt;
    motion::State<double> steady = state;
    steady.from_stop = steady.within = within.side, steady.pressed = true;
    steady.offset = balance + response.x, steady.x = stop.position + steady.offset, steady.v = response.v;
    const double most = time_.tolerance * std::max(std::abs(steady.x), std::abs(steady.v));
    const double periods = fading_time(in_contact, left, most) / integrator_.period();
    if (!(periods < longest_settling)) return std::nullopt;
    return ObservedTime{Status::periodic, steady, 1.0, simulated(), FoundBy::closed_form, settled() + periods};
  }

  /// Once states have begun to contract, follows the next n periods together with their derivative, and looks for the
  /// periodic motion that they contract to.
  [[nodiscard]] std::optional<ObservedTime> attractor(const motion::State<double>& state) {
    if (!pays() || (approach_ && next_ < approach_->periods)) return std::nullopt;
    const std::size_t n = contracting();
    if (n == 0 || !affordable(n)) return std::nullopt;
    contracting_.attempt(n, repeat_.distance_over(n));
    approach_ = map_.follow(state, n), next_ = 0;
    const auto orbit = approach_ ? map_.attractor_of(*approach_) : std::nullopt;
    if (in_lanes_) approach_.reset();
    return orbit ? std::optional(observed(*orbit)) : std::nullopt;
  }

  /// Whether to look for contracting states at this section: a look costs a tenth of a forcing period, and in lanes an
  /// attempt costs as much as hundreds of them.
  [[nodiscard]] bool pays() const {
    if (closing_in_ > 0 || stops_move_) return false;
    if (in_lanes_) return section_ >= 64 && ((section_ & (section_ - 1)) == 0 || section_ + 1 == time_.max_periods);
    if (is_rough_) return section_ >= 64 && section_ % 16 == 0;
    return section_ <= long_settling || section_ % 8 == 0;
  }

  /// Whether all attempts together stay within min(64, max_periods) plus a quarter of the motion's periods.
  [[nodiscard]] bool affordable(std::size_t n) const {
    const std::int64_t spent = static_cast<std::int64_t>(map_.simulated() + n * StroboscopicMap<E>::most_turns);
    return spent <= std::min<std::int64_t>(64, time_.max_periods) + section_ / 4;
  }

  /// Whether plain repetition will be done before an attempt by Newton's method has paid, by the rate at which states n
  /// apart come closer; true, too, if that rate isn't known yet.
  [[nodiscard]] bool repeats_soon(std::size_t n) const {
    const double now = repeat_.distance_over(n), before = repeat_.distance_over(n, n);
    if (!(before < repeat_.distance_over(n, 2 * n)) && !(now < 1e-3)) return true;
    const double rounds = std::log(now / time_.tolerance) / std::log(before / now);
    const double left = static_cast<double>(n) * (std::max(0.0, rounds) + 2);  // and two more to confirm it
    return left < std::min(400.0, static_cast<double>(time_.max_periods - section_));
  }

  [[nodiscard]] std::size_t contracting() const {
    const auto itinerary = [this](std::size_t ago) { return passages_[index(ago)].itinerary; };
    return contracting_.periods(repeat_, itinerary,
                                [this](std::size_t n) { return (in_lanes_ || is_rough_) && repeats_soon(n); });
  }

  [[nodiscard]] ObservedTime observed(const MapOrbit& orbit) const {
    const motion::State<double>& start = orbit.states[0];
    const double limit =
        RepeatFinder::divisor_tolerances * time_.tolerance * std::max(std::abs(start.x), std::abs(start.v));
    const std::size_t n =
        least_divisor(orbit.periods, [&](std::size_t m) { return between(start, orbit.states[m]).size() <= limit; });
    const auto first = std::ranges::min_element(std::span(orbit.states).first(n),
                                                [this](const motion::State<double>& a, const motion::State<double>& b) {
                                                  return begins_before_(a.x, a.v, b.x, b.v);
                                                });
    ObservedTime found{Status::periodic, *first, static_cast<double>(n), simulated(), FoundBy::newton};
    found.settling = settled() + orbit.settling;
    found.doubtful = n >= long_period || stretches(orbit);
    return found;
  }

  stepping::Exact<double, E>& integrator_;
  const Scene& scene_;
  TimeSettings time_;
  bool in_lanes_;
  bool is_rough_;
  bool stops_move_;  ///< stops: what is proved of a motion between them takes them for standing ones
  Coasting<E> coasting_;
  double log_area_of_damping_;   ///< logarithm of the factor by which a forcing period shrinks areas without impacts
  bool samples_ = false;         ///< lanes: sections have been left out before this one
  std::int64_t look_until_ = 0;  ///< lanes: the section up to which none is left out
  std::int64_t section_ = 0;
  std::int64_t taken_ = 0;          ///< sections that were taken from approaches
  std::size_t in_contact_for_ = 0;  ///< forcing periods after which motion in one contact has repeated
  Rests rests_{};
  std::size_t closing_in_ = 0;   ///< lanes: forcing periods after which the motion repeats; 0: not known yet
  double closest_ = 0.0;         ///< the least distance so far of states so many sections apart
  std::int64_t closest_at_ = 0;  ///< the section at which it was
  RepeatFinder repeat_;
  Contracting contracting_{};
  BeginsBefore begins_before_;
  BeyondContact beyond_contact_;
  bool is_cut_ = false;                   ///< lanes: a section lies beside an impact
  std::array<Passage, kept> passages_{};  ///< [section modulo kept]: the period from it; before the start no contact
  std::size_t next_ = 0;                  ///< index of the approach's next section
  std::optional<MapOrbit> approach_;      ///< the periods that the last attempt followed
  PassageObserver watch_;
  StroboscopicMap<E> map_;
  [[no_unique_address]] std::conditional_t<E.friction, Slipping<E>, NoSlipping> slipping_;
  /// [section modulo its size]; not in lanes, nor if the first section tells all.
  std::optional<std::array<motion::State<double>, RepeatFinder::longest>> recent_{};
};

}  // namespace clatter::steady
