#pragma once

#include <cstddef>
#include <vector>

#include "scene/force_orders.hpp"

namespace clatter {
inline namespace scene {

/// One period of a force as it was measured, with straight lines between its rows: s of a force f s(theta), the values
/// over the largest of them.
class ForceTable {
 public:
  /// A row, or two at the same time, between which the force jumps.
  struct Knot {
    double turns;          ///< its phase; the first is 0, they rise, and stay below 1
    double before, after;  ///< the force up to there, and from there on, in any unit; not all are 0
    friend bool operator==(const Knot&, const Knot&) = default;
  };

  explicit ForceTable(std::vector<Knot> knots);

  [[nodiscard]] const std::vector<Knot>& knots() const { return knots_; }
  [[nodiscard]] double peak() const { return peak_; }            ///< largest |force|
  [[nodiscard]] double least() const { return least_; }          ///< of s
  [[nodiscard]] double most() const { return most_; }            ///< of s
  [[nodiscard]] double mean() const { return mean_; }            ///< of s
  [[nodiscard]] double steepest() const { return steepest_; }    ///< largest |ds/dtheta|
  [[nodiscard]] bool is_odd_by_half() const { return is_odd_; }  ///< s(theta + pi) = -s(theta)

  /// Its mean and orders 1 ... `count`, in the unit of the rows, and the share of its mean square that they leave out.
  struct Harmonics {
    double mean;
    ForceOrders<double> orders;
    double left_out;
  };
  [[nodiscard]] Harmonics harmonics(std::size_t count) const;

  friend bool operator==(const ForceTable& one, const ForceTable& other) { return one.knots_ == other.knots_; }

 private:
  std::vector<Knot> knots_;
  double peak_ = 0.0, least_ = 0.0, most_ = 0.0, mean_ = 0.0, steepest_ = 0.0;
  bool is_odd_ = false;
};

/// A table that lasts as long as the program, the same one for equal tables: scenes are copied often, and by all
/// threads.
[[nodiscard]] const ForceTable* kept(ForceTable table);

}  // namespace scene
}  // namespace clatter
