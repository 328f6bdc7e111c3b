#include "config/unit_hint.hpp"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include "config/suggestion.hpp"
#include "config/unit.hpp"
#include "config/value_grammar.hpp"

namespace clatter::config {
namespace {

/// Another name of a unit, or the name of one that isn't read, in lower case and singular.
struct UnitName {
  std::string_view name;
  double size;  ///< in the unit
  std::string_view unit;
};

constexpr std::array other_unit_names{
    UnitName{"gram", 1, "g"},          UnitName{"gramm", 1, "g"},
    UnitName{"kilo", 1, "kg"},         UnitName{"newton", 1, "N"},
    UnitName{"meter", 1, "m"},         UnitName{"metre", 1, "m"},
    UnitName{"micron", 1, "um"},       UnitName{"sec", 1, "s"},
    UnitName{"second", 1, "s"},        UnitName{"minute", 1, "min"},
    UnitName{"hertz", 1, "Hz"},        UnitName{"cps", 1, "Hz"},
    UnitName{"radian", 1, "rad"},      UnitName{"degree", 1, "deg"},
    UnitName{"percent", 1, "%"},       UnitName{"pct", 1, "%"},
    UnitName{"upm", 1, "rpm"},         UnitName{"inch", 25.4, "mm"},
    UnitName{"inches", 25.4, "mm"},    UnitName{"in", 25.4, "mm"},
    UnitName{"foot", 304.8, "mm"},     UnitName{"feet", 304.8, "mm"},
    UnitName{"ft", 304.8, "mm"},       UnitName{"mil", 0.0254, "mm"},
    UnitName{"thou", 0.0254, "mm"},    UnitName{"lb", 0.45359237, "kg"},
    UnitName{"lbm", 0.45359237, "kg"}, UnitName{"pound", 0.45359237, "kg"},
    UnitName{"oz", 28.349523125, "g"}, UnitName{"lbf", 4.4482216152605, "N"},
    UnitName{"kgf", 9.80665, "N"},     UnitName{"kp", 9.80665, "N"},
    UnitName{"t", 1000, "kg"},         UnitName{"tonne", 1000, "kg"},
    UnitName{"h", 60, "min"},          UnitName{"hour", 60, "min"},
    UnitName{"rev", 360, "deg"},       UnitName{"turn", 360, "deg"},
};

constexpr std::array<std::pair<std::string_view, std::string_view>, 6> prefixes_in_words{
    {{"kilo", "k"}, {"milli", "m"}, {"micro", "u"}, {"nano", "n"}, {"centi", "c"}, {"mega", "M"}}};

/// Ways to write turns a minute, in lower case.
constexpr std::array<std::string_view, 4> turns_per_minute{"u/min", "rev/min", "r/min", "turns/min"};

/// Characters that a unit is typeset with.
constexpr std::array<std::pair<std::string_view, std::string_view>, 9> typeset{{{"\u00B7", " "},
                                                                                {"\u22C5", " "},
                                                                                {"\u00D7", " "},
                                                                                {"\u00B9", "1"},
                                                                                {"\u00B2", "2"},
                                                                                {"\u00B3", "3"},
                                                                                {"\u207B", "-"},
                                                                                {"\u2212", "-"},
                                                                                {"\u00BA", "\u00B0"}}};

std::string without_typesetting(std::string text) {
  for (const auto& [typed, plain] : typeset)
    for (std::size_t at = text.find(typed); at != std::string::npos; at = text.find(typed, at))
      text.replace(at, typed.size(), plain);
  return text;
}

/// A known unit that a word may mean, and the size of the word's in it.
struct Meaning {
  std::string unit;
  double size = 1;
};

std::optional<Meaning> other_name(std::string_view word) {
  for (const std::string_view name : {word, word.substr(0, word.size() - (word.size() > 2 && word.ends_with('s')))}) {
    const auto found = std::ranges::find(other_unit_names, name, &UnitName::name);
    if (found != other_unit_names.end()) return Meaning{std::string(found->unit), found->size};
  }
  for (const auto& [in_words, prefix] : prefixes_in_words)
    if (word.starts_with(in_words) && word.size() > in_words.size())
      if (auto meant = other_name(word.substr(in_words.size())); meant && meant->size == 1 && meant->unit.size() == 1)
        return Meaning{std::string(prefix) + meant->unit};
  return std::nullopt;
}

/// A symbol, with a prefix or without, that differs in capitals.
std::optional<Meaning> in_other_case(const std::string& word) {
  std::vector<std::string_view> all{""};
  for (const Prefix& prefix : unit_prefixes()) all.push_back(prefix.name);
  for (const std::string_view prefix : all)
    for (const Symbol& symbol : unit_symbols()) {
      std::string name = std::string(prefix).append(symbol.name);
      if (lower_case(name) == word && (prefix.empty() || symbol.takes_prefix)) return Meaning{std::move(name)};
    }
  return std::nullopt;
}

/// Two symbols without a blank between, as "Ns".
std::optional<Meaning> run_together(std::string_view word) {
  for (std::size_t i = 1; i < word.size(); ++i)
    if (unit_of_word(word.substr(0, i)) && unit_of_word(word.substr(i)))
      return Meaning{std::string(word.substr(0, i)) + ' ' + std::string(word.substr(i))};
  return std::nullopt;
}

std::optional<Meaning> meaning_of(std::string_view word) {
  if (unit_of_word(word)) return Meaning{std::string(word)};
  const std::string lower = lower_case(word);
  if (auto named = other_name(lower)) return named;
  if (auto product = run_together(word)) return product;
  return in_other_case(lower);
}

/// Reads products, quotients and brackets of words, as far as they mean units.
class UnitReader {
 public:
  /// Whether all of a text was read; its factors divide if `sign` is -1.
  bool read(std::string_view text, int sign) {
    for (bool divides = false; !text.empty();) {
      const char next = text.front();
      if (next == ' ' || next == '*' || next == '/') {
        divides = divides || next == '/';
        text.remove_prefix(1);
        continue;
      }
      if (!(next == '(' ? read_bracket(text, divides ? -sign : sign) : read_word(text, divides ? -sign : sign)))
        return false;
      divides = false;
    }
    return !above_.empty() || !below_.empty();
  }

  /// "N s/m", as parse_unit reads it.
  [[nodiscard]] std::string unit() const { return (above_.empty() ? "1" : above_) + below_; }
  [[nodiscard]] double size() const { return size_; }

 private:
  bool read_bracket(std::string_view& text, int sign) {
    std::size_t end = 1;
    for (int depth = 1; end < text.size(); ++end)
      if ((depth += (text[end] == '(') - (text[end] == ')')) == 0) break;
    const bool done = read(text.substr(1, end - 1), sign);
    text.remove_prefix(std::min(end + 1, text.size()));
    return done;
  }

  bool read_word(std::string_view& text, int sign) {
    const std::size_t end = std::min(text.find_first_of(" */^()-+0123456789"), text.size());
    const std::optional<Meaning> meant = end == 0 ? std::nullopt : meaning_of(text.substr(0, end));
    text.remove_prefix(end);
    const int power = take_power(text);
    if (!meant || power == 0) return false;
    size_ *= std::pow(meant->size, sign * power);
    add(meant->unit, sign * power);
    return true;
  }

  /// The power at the beginning of a text, 1 if there is none.
  static int take_power(std::string_view& text) {
    if (text.starts_with('^')) text.remove_prefix(1);
    int power = 1;
    const auto [rest, error] = std::from_chars(text.data(), text.data() + text.size(), power);
    if (error == std::errc{}) text.remove_prefix(static_cast<std::size_t>(rest - text.data()));
    return power;
  }

  /// Multiplies by a power of one or several symbols with blanks between.
  void add(std::string_view symbols, int power) {
    for (std::size_t begin = 0; begin < symbols.size();) {
      const std::size_t end = std::min(symbols.find(' ', begin), symbols.size());
      std::string factor(symbols.substr(begin, end - begin));
      if (std::abs(power) > 1) factor += std::to_string(std::abs(power));
      if (power > 0)
        (above_ += above_.empty() ? "" : " ") += factor;
      else
        below_ += '/' + factor;
      begin = end + 1;
    }
  }

  std::string above_, below_;
  double size_ = 1;
};

bool is_of(std::string_view unit, Quantity quantity) {
  const std::optional<Unit> parsed = parse_unit(unit);
  return parsed && fits(*parsed, quantity);
}

}  // namespace

std::string unit_hint(std::string_view text, Quantity quantity) {
  constexpr std::size_t longest = 64;  // bytes
  if (text.size() > longest) return {};
  if (std::ranges::find(turns_per_minute, lower_case(text)) != turns_per_minute.end())
    return is_of("rpm", quantity) ? "; did you mean 'rpm'?" : "";
  UnitReader reading;
  if (!reading.read(without_typesetting(std::string(text)), 1) || !is_of(reading.unit(), quantity)) return {};
  if (reading.size() == 1) return "; did you mean '" + reading.unit() + "'?";
  return "; 1 " + std::string(text) + " is " + number_text(reading.size()) + ' ' + reading.unit();
}

}  // namespace clatter::config
