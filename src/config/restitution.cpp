#include "config/restitution.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <utility>

#include "config/keys.hpp"
#include "config/placed.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"

namespace clatter::config {
namespace {

/// The keys of the restitution of a stop, or of a wall of a loose mass.
struct KeysOfLaw {
  Parameter R, exponent, reference, below;
  std::string_view of_speed, of_speed_lower, of_speed_upper;

  [[nodiscard]] std::string_view table(Side side) const {
    return side == Side::lower ? of_speed_lower : of_speed_upper;
  }
};
constexpr std::array laws{
    KeysOfLaw{"R", "R_exponent", "R_reference_speed", "R_below", "R_of_speed", "R_of_speed_lower", "R_of_speed_upper"},
    KeysOfLaw{"loose_R", "loose_R_exponent", "loose_R_reference_speed", "loose_R_below", "loose_R_of_speed",
              "loose_R_of_speed_lower", "loose_R_of_speed_upper"}};

/// The parameter of one side whose key stands for both.
Parameter half_of(Parameter both, Side side) {
  return Parameter::of(std::string(both.key()) + (side == Side::lower ? "_lower" : "_upper")).value();
}
/// The setting of a key of both sides, or of that of one; nullptr: it isn't given.
const Setting* at(const Settings& settings, Parameter both, Side side) {
  const Setting* const given = settings.given(both);
  return given != nullptr ? given : settings.given(half_of(both, side));
}
const Setting* table_at(const Settings& settings, const KeysOfLaw& law, Side side) {
  const Setting* const given = settings.find(settings.scene_section, law.of_speed);
  return given != nullptr ? given : settings.find(settings.scene_section, law.table(side));
}

std::string stop_of(const KeysOfLaw& law, Side side) {
  return std::string(side == Side::lower ? "lower " : "upper ") + (law.R.is_loose() ? "wall" : "stop");
}

/// A text of speeds and restitutions, as "0: 0.9, 0.5 m/s: 0.8".
[[noreturn]] void refuse_table(const Setting& given, const std::string& why) {
  fail(given.location, std::string(given.key->name) + ": " + why +
                           "; expected speeds, each with its restitution, e.g. \"0: 0.9, 0.5" +
                           (given.key->section == "machine" ? " m/s" : "") + ": 0.8\"");
}

/// The number between two places of the text.
double number_in(const Setting& given, std::string_view part, bool is_speed) {
  const auto first = part.find_first_not_of(" \t");
  if (first == std::string_view::npos)
    refuse_table(given, is_speed ? "a speed is missing" : "a restitution is missing");
  part = part.substr(first, part.find_last_not_of(" \t") - first + 1);
  const bool has_units = is_speed && given.key->section == "machine";
  return parse_measure({.text = part,
                        .location = given.location,
                        .quantity = has_units ? Quantity::velocity : Quantity::number,
                        .way_out = has_units ? "" : ", or the scene in [machine], which has units"})
      .value;
}

void check_knots(const Setting& given, const std::vector<SpeedTable::Knot>& knots) {
  for (const auto& [speed, R] : knots) {
    if (!(speed >= 0) || !std::isfinite(speed))
      refuse_table(given, "the speed " + number_text(speed) + " isn't a number of at least 0");
    if (!(R >= 0 && R <= 1)) refuse_table(given, "the restitution " + number_text(R) + " isn't between 0 and 1");
  }
  for (std::size_t i = 1; i < knots.size(); ++i) {
    const auto& [v, R] = knots[i - 1];
    const auto& [next_v, next_R] = knots[i];
    if (!(v < next_v))
      refuse_table(given, "the speed " + number_text(next_v) + " follows " + number_text(v) + ", and speeds must rise");
    const double rise = (next_R - R) / (next_v - v);
    if (next_R + rise * next_v < 0)
      refuse_table(given, "from " + number_text(v) + " to " + number_text(next_v) +
                              " the restitution falls so fast that a faster impact rebounds more slowly");
  }
  if (knots.size() > 1 && knots[0].speed == 0 && knots[0].R == 1 && knots[1].R < 1)
    refuse_table(given,
                 "a restitution that falls from 1 at rest never lets the mass rest, after a number of impacts that "
                 "grows exponentially; begin with a constant one, or with less than 1");
}

/// Removes a setting of the file in favour of another one. One of both sides, in favour of one of a single side, stays
/// for the other.
void give_way(Settings& settings, const Setting& former, const Setting& by, const KeysOfLaw& law, Side other) {
  const auto is_of_both = [&](const Setting& one) {
    const std::string_view name = one.key->name;
    return name == law.of_speed || name == law.R.key() || name == law.exponent.key() || name == law.reference.key();
  };
  const std::string half(std::string(former.key->name) + (other == Side::lower ? "_lower" : "_upper"));
  const Key* const stays = is_of_both(former) && !is_of_both(by) ? find_key(settings.scene_section, half) : nullptr;
  settings.replaced.push_back({former.key->name, by.key_location, former.key_location,
                               stays != nullptr ? ", which stays as " + in_quotes(half) : "", 0});
  for (auto* const list : {&settings.values, &settings.axes})
    for (auto one = list->begin(); one != list->end();) {
      const bool is_it = one->key == former.key && !on_command_line(one->key_location);
      if (is_it && stays != nullptr) one->key = stays;
      one = is_it && stays == nullptr ? list->erase(one) : std::next(one);
    }
}

/// R_exponent needs R_reference_speed, and R at that speed no less than p/(1 + p).
void check_power(const Settings& settings, const KeysOfLaw& law, Side side, const AxisGroups& groups) {
  const Setting *const exponent = at(settings, law.exponent, side), *const R = at(settings, law.R, side);
  if (exponent == nullptr || std::ranges::all_of(exponent->numbers(), [](double p) { return p == 0; })) return;
  if (at(settings, law.reference, side) == nullptr)
    fail(exponent->key_location, in_quotes(exponent->key->name) + " without " + in_quotes(law.reference.key()) +
                                     "; add the impact speed at which the restitution is " + std::string(law.R.key()));
  if (R == nullptr) return;  // R = 1
  const bool is_of_both = R->key->name == law.R.key(), is_exponent_of_both = exponent->key->name == law.exponent.key();
  Placed least = placed(settings, groups, is_exponent_of_both ? law.exponent : half_of(law.exponent, side));
  for (double& p : least.values) p = p / (1 + p);
  const Placed restitution = placed(settings, groups, is_of_both ? law.R : half_of(law.R, side));
  compare(least, restitution, is_not_above,
          "a restitution of at least p/(1 + p) with p = " + std::string(exponent->key->name) +
              ", below which a faster impact would rebound more slowly");
}

/// A table takes the place of R and of its power law.
void check_table(const Settings& settings, const KeysOfLaw& law, Side side) {
  const Setting* const table = table_at(settings, law, side);
  if (table == nullptr) return;
  for (const Parameter key : {law.R, law.exponent, law.reference})
    if (const Setting* const given = at(settings, key, side))
      fail(given->key_location, in_quotes(given->key->name) + " beside " + in_quotes(table->key->name) +
                                    ", which gives the restitution of the " + stop_of(law, side) +
                                    " by its speeds; leave one of them out");
  const bool is_soft = law.R.is_loose() ? is_soft_wall_somewhere(settings, side) : is_soft_somewhere(settings, side);
  if (is_soft)
    fail(table->key_location, in_quotes(table->key->name) + " is of a rigid one, and the " + stop_of(law, side) +
                                  " is soft; leave out the one or the other");
}

}  // namespace

std::optional<NoEffect> restitution_without_effect(const Settings& settings, const Key& key) {
  const auto parameter = Parameter::of(key.kind == Kind::text ? key.other : key.name);
  if (!describes_scene(key.section) || !parameter) return std::nullopt;
  if (parameter->role() != Role::restitution && parameter->role() != Role::law_of_speed) return std::nullopt;
  for (const KeysOfLaw& law : laws) {
    if (!key.name.starts_with(law.reference.key())) continue;
    for (const Side side : {Side::lower, Side::upper})
      if (place_of_nonzero(at(settings, law.exponent, side)) != nullptr) return std::nullopt;
    return NoEffect{"without an exponent", "give that, too"};
  }
  const auto is_absent = [&](Side side) {
    const Setting* const place =
        settings.given(side == Side::lower ? Parameter("stop_lower") : Parameter("stop_upper"));
    return place == nullptr || std::ranges::all_of(place->numbers(), [](double x) { return std::isinf(x); });
  };
  if (parameter->is_loose() || settings.given_symmetric_stops()) return std::nullopt;
  const bool no_lower = is_absent(Side::lower), no_upper = is_absent(Side::upper);
  if (parameter->side() == Side::none && no_lower && no_upper) return NoEffect{"without stops", "give stops"};
  if (parameter->side() == Side::lower && no_lower) return NoEffect{"without a lower stop", "give stop_lower"};
  if (parameter->side() == Side::upper && no_upper) return NoEffect{"without an upper stop", "give stop_upper"};
  return std::nullopt;
}

void let_speed_table_or_restitution_win(Settings& settings) {
  for (const KeysOfLaw& law : laws)
    for (const Side side : {Side::lower, Side::upper}) {
      const Setting* table = table_at(settings, law, side);
      if (table == nullptr) continue;
      for (const Parameter both : {law.R, law.exponent, law.reference}) {
        const Setting* const number = at(settings, both, side);
        if (number == nullptr || on_command_line(number->key_location) == on_command_line(table->key_location))
          continue;
        const Setting by = on_command_line(number->key_location) ? *number : *table,
                      former = on_command_line(number->key_location) ? *table : *number;
        const bool is_over = former.key == table->key;
        give_way(settings, former, by, law, opposite(side));
        if (is_over) break;
        table = table_at(settings, law, side);  // which may lie elsewhere now
      }
    }
}

SpeedTable speed_table(const Setting& given) {
  const std::string& text = std::get<std::string>(given.value);
  SpeedTable table;
  for (std::string_view rest = text; !rest.empty();) {
    const std::size_t comma = rest.find(',');
    const std::string_view pair = rest.substr(0, comma);
    const std::size_t colon = pair.find(':');
    if (colon == std::string_view::npos) refuse_table(given, in_quotes(pair) + " has no colon");
    table.knots.push_back(
        {number_in(given, pair.substr(0, colon), true), number_in(given, pair.substr(colon + 1), false)});
    rest = comma == std::string_view::npos ? std::string_view{} : rest.substr(comma + 1);
  }
  if (table.knots.empty()) refuse_table(given, "it is empty");
  check_knots(given, table.knots);
  return table;
}

void set_speed_tables(const Settings& settings, GivenScene& scene) {
  for (const KeysOfLaw& law : laws)
    for (const Side side : {Side::lower, Side::upper})
      if (const Setting* const given = table_at(settings, law, side)) {
        auto& lower = law.R.is_loose() ? scene.loose.restitution_lower : scene.stops.restitution_lower;
        auto& upper = law.R.is_loose() ? scene.loose.restitution_upper : scene.stops.restitution_upper;
        (side == Side::lower ? lower : upper).table = kept(speed_table(*given));
      }
}

bool has_speed_table(const Settings& settings, std::string_view name) {
  for (const KeysOfLaw& law : laws)
    for (const Parameter both : {law.R, law.exponent, law.reference})
      for (const Side side : {Side::lower, Side::upper})
        if ((name == both.key() || name == half_of(both, side).key()) && table_at(settings, law, side) != nullptr)
          return true;
  return false;
}

void check_restitutions(const Settings& settings, const AxisGroups& groups) {
  for (const KeysOfLaw& law : laws) {
    const Setting* const both = settings.find(settings.scene_section, law.of_speed);
    for (const Side side : {Side::lower, Side::upper}) {
      const Setting* const one = settings.find(settings.scene_section, law.table(side));
      if (both != nullptr && one != nullptr)
        fail(one->key_location, in_quotes(one->key->name) + " beside " + in_quotes(law.of_speed) +
                                    ", which stands for both; leave one of them out");
      check_table(settings, law, side), check_power(settings, law, side, groups);
    }
  }
}

}  // namespace clatter::config
