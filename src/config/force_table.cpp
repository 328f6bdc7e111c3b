#include "config/force_table.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <string_view>
#include <utility>
#include <vector>

#include "config/keys.hpp"
#include "config/suggestion.hpp"
#include "config/text_file.hpp"
#include "config/unit.hpp"
#include "config/value_grammar.hpp"
#include "storage/error.hpp"

namespace clatter::config {
namespace {

constexpr std::string_view name_of_key = "force_table";

/// The first column of a table: the phase of its rows.
enum class Clock { time, phase, period };

/// A line of a table, without blanks around it, and its place: of rows within a configuration that of the whole.
struct Row {
  std::string_view text;
  SourceLocation location;
  bool is_in_file;
};

[[noreturn]] void refuse(const Row& row, const std::string& why) {
  fail(row.location, row.is_in_file ? why : in_quotes(name_of_key) + ": " + in_quotes(row.text) + ": " + why);
}

const Setting* given_table(const Settings& settings) { return settings.find(settings.scene_section, name_of_key); }

/// Whether a value of the key is the rows themselves, between line ends or semicolons, and no name of a file.
bool holds_rows(std::string_view text) { return text.find_first_of("\n;") != std::string_view::npos; }

/// The rows that hold something, lines of a file, or of a text at a place: there semicolons part them, too.
std::vector<Row> rows_of(std::string_view text, const SourceLocation& place, bool is_file) {
  std::vector<Row> rows;
  const bool has_lines = text.find('\n') != std::string_view::npos;
  for (int line = 1; !text.empty();) {
    const bool is_comment = without_blanks(text).starts_with('#');
    const std::size_t end =
        std::min(text.find_first_of(is_file || (is_comment && has_lines) ? "\n" : "\n;"), text.size());
    const std::string_view row = without_blanks(text.substr(0, end));
    if (!row.empty() && !row.starts_with('#'))
      rows.push_back({row, is_file ? SourceLocation{place.source, line, 1} : place, is_file});
    if (end < text.size() && text[end] == '\n') ++line;
    text.remove_prefix(std::min(end + 1, text.size()));
  }
  return rows;
}

/// The two fields of a row.
std::array<std::string_view, 2> fields_of(const Row& row) {
  const std::size_t comma = row.text.find(',');
  if (comma == std::string_view::npos || row.text.find(',', comma + 1) != std::string_view::npos)
    refuse(row, in_quotes(row.text) + " has " + (comma == std::string_view::npos ? "one column" : "more than two") +
                    "; a row of a force is its time and the force, with a comma between them");
  return {without_blanks(row.text.substr(0, comma)), without_blanks(row.text.substr(comma + 1))};
}

/// The heads of the columns, as "time (ms), force (N)".
class Head {
 public:
  Head(const Row& row, bool is_si) : row_(row), is_si_(is_si) {
    const auto [first, second] = fields_of(row);
    if (first.find_first_not_of("+-.0123456789eE") == std::string_view::npos)
      refuse(in_quotes(row.text) + " is no head of two columns");
    const auto [clock, clock_unit] = name_and_unit(first);
    const auto [force, force_unit] = name_and_unit(second);
    if (clock == "period")
      clock_ = Clock::period, tick_ = unit_in(clock, clock_unit, Quantity::number);
    else if (clock == "phase")
      clock_ = Clock::phase, tick_ = unit_in(clock, clock_unit, Quantity::angle);
    else if (clock == (is_si ? "time" : "tau"))
      clock_ = Clock::time, tick_ = unit_in(clock, clock_unit, is_si ? Quantity::time : Quantity::number);
    else
      refuse("the first column is " + in_quotes(clock));
    if (force != (is_si ? "force" : "f")) refuse("the second column is " + in_quotes(force));
    scale_ = unit_in(force, force_unit, is_si ? Quantity::force : Quantity::number);
  }

  [[nodiscard]] Clock clock() const { return clock_; }
  /// The time of a row in tau or s, rad, or shares of the period, from the number written.
  [[nodiscard]] double time(double written) const { return in_si(written, tick_.unit, tick_.quantity); }
  /// The force in N, or as it was written.
  [[nodiscard]] double force(double written) const { return in_si(written, scale_.unit, scale_.quantity); }

 private:
  struct Measured {
    Unit unit{};
    Quantity quantity = Quantity::number;
  };

  [[noreturn]] void refuse(const std::string& why) const {
    const std::string first = is_si_ ? "'time (ms)'" : "'tau'", second = is_si_ ? "'force (N)'" : "'f'";
    clatter::config::refuse(row_, why + "; expected " + first +
                                      ", 'phase (deg)', 'phase (rad)' or 'period', its share, and " + second +
                                      " above the rows");
  }
  /// "time" and "ms" of "time (ms)".
  [[nodiscard]] std::pair<std::string_view, std::string_view> name_and_unit(std::string_view field) const {
    const std::size_t open = field.find('(');
    if (open == std::string_view::npos) return {field, {}};
    if (!field.ends_with(')')) refuse(in_quotes(field) + " has no ')'");
    return {without_blanks(field.substr(0, open)), without_blanks(field.substr(open + 1, field.size() - open - 2))};
  }
  [[nodiscard]] Measured unit_in(std::string_view column, std::string_view text, Quantity quantity) const {
    if (quantity == Quantity::number) {
      if (!text.empty())
        refuse("the unit " + in_quotes(text) + " doesn't fit: " + in_quotes(column) + " is a number without unit");
      return {};
    }
    if (text.empty()) refuse(in_quotes(column) + " has no unit");
    const auto unit = parse_unit(text);
    if (!unit || !fits(*unit, quantity))
      refuse("the unit " + in_quotes(text) + " doesn't fit: expected " + description_of(quantity));
    return {*unit, quantity};
  }

  const Row& row_;
  bool is_si_;
  Clock clock_ = Clock::time;
  Measured tick_, scale_;
};

struct Sample {
  double time, force;
};

double number_in(const Row& row, std::string_view field) {
  const double number = parse_number({field, row.location});
  if (!std::isfinite(number)) refuse(row, in_quotes(field) + " isn't finite; leave the row out");
  return number;
}

/// The rows as numbers. Throws ConfigError if they are too few or too many, or if a time
/// falls.
std::vector<Sample> samples_of(const std::vector<Row>& rows, const Head& head) {
  const std::size_t count = rows.size() - 1;
  if (count < 2)
    refuse(rows.back(), std::string(count == 0 ? "no row" : "one row") +
                            " below the head; expected at least two, the last of which closes the period");
  if (count > max_force_rows)
    refuse(rows[max_force_rows + 1], std::to_string(count) + " rows; expected at most " +
                                         std::to_string(max_force_rows) + ", of a single period");
  std::vector<Sample> samples;
  std::string_view before;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const auto [time, force] = fields_of(rows[i]);
    samples.push_back({head.time(number_in(rows[i], time)), head.force(number_in(rows[i], force))});
    if (i > 1 && samples.back().time < samples[samples.size() - 2].time)
      refuse(rows[i], std::string(time) + " follows " + std::string(before) +
                          ", and times must not fall; two equal ones are a jump of the force");
    before = time;
  }
  return samples;
}

/// The length of the period, the time of the last row. Phases must be those of one turn, to a thousandth.
double period_in(const std::vector<Sample>& samples, const Head& head, const std::vector<Row>& rows) {
  const double first = samples.front().time, length = samples.back().time - first;
  if (head.clock() == Clock::time) {
    if (!(length > 0)) refuse(rows.back(), "all rows have one time; the last one closes the period");
    return length;
  }
  const double turn = head.clock() == Clock::phase ? 2 * std::numbers::pi : 1;
  const char* const expected = head.clock() == Clock::phase ? "0 to 360 deg" : "0 to 1";
  if (std::abs(first) > 1e-9 * turn || std::abs(length - turn) > 1e-3 * turn)
    refuse(std::abs(first) > 1e-9 * turn ? rows[1] : rows.back(),
           std::string("the rows don't run from ") + expected + "; the last one closes the period");
  return length;
}

MeasuredForce force_of(const std::vector<Row>& rows, bool is_si) {
  const Head head(rows.front(), is_si);
  const std::vector<Sample> samples = samples_of(rows, head);
  const double first = samples.front().time, period = period_in(samples, head, rows);
  constexpr double shortest = 1e-12;
  std::vector<ForceTable::Knot> knots;
  for (std::size_t i = 0; i < samples.size(); ++i) {
    const auto [time, force] = samples[i];
    const double turns = (time - first) / period;
    if (i > 0 && time == samples[i - 1].time) {
      if (turns == 0 || turns == 1)
        refuse(rows[i + 1], "two rows at an end of the period; a jump there is from the last row to the first one");
      if (i > 1 && time == samples[i - 2].time) refuse(rows[i + 1], "three rows at one time; a jump has two");
      knots.back().after = force;
      continue;
    }
    if (i > 0 && turns - (samples[i - 1].time - first) / period < shortest)
      refuse(rows[i + 1], "closer than 1e-12 of the period to the row before; give both one time, for a jump");
    if (turns < 1)
      knots.push_back({turns, force, force});
    else
      knots.front().before = force;
  }
  if (std::ranges::all_of(samples, [](const Sample& sample) { return sample.force == 0; }))
    refuse(rows[1], "all forces are 0; leave " + in_quotes(name_of_key) + " out");
  return {ForceTable(std::move(knots)), head.clock() == Clock::time ? period : 0.0};
}

MeasuredForce force_in(std::string_view text, const SourceLocation& place, bool is_si) {
  const std::vector<Row> rows = rows_of(text, place, false);
  if (rows.empty()) fail(place, "no rows of a force");
  return force_of(rows, is_si);
}

/// The keys in whose place a table stands.
std::vector<const Setting*> other_forces(const Settings& settings) {
  std::vector<const Setting*> found;
  for (const Parameter key : {Parameter("f"), Parameter("force"), Parameter("force_duty"), Parameter("force_rise")})
    if (const Setting* const given = settings.given(key)) found.push_back(given);
  for (const Parameter key : all_parameters)
    if (key.role() == Role::force_order)
      if (const Setting* const given = settings.given(key)) found.push_back(given);
  if (const Setting* const shape = settings.find(settings.scene_section, "force_shape")) found.push_back(shape);
  return found;
}

bool is_amplitude(const Setting& setting) { return setting.key->name == "f" || setting.key->name == "force"; }

void replace(Settings& settings, const Setting& former, const Setting& by) {
  const Key* const key = former.key;
  settings.replaced.push_back({key->name, by.key_location, former.key_location, "", 0});
  for (auto* const list : {&settings.values, &settings.axes})
    std::erase_if(*list, [&](const Setting& one) { return one.key == key; });
}

}  // namespace

void read_force_table(Settings& settings) {
  for (Setting& given : settings.values) {
    if (given.key->name != name_of_key) continue;
    auto& value = std::get<std::string>(given.value);
    if (holds_rows(value)) {
      settings.measured_force = force_in(value, given.location, settings.is_si());
      continue;
    }
    if (value.empty())
      fail(given.location, in_quotes(name_of_key) + " names no file; expected " + permitted(*given.key));
    const bool from_here = on_command_line(given.location) || settings.file == "stdin";
    const std::filesystem::path path =
        from_here ? std::filesystem::path(value) : std::filesystem::path(settings.file).parent_path() / value;
    std::string text;
    try {
      text = read_table(path.string());
    } catch (const storage::IoError& error) {
      fail(given.location, in_quotes(name_of_key) + ": " + error.what());
    }
    check_characters(path.string(), text);
    const std::vector<Row> rows = rows_of(text, {path.string(), 1, 1}, true);
    if (rows.empty()) fail({path.string(), 1, 1}, "no rows of a force");
    settings.measured_force = force_of(rows, settings.is_si());
    std::string lines;
    for (const Row& row : rows) lines.append(row.text) += '\n';
    value = std::move(lines);
  }
}

std::size_t bytes_of_force_table(const Settings& settings) {
  const Setting* const given = given_table(settings);
  return given == nullptr ? 0 : std::get<std::string>(given->value).size();
}

bool has_force_table(const Settings& settings) { return given_table(settings) != nullptr; }

std::size_t harmonics_of_table(const Settings& settings) {
  return static_cast<std::size_t>(settings.integer(settings.scene_section, "force_table_harmonics"));
}

void let_force_table_or_force_win(Settings& settings) {
  const Setting* const table = given_table(settings);
  if (table == nullptr) return;
  const std::vector<const Setting*> others = other_forces(settings);
  const Setting by_table = *table;
  if (on_command_line(table->key_location)) {
    std::vector<Setting> formers;
    for (const Setting* const other : others)
      if (!on_command_line(other->key_location)) formers.push_back(*other);
    for (const Setting& former : formers) replace(settings, former, by_table);
    return;
  }
  for (const Setting* const other : others)
    if (is_amplitude(*other) && on_command_line(other->key_location))
      return replace(settings, by_table, Setting(*other));
}

void check_force_table(const Settings& settings) {
  const Setting* const table = given_table(settings);
  if (table == nullptr) return;
  for (const Setting* const other : other_forces(settings))
    fail(other->key_location, in_quotes(other->key->name) + " beside " + in_quotes(name_of_key) +
                                  ", which gives the force; leave one of them out" +
                                  (is_amplitude(*other) ? ", or multiply the table by force_factor" : ""));
}

}  // namespace clatter::config
