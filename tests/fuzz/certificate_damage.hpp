#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <nlohmann/json.hpp>
#include <random>
#include <string>
#include <vector>

namespace clatter::fuzz {

/// Changes of a JSON value that leave it JSON: bytes changed at random rarely do.
class CertificateDamage {
 public:
  using Json = nlohmann::json;

  explicit CertificateDamage(unsigned seed) : random_(seed) {}

  /// Changes one of all values in it, at any depth.
  void apply(Json& root) {
    std::vector<Json*> all;
    collect(root, all);
    Json& chosen = *all[below(all.size())];
    if (chosen.is_object())
      change_object(chosen);
    else if (chosen.is_array())
      change_array(chosen);
    else if (chosen.is_boolean())
      chosen = !chosen.get<bool>();
    else if (chosen.is_string() && below(4) != 0)
      chosen = one_of(texts);
    else
      chosen = changed(chosen.is_number() ? chosen.get<double>() : 0);
  }

 private:
  static constexpr std::array texts{"lower",
                                    "upper",
                                    "impact",
                                    "touch",
                                    "separation",
                                    "renewal",
                                    "graze",
                                    "chatter",
                                    "rest",
                                    "periodic",
                                    "transient",
                                    "special",
                                    "fold",
                                    "flip",
                                    "symmetry breaking",
                                    "maximum impact_speed",
                                    "maximum impact_power",
                                    "L",
                                    "U*",
                                    "LU",
                                    "a\n\x1B[2J",
                                    "0.1",
                                    "1e-400",
                                    "1e99999999",
                                    "-0",
                                    "1e-12",
                                    "0.30000000000000000000000000001"};
  static constexpr std::array members{
      "released", "until", "time",  "x",    "v",         "lower",       "upper",   "R",      "stiffness", "damping",
      "position", "x_min", "x_max", "word", "symmetric", "multipliers", "kind",    "slopes", "parameter", "h",
      "k",        "f",     "nu",    "load", "phase",     "name",        "periods", "claim",  "event",     "stop"};

  static void collect(Json& value, std::vector<Json*>& all) {
    all.push_back(&value);
    if (value.is_structured())
      for (Json& item : value) collect(item, all);
  }
  std::size_t below(std::size_t count) { return random_() % count; }
  template <std::size_t N>
  const char* one_of(const std::array<const char*, N>& list) {
    return list[below(N)];
  }

  /// Another number: near, far, special, or the same as a text.
  Json changed(double value) {
    switch (below(10)) {
      case 0:
        return 0;
      case 1:
        return -value;
      case 2:
        return value * std::ldexp(1.0, static_cast<int>(below(120)) - 60);
      case 3:
        return value == 0 ? 1e-12 : std::nextafter(value, std::numeric_limits<double>::infinity());
      case 4:
        return std::round(value);
      case 5:
        return below(5);
      case 6:
        return Json(value).dump();
      case 7:
        return one_of(texts);
      case 8:
        return value + static_cast<double>(below(200)) / 100 - 1;
      default:
        return value * (1 + std::ldexp(static_cast<double>(below(200)) - 100, -static_cast<int>(below(50))));
    }
  }

  void change_object(Json& object) {
    if (below(2) == 0 && !object.empty()) {
      object.erase(std::next(object.begin(), static_cast<std::ptrdiff_t>(below(object.size()))));
      return;
    }
    Json& added = object[one_of(members)];
    switch (below(5)) {
      case 0:
        added = one_of(texts);
        return;
      case 1:
        added = changed(1);
        return;
      case 2:
        added = below(2) == 0;
        return;
      case 3:
        added = Json::object();
        return;
      default:
        added = {changed(1), 1e-9};
    }
  }

  void change_array(Json& array) {
    if (array.empty()) return array.push_back(changed(1));
    const auto at = [&] { return array.begin() + static_cast<std::ptrdiff_t>(below(array.size())); };
    switch (below(3)) {
      case 0:
        array.erase(at());
        return;
      case 1:
        array.push_back(Json(*at()));
        return;
      default:
        std::swap(*at(), *at());
    }
  }

  std::minstd_rand random_;
};

}  // namespace clatter::fuzz
