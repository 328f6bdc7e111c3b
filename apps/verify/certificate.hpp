#pragma once

#include <algorithm>
#include <array>
#include <compare>
#include <optional>
#include <stdexcept>
#include <string>
#include <variant>
#include <vector>

#include "event.hpp"

namespace verify {

/// A malformed certificate; `what()` names the field and how to fix it.
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
  /// Whether they are in this order, or the same, exactly.
  friend std::strong_ordering operator<=>(const Number& a, const Number& b);
  friend bool operator==(const Number& a, const Number& b) { return std::is_eq(a <=> b); }

 private:
  std::variant<double, std::string> value_ = 0.0;
};

/// A value and how far the true one may be from it.
struct Claimed {
  Number value, error;

  [[nodiscard]] Ball earliest() const { return value.ball() - error.ball(); }
  [[nodiscard]] Ball latest() const { return value.ball() + error.ball(); }
};

enum class SpecialKind { fold, flip, symmetry_breaking, graze, impact_speed, impact_power };
[[nodiscard]] const char* name_of(SpecialKind kind);

struct ClaimedEvent {
  Kind kind = Kind::impact;
  Side side = Side::lower;
  Claimed time, v;               ///< v: not of graze, chatter, rest and press; of a loose mass z'
  std::optional<Claimed> until;  ///< of chatter, rest, stick, press and hold
  std::optional<Claimed> x{};    ///< of reversal and stick; of turn and hold z
  bool of_wall = false;          ///< of the housing of a loose mass
};

/// A claimed word.
struct Word {
  std::string text;
  std::vector<std::string> letters;  ///< L, U, L*, U*, of walls beside stops l, u, l*, u*; none: of motion without any
  bool is_cut = false;               ///< they are only the first ones
};

/// One line of a file, in the terms of the README.md of this folder.
struct Certificate {
  /// Restitution that depends on the speed of an impact.
  struct LawNumbers {
    struct Knot {
      Number speed, R;  ///< the speed in units
    };
    Number R;
    std::optional<Number> exponent{};
    Number reference_speed{1.0}, below{};
    std::vector<Knot> table{};  ///< in place of R
    Number unit{1.0};

    [[nodiscard]] Law in_balls() const;
  };
  struct StopNumbers {
    Number position;
    bool soft = false;
    Number R, stiffness, damping;
    std::optional<LawNumbers> law{};  ///< in place of R
  };
  struct LooseNumbers {
    Number mass;
    std::array<Number, 2> R;  ///< [wall]
    Number load;
    std::array<std::optional<Number>, 2> walls;
    Number friction{}, friction_static{};
    std::array<std::optional<LawNumbers>, 2> laws{};  ///< [wall] in place of R
  };
  /// A further order of the force; of the first one the cosine alone, whose sine is f.
  struct OrderNumbers {
    int order;
    Number sine, cosine;
  };
  struct SceneNumbers {
    Number h, k, f, nu, load, phase;
    std::array<std::optional<StopNumbers>, 2> stops;
    Number friction{}, friction_static{};
    std::optional<LooseNumbers> loose{};
    std::vector<OrderNumbers> orders{};  ///< as slopes those of the scene's, in the same places

    [[nodiscard]] bool has_force() const {
      return f != Number() || std::ranges::any_of(orders, [](const OrderNumbers& order) {
               return order.sine != Number() || order.cosine != Number();
             });
    }
    /// Whether the main mass has events of its own, beside which walls are told from stops.
    [[nodiscard]] bool has_stops() const { return stops[0] || stops[1] || friction_static != Number(); }
  };
  /// A special point of a family of scenes.
  struct Special {
    SpecialKind kind = SpecialKind::fold;
    Claimed parameter;
    SceneNumbers slopes;  ///< of the scene's numbers by the parameter
  };
  struct End {
    Number time;
    Claimed x, v;
    Claimed z, w;  ///< of a loose mass
  };

  std::string place;                      ///< name, point and parameters, for messages
  std::vector<std::string> for_people{};  ///< members of which nothing is proved
  SceneNumbers scene;
  bool periodic = false;  ///< special points are of periodic motion, too
  long periods = 0;
  Number start_time;
  Claimed start_x, start_v;  ///< without an error in a transient
  Claimed start_z, start_w;  ///< likewise, of a loose mass
  std::optional<Side> released;
  std::optional<Side> pressed;  ///< the wall that presses a loose mass at the start
  std::vector<ClaimedEvent> events;
  std::optional<Claimed> x_min, x_max;
  std::optional<End> end;
  std::optional<Word> word;
  std::optional<bool> symmetric;
  std::optional<Special> special;
  std::optional<std::vector<std::array<Number, 3>>> multipliers;  ///< real part, imaginary part, error

  [[nodiscard]] Scene scene_in_balls() const;
  /// The scene of a special point at some values of the parameter, less the claimed one.
  [[nodiscard]] MovingScene moving_scene(const Ball& offset) const;
  [[nodiscard]] Start start_in_balls() const;
  /// The values of a special point's parameter that the scene says it is at: those of its numbers that have the slope
  /// 1, and less those that have the slope -1. Nothing: the scene doesn't say.
  [[nodiscard]] std::vector<Ball> values_of_parameter() const;
};

/// A line that begins a list of certificates, or ends it and counts those since its beginning, or since that of the
/// file. Without it nobody would miss what is cut off at the end of a line.
struct ListLine {
  bool begins = false;
  std::size_t certificates = 0;
};
/// Nothing if the line is no such one. Throws FormatError.
[[nodiscard]] std::optional<ListLine> read_list_line(const std::string& line);

/// Reads a line of a file. Throws FormatError.
[[nodiscard]] Certificate read_certificate(const std::string& line);

}  // namespace verify
