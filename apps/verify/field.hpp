#pragma once

#include <cmath>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <unordered_set>
#include <utility>
#include <vector>

#include "certificate.hpp"
#include "deadline.hpp"
#include "json.hpp"

namespace verify {

/// Whether a text is a decimal number: [+-] digits [. digits] [e [+-] digits], with a digit before or after the point.
inline bool is_decimal(const std::string& text) {
  std::size_t at = 0;
  const auto take = [&](const char* any, std::size_t most) {
    const std::size_t begin = at;
    while (at < text.size() && at - begin < most && std::strchr(any, text[at]) != nullptr && text[at] != '\0') ++at;
    return at - begin;
  };
  constexpr const char* digits = "0123456789";
  take("+-", 1);
  std::size_t mantissa = take(digits, text.size());
  if (take(".", 1) > 0) mantissa += take(digits, text.size());
  if (mantissa == 0) return false;
  if (take("eE", 1) > 0) {
    take("+-", 1);
    if (take(digits, text.size()) == 0) return false;
  }
  return at == text.size();
}

/// The values of a certificate that have been read.
using ReadValues = std::unordered_set<const Json*>;

/// A value of a certificate and its place in it.
class Field {
 public:
  Field(const Json& json, std::string path, ReadValues& read) : json_(json), path_(std::move(path)), read_(&read) {
    read.insert(&json);
  }

  [[noreturn]] void refuse(const std::string& found, const std::string& way_out) const {
    throw FormatError(path_ + ": " + found + "; " + way_out);
  }
  [[nodiscard]] std::optional<Field> find(const std::string& name) const {
    require_object();
    const auto member = json_.find(name);
    if (member == json_.end()) return std::nullopt;
    return Field(*member, path_.empty() ? name : path_ + "." + name, *read_);
  }
  [[nodiscard]] Field get(const std::string& name) const {
    if (const auto member = find(name)) return *member;
    Field(json_, path_.empty() ? name : path_ + "." + name, *read_).refuse("is missing", "add it");
  }
  /// A value that is for people alone, whatever it holds.
  [[nodiscard]] std::optional<Field> find_for_people(const std::string& name) const {
    auto member = find(name);
    if (member) member->read_all(member->json_);
    return member;
  }
  /// Throws FormatError if there is a member, at any depth, that nothing has read: nobody would look at what it claims.
  void require_all_read() const {
    if (json_.is_array())
      for (const Field& item : items()) item.require_all_read();
    if (!json_.is_object()) return;
    for (const auto& [name, value] : json_.items()) {
      if (read_->count(&value) == 0) refuse_member(name, "has no meaning here", "leave it out");
      Field(value, path_.empty() ? name : path_ + "." + name, *read_).require_all_read();
    }
  }
  void require_object() const {
    if (!json_.is_object()) refuse("is no object", "write {...}");
  }
  [[nodiscard]] std::vector<Field> items() const {
    if (!json_.is_array()) refuse("is no array", "write [...]");
    std::vector<Field> list;
    for (std::size_t i = 0; i < json_.size(); ++i) {
      require_time();
      list.emplace_back(json_[i], path_ + "[" + std::to_string(i) + "]", *read_);
    }
    return list;
  }
  [[nodiscard]] std::string text() const {
    if (!json_.is_string()) refuse("is no text", "write it in quotes");
    return json_.get<std::string>();
  }
  [[nodiscard]] bool flag() const {
    if (!json_.is_boolean()) refuse("is neither true nor false", "write one of them");
    return json_.get<bool>();
  }
  [[nodiscard]] Number number() const {
    if (json_.is_number()) {
      const double value = json_.get<double>();
      if (!std::isfinite(value)) refuse("is beyond double", "write a decimal number in quotes");
      return Number(value);
    }
    if (!json_.is_string()) refuse("is no number", "write a number, or a decimal number in quotes");
    const std::string text = json_.get<std::string>();
    Ball ball;
    if (text.size() > 400 || !is_decimal(text) || !Ball::read(text, ball))
      refuse(shown(text) + " is no decimal number", "write e.g. \"0.1\"");
    if (!(abs(ball) < Ball(1e300)) || !(abs(ball) > Ball(1e-300) || ball.is_zero()))
      refuse(shown(text) + " is beyond 1e-300 to 1e300", "change the units");
    return Number(text);
  }
  [[nodiscard]] Number number_from(double least, double most, bool with_least = true) const {
    const Number value = number();
    const auto above_least = value <=> Number(least);
    if (above_least < 0 || (above_least == 0 && !with_least) || (std::isfinite(most) && value > Number(most)))
      refuse("is " + value.text(), std::string("it must be ") + (with_least ? "at least " : "above ") +
                                       Number(least).text() +
                                       (std::isfinite(most) ? " and at most " + Number(most).text() : ""));
    return value;
  }
  [[nodiscard]] Claimed claimed() const {
    const auto pair = items();
    if (pair.size() != 2) refuse("has " + std::to_string(pair.size()) + " items", "write [value, error]");
    return {pair[0].number(), pair[1].number_from(0, infinity)};
  }
  [[nodiscard]] long count(long least, long most) const {
    if (!json_.is_number_integer()) refuse("is no whole number", "write " + std::to_string(least) + " or more");
    const auto value = json_.get<std::int64_t>();
    if (value < least || value > most)
      refuse("is out of range", "write " + std::to_string(least) + " to " + std::to_string(most));
    return static_cast<long>(value);
  }
  [[nodiscard]] Side side() const {
    const std::string name = text();
    if (name != "lower" && name != "upper") refuse("is " + shown(name), "write lower or upper");
    return name == "upper" ? Side::upper : Side::lower;
  }
  [[nodiscard]] std::string dump() const { return json_.dump(-1, ' ', false, Json::error_handler_t::replace); }

  static constexpr double infinity = std::numeric_limits<double>::infinity();

 private:
  void read_all(const Json& json) const {
    read_->insert(&json);
    if (json.is_structured())
      for (const Json& item : json) read_all(item);
  }
  /// A name may hold anything, and so is no part of a place.
  [[noreturn]] void refuse_member(const std::string& name, const std::string& found, const std::string& way_out) const {
    throw FormatError((path_.empty() ? "the line" : path_) + ": the member " + shown(name) + ' ' + found + "; " +
                      way_out);
  }

  const Json& json_;
  std::string path_;
  ReadValues* read_;
};

}  // namespace verify
