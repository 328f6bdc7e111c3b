#include "observables/contacts/impact_word.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "observables/contacts/impact_word_observer.hpp"

namespace clatter::observables {
namespace {

using Contact = ImpactWord::Contact;

/// The letters of a word in the order in which texts of them sort.
enum class Letter : unsigned char {
  lower_ending_in_rest,
  lower,
  stick,
  upper_ending_in_rest,
  upper,
  lower_wall_ending_in_press,
  lower_wall,
  upper_wall_ending_in_press,
  upper_wall
};
constexpr std::array<std::string_view, 9> letter_texts{"L*", "L", "S", "U*", "U", "l*", "l", "u*", "u"};
constexpr std::string_view cut = "…";

Letter letter_of(const Contact& contact) {
  const bool upper = contact.side == Side::upper;
  if (contact.is_of_wall) return upper ? Letter::upper_wall : Letter::lower_wall;
  return upper ? Letter::upper : Letter::lower;
}
/// It stands before that of an impact.
Letter ending_in_rest(Letter impact) { return static_cast<Letter>(static_cast<unsigned char>(impact) - 1); }

/// The letters of one period. They begin after a rest, if there is one, so that no series of impacts that ends in rest
/// is cut in two.
std::vector<Letter> letters_of(std::vector<Contact> contacts) {
  const auto last_rest =
      std::find_if(contacts.rbegin(), contacts.rend(), [](const Contact& c) { return c.before == 0; });
  std::rotate(contacts.begin(), last_rest == contacts.rend() ? contacts.begin() : last_rest.base(), contacts.end());
  std::vector<Letter> letters;
  for (const Contact& contact : contacts) {
    const Letter impact = letter_of(contact), in_rest = ending_in_rest(impact);
    if (contact.side == Side::none) {
      letters.push_back(Letter::stick);
    } else if (contact.before != 0) {
      letters.push_back(impact);
    } else if (!letters.empty() && letters.back() == impact) {  // else a rest that goes on
      while (!letters.empty() && letters.back() == impact) letters.pop_back();
      letters.push_back(in_rest);
    }
  }
  return letters;
}

/// Where the rotation begins that sorts first. Of two candidates that have some items in common, the one that is
/// greater after them is given up, and with it every rotation that begins among them.
template <class T>
std::size_t first_rotation(const std::vector<T>& items) {
  const std::size_t count = items.size();
  std::size_t one = 0, other = 1, same = 0;  // the candidates, and how many items they have in common
  while (one < count && other < count && same < count) {
    const T &a = items[(one + same) % count], &b = items[(other + same) % count];
    if (a == b) {
      ++same;
      continue;
    }
    (a > b ? one : other) += same + 1;
    if (one == other) ++other;
    same = 0;
  }
  return std::min(one, other);
}

}  // namespace

std::vector<Column<ImpactWord::Values>> ImpactWord::columns(const Settings& settings) {
  std::string letters = "impacts of one period in order, L: lower stop, U: upper stop, *: until at rest";
  if (settings.word_walls) letters += "; l, u: walls of the loose mass, *: until pressed";
  if (settings.word_sticks) letters += "; S: stick";
  return {missing_if("no period is known", text("impact_word", letters, &Values::impact_word, longest + cut.size())),
          missing_if("no period is known, or there is no force",
                     text("regime", "impacts on the stop with more of them / forcing periods", &Values::regime, 40)),
          missing_if("no period is known, or the scene isn't symmetric",
                     scalar("symmetric", "1: half a period later the motion is its mirror image", &Values::symmetric))};
}

std::string ImpactWord::word_of(const std::vector<Contact>& contacts, Side within) {
  std::vector<Letter> letters = letters_of(contacts);
  if (letters.empty()) {
    const Side side = contacts.empty() ? within : contacts.front().side;
    if (side == Side::none) return std::string(no_contact);
    const bool is_of_wall = !contacts.empty() && contacts.front().is_of_wall;
    return '(' + std::string(letter_texts[static_cast<std::size_t>(letter_of({0.0, 0.0, side, is_of_wall}))]) + ')';
  }
  std::rotate(letters.begin(), letters.begin() + static_cast<std::ptrdiff_t>(first_rotation(letters)), letters.end());
  std::string word;
  for (const Letter letter : letters) {
    const std::string_view more = letter_texts[static_cast<std::size_t>(letter)];
    if (word.size() + more.size() > longest) return word += cut;
    word += more;
  }
  return word;
}

std::string ImpactWord::regime_of(const std::vector<Contact>& contacts, double periods) {
  std::array<std::size_t, letter_texts.size()> counts{};
  for (const Letter letter : letters_of(contacts)) ++counts[static_cast<std::size_t>(letter)];
  const auto count = [&](Letter letter) { return counts[static_cast<std::size_t>(letter)]; };
  std::size_t most = 0, rests = 0;
  for (const Letter impact : {Letter::lower, Letter::upper, Letter::lower_wall, Letter::upper_wall})
    most = std::max(most, count(impact)), rests += count(ending_in_rest(impact));
  return (rests > 0 ? "inf" : std::to_string(most)) + '/' + std::to_string(std::llround(periods));
}

/// The whole motion follows from the state after one impact: it is its own mirror image if the mirror image of that
/// impact comes half a period later. The force has turned into its mirror image by then if the period is an odd number
/// of its own.
bool ImpactWord::Observer::is_mirrored(const ObservedSpan& span, double x, double v) const {
  if (is_response_) return true;
  if (is_driven(span.scene.oscillator) && std::llround(span.turns) % 2 == 0) return false;
  const auto slower = [](const Contact& a, const Contact& b) { return std::abs(a.before) < std::abs(b.before); };
  const auto fastest = std::ranges::max_element(contacts_, slower);
  if (fastest == contacts_.end() || fastest->before == 0) {
    const double centre = mirror_centre(span.scene).value_or(0.0);
    const PhasePoint later = halfway_.value_or(PhasePoint{x, v});  // it stands still
    if (const LooseMass& loose = span.scene.loose; has_loose_mass(loose)) {
      const double width = loose.upper - loose.lower, off = last_z_ + halfway_z_ - (loose.lower + loose.upper);
      if (!(std::abs(off) <= same * width)) return false;
    }
    return std::abs((x - centre) + (later.x - centre)) + std::abs(v + later.v) <=
           same * (std::abs(x - centre) + std::abs(v));
  }
  return std::ranges::any_of(contacts_, [&](const Contact& other) {
    const double late = std::remainder(other.time - fastest->time - span.total / 2, span.total);
    return other.side != fastest->side && other.is_of_wall == fastest->is_of_wall &&
           std::abs(late) <= same * span.total &&
           std::abs(other.before + fastest->before) <= same * std::abs(fastest->before);
  });
}

std::vector<Contact> ImpactWord::Observer::whole_contacts(double total) const {
  std::vector<Contact> contacts = contacts_;
  const bool begins_stuck = !contacts.empty() && contacts.front().side == Side::none && contacts.front().time <= 0;
  if (begins_stuck && contacts.size() > 1 && stuck_until_ >= total * (1 - same_instant))
    contacts.erase(contacts.begin());
  return contacts;
}

ImpactWord::Values ImpactWord::Observer::finish(const ObservedSpan& span, double x, double v) const {
  Values values;
  if (!span.periodic) return values;
  const StopsNow stops(span.scene.stops, span.scene.oscillator.frequency, span.scene.start.phase);
  values.impact_word =
      is_stuck() ? std::string(stuck) : word_of(whole_contacts(span.total), soft_stop_beyond(stops, x));
  if (is_driven(span.scene.oscillator)) values.regime = regime_of(contacts_, span.turns);
  if (is_symmetric(span.scene)) values.symmetric = is_mirrored(span, x, v) ? 1.0 : 0.0;
  return values;
}

}  // namespace clatter::observables
