#include "support/deviation.hpp"

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <limits>
#include <sstream>

namespace clatter::support {
namespace {

/// Events within this part of a run's length from its end may fall on either side of the end, by rounding.
constexpr double at_the_end = 1e-14;

std::size_t& count_of(accuracy::Event::Kind kind, Deviation& deviation) {
  if (kind == accuracy::Event::Kind::impact) return deviation.impacts;
  if (kind == accuracy::Event::Kind::reversal) return deviation.reversals;
  return kind == accuracy::Event::Kind::chatter ? deviation.chatters : deviation.rests;
}

std::string text(const accuracy::Event& event) {
  static const char* const names[] = {"impact",  "rest",       "chatter", "touch",
                                      "renewal", "separation", "stick",   "reversal"};
  std::ostringstream out;
  out << names[static_cast<int>(event.kind)];
  if (event.side != Side::none) out << " on " << (event.side == Side::upper ? "upper" : "lower") << " stop";
  out << " at " << std::setprecision(17) << event.time;
  return out.str();
}

/// The keys of a law of restitution, of one side.
std::string law_text(const Restitution<double>& law, const std::string& key, const std::string& side) {
  std::ostringstream out;
  out << std::setprecision(17) << '\n';
  if (law.table) {
    out << key << "_of_speed_" << side << " = \"";
    for (const auto& [speed, R] : law.table->knots)
      out << (&R == &law.table->knots.front().R ? "" : ", ") << speed * law.unit << ": " << R;
    out << '"';
  } else {
    out << key << '_' << side << " = " << law.R;
  }
  if (law.exponent != 0)
    out << '\n'
        << key << "_exponent_" << side << " = " << law.exponent << '\n'
        << key << "_reference_speed_" << side << " = " << law.reference;
  if (law.below != 0) out << '\n' << key << "_below_" << side << " = " << law.below;
  return out.str();
}

}  // namespace

double Deviation::largest() const { return std::max({time, speed, place, end}); }

Deviation deviation(const accuracy::RunRecord& record, const accuracy::RunRecord& reference) {
  const auto events = accuracy::with_rests_joined(record.events),
             expected = accuracy::with_rests_joined(reference.events);
  Deviation result;
  double size_x = std::abs(reference.x), size_v = std::abs(reference.v), size_place = size_x;
  std::size_t j = 0;
  for (const accuracy::Event& event : events) {
    if (event.kind == accuracy::Event::Kind::chatter)  // the reference takes more impacts
      while (j < expected.size() && accuracy::is_of_chatter(expected[j])) ++j;
    const double latest = event.kind == accuracy::Event::Kind::chatter ? event.end() : event.time;
    if (j == expected.size() && latest >= (1 - at_the_end) * reference.duration) continue;  // or the run ends within it
    if (j == expected.size() || expected[j].kind != event.kind || expected[j].side != event.side) {
      result.difference = text(event) + " against " + (j == expected.size() ? "nothing" : text(expected[j]));
      return result;
    }
    const accuracy::Event& other = expected[j++];
    const double off = std::abs(event.time - other.time),
                 end_off = std::abs(event.time + event.length - other.time - other.length);
    result.time = std::max({result.time, event.kind == accuracy::Event::Kind::chatter ? 0.0 : off, end_off});
    result.speed = std::max(result.speed, std::abs(event.speed() - other.speed()));
    size_v = std::max(size_v, other.speed());
    if (event.side == Side::none) {  // it sticks or turns back
      result.place = std::max(result.place, std::abs(event.place - other.place));
      size_place = std::max(size_place, std::abs(other.place));
    }
    ++count_of(event.kind, result);
  }
  while (j < expected.size() && expected[j].time >= (1 - at_the_end) * reference.duration) ++j;
  result.same_events = j == expected.size();
  if (!result.same_events) result.difference = "nothing against " + text(expected[j]);
  size_v = std::max(size_v, size_x);  // the natural frequency is 1
  result.time /= reference.duration;
  if (size_v > 0) result.speed /= size_v;
  if (size_place > 0) result.place /= size_place;
  if (size_x > 0)
    result.end = std::max(std::abs(record.x - reference.x) / size_x, std::abs(record.v - reference.v) / size_v);
  const double size_z = std::max(size_x, std::abs(reference.z));  // of a loose mass, else 0
  if (size_z > 0 && size_v > 0)
    result.end =
        std::max({result.end, std::abs(record.z - reference.z) / size_z, std::abs(record.w - reference.w) / size_v});
  return result;
}

double conditioning(const point::Problem& scene, const accuracy::RunRecord& reference) {
  double worst = 0;
  for (const unsigned signs : {0b1010110101u, 0b0100111000u}) {
    point::Problem moved = scene;
    Oscillator& o = moved.oscillator;
    Stops& stops = moved.stops;
    Start& start = moved.start;
    unsigned i = 0;
    start.phase += epsilon<double>();  // the force's phase is rounded to an ulp of a turn
    for (double* value : {&o.damping, &o.forcing, &o.frequency, &o.load, &stops.restitution_lower.R,
                          &stops.restitution_upper.R, &start.velocity, &start.phase, &start.displacement, &o.stiffness})
      if (*value != 0.0 && !(value == &o.stiffness && *value == 1.0))
        *value *= 1 + (signs >> i++ & 1 ? 1 : -1) * epsilon<double>();
    const double more_friction = 1 + (signs & 1 ? 1 : -1) * epsilon<double>();
    moved.friction.kinetic *= more_friction, moved.friction.static_level *= more_friction;
    LooseMass& loose = moved.loose;
    for (double* value :
         {&loose.ratio, &loose.restitution_lower.R, &loose.restitution_upper.R, &loose.load, &loose.velocity})
      *value *= 1 + (signs >> i++ & 1 ? 1 : -1) * epsilon<double>();
    for (double* R : {&loose.restitution_lower.R, &loose.restitution_upper.R}) *R = std::min(*R, 1.0);
    for (double* wall : {&loose.lower, &loose.upper}) {
      const bool on_it = loose.place == *wall;
      *wall *= 1 + epsilon<double>();
      if (on_it) loose.place = *wall;
    }
    for (double* value : {&stops.lower, &stops.upper}) {
      const bool on_it = scene.start.displacement == *value;
      *value *= 1 + epsilon<double>();
      if (on_it) start.displacement = *value;
    }
    for (double* R : {&stops.restitution_lower.R, &stops.restitution_upper.R}) *R = std::min(*R, 1.0);
    start.displacement = std::clamp(start.displacement, stops.lower, stops.upper);
    const Deviation d = deviation(accuracy::reference_of(moved, reference.duration), reference);
    worst = std::max(worst, d.same_events ? d.largest() : std::numeric_limits<double>::infinity());
  }
  return worst;
}

std::string configuration_of(const point::Problem& s, double duration) {
  std::ostringstream out;
  out << std::setprecision(17) << "[scene]\nh = " << s.oscillator.damping << "\nf = " << s.oscillator.forcing
      << "\nnu = " << s.oscillator.frequency << "\nload = " << s.oscillator.load
      << "\nstiffness = " << s.oscillator.stiffness << "\nphase = " << s.start.phase
      << "\nx0 = " << s.start.displacement << "\nv0 = " << s.start.velocity << "\nstop_lower = " << s.stops.lower
      << "\nstop_upper = " << s.stops.upper;
  const ForceShape& shape = s.oscillator.shape;
  if (!shape.is_sine())
    out << "\nforce_shape = \"" << force_shapes[static_cast<std::size_t>(shape.waveform)]
        << "\"\nforce_duty = " << shape.duty << "\nforce_rise = " << shape.rise;
  const auto tell = [&](const Stops& stops, const char* soft, const char* rigid) {
    for (const bool upper : {false, true}) {
      const char* const which = upper ? "upper" : "lower";
      if (is_soft(stops, upper ? Side::upper : Side::lower))
        out << '\n'
            << soft << "_stiffness_" << which << " = " << (upper ? stops.stiffness_upper : stops.stiffness_lower)
            << '\n'
            << soft << "_damping_" << which << " = " << (upper ? stops.damping_upper : stops.damping_lower);
      else
        out << law_text(upper ? stops.restitution_upper : stops.restitution_lower, rigid, which);
    }
  };
  tell(s.stops, "stop", "R");
  for (const Side side : {Side::lower, Side::upper})
    if (const auto& [amplitude, phase] = motion_of(s.stops, side); amplitude != 0) {
      const char* const which = side == Side::upper ? "upper" : "lower";
      out << "\nstop_amplitude_" << which << " = " << amplitude << "\nstop_phase_" << which << " = " << phase;
    }
  if (has_friction(s.friction))
    out << "\nfriction = " << s.friction.kinetic << "\nfriction_static = " << s.friction.static_level;
  if (const LooseMass& loose = s.loose; has_loose_mass(loose)) {
    tell(walls_of(loose), "loose_wall", "loose_R");
    out << "\nloose_mass = " << loose.ratio << "\nloose_lower = " << loose.lower << "\nloose_upper = " << loose.upper
        << "\nloose_load = " << loose.load << "\nloose_x0 = " << loose.place << "\nloose_v0 = " << loose.velocity
        << "\nloose_friction = " << loose.friction << "\nloose_friction_static = " << loose.friction_static;
  }
  if (s.time.mode == steady::Mode::steady)
    out << "\n[time]\nmax_periods = " << s.time.max_periods;
  else
    out << "\n[time]\nmode = \"transient\"\nduration = " << duration;
  out << "\nmax_impacts = " << s.time.max_impacts << "\n[observe]\nimpact_log = true\n";
  return out.str();
}

}  // namespace clatter::support
