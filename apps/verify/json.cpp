#include "json.hpp"

#include <set>
#include <vector>

#include "certificate.hpp"
#include "deadline.hpp"

namespace verify {
namespace {

/// A certificate nests four deep, and what is for people may be in objects of its own.
constexpr std::size_t most_nested = 8;
/// An event has 11 values at most, and two numbers of 16 digits or more: a line of 16 MiB has room for fewer.
constexpr std::size_t most_values = 2'000'000;

/// Looks at all that a line holds before any of it is kept, in memory that doesn't grow with the line.
class Look : public Json::json_sax_t {
 public:
  bool null() override { return value(); }
  bool boolean(bool) override { return value(); }
  bool number_integer(number_integer_t) override { return value(); }
  bool number_unsigned(number_unsigned_t) override { return value(); }
  bool number_float(number_float_t, const string_t&) override { return value(); }
  bool string(string_t&) override { return value(); }
  bool binary(binary_t&) override { return value(); }
  bool start_array(std::size_t) override { return value() && nest(); }
  bool end_array() override { return names_.pop_back(), true; }
  bool start_object(std::size_t) override { return value() && nest(); }
  bool end_object() override { return names_.pop_back(), true; }
  bool key(string_t& name) override {
    if (!names_.back().insert(name).second)
      throw FormatError("the line has the member " + shown(name) + " twice in an object; keep one");
    return true;
  }
  bool parse_error(std::size_t, const std::string&, const Json::exception& error) override {
    throw FormatError(std::string("is no JSON (") + error.what() + "); write one object a line");
  }

 private:
  bool value() {
    require_time();
    if (++values_ > most_values)
      throw FormatError("the line holds more than " + std::to_string(most_values) +
                        " values; write a certificate of fewer events");
    return true;
  }
  bool nest() {
    names_.emplace_back();
    if (names_.size() > most_nested)
      throw FormatError("the line nests more than " + std::to_string(most_nested) +
                        " objects and arrays; write one as the guide shows");
    return true;
  }

  std::vector<std::set<std::string>> names_{};  ///< of the members so far, in each object that isn't closed
  std::size_t values_ = 0;
};

}  // namespace

std::string shown(const std::string& text) {
  const std::string escaped = Json(text.substr(0, 40)).dump(-1, ' ', true, Json::error_handler_t::replace);
  std::string quoted(escaped);
  quoted.front() = quoted.back() = '\'';
  return quoted;
}

Json json_of(const std::string& line) {
  Look look;
  Json::sax_parse(line, &look);
  return Json::parse(line);
}

}  // namespace verify
