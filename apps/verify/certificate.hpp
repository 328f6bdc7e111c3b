#pragma once

#include <array>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "motion.hpp"

namespace verify {

/// A malformed certificate; `what()` names the field and the way out.
class FormatError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A number as a certificate gives it: a double, or a decimal number in a text.
class Number {
 public:
  Number() = default;
  explicit Number(double value) : value_(value) {}
  explicit Number(std::string text) : value_(std::move(text)) {}

  [[nodiscard]] Ball ball() const;  ///< in the precision of the thread
  [[nodiscard]] std::string text() const;

 private:
  std::variant<double, std::string> value_ = 0.0;
};

/// A value and how far the true one may be from it.
struct Claimed {
  Number value, error;
};

struct ClaimedEvent {
  Kind kind = Kind::impact;
  Side side = Side::lower;
  Claimed time, v;               ///< v: not of chatter and rest
  std::optional<Claimed> until;  ///< of chatter and rest
};

/// One line of a file, in the terms of the README.md of this folder.
struct Certificate {
  struct StopNumbers {
    Number position;
    bool soft = false;
    Number R, stiffness, damping;
  };
  struct SceneNumbers {
    Number h, k, f, nu, load, phase;
    std::array<std::optional<StopNumbers>, 2> stops;
  };
  struct End {
    Number time;
    Claimed x, v;
  };

  std::string place;  ///< point and parameters, for messages
  SceneNumbers scene;
  bool periodic = false;
  long periods = 0;
  Number start_time;
  Claimed start_x, start_v;  ///< without an error in a transient
  std::optional<Side> released;
  std::vector<ClaimedEvent> events;
  std::optional<Claimed> x_min, x_max;
  std::optional<End> end;
  std::optional<std::string> word;
  std::optional<bool> symmetric;
  std::optional<std::array<std::array<Number, 3>, 2>> multipliers;  ///< real part, imaginary part, error

  [[nodiscard]] Scene scene_in_balls() const;
  [[nodiscard]] Start start_in_balls() const;
};

/// Reads a line of a file. Throws FormatError.
[[nodiscard]] Certificate read_certificate(const std::string& line);

}  // namespace verify
