#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "point/point.hpp"
#include "sweep/dataset.hpp"
#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// A variable of the results, and how to extract it from a PointResult.
using OutputVariable = observables::Column<point::PointResult>;

/// The variables that a scene's observables give, the impact log and the integer ones aside, and of steady motion the
/// estimate of how long it takes to settle.
[[nodiscard]] std::vector<OutputVariable> outputs_of(const point::Problem& scene);

/// Adds the sweep's dimensions and the coordinates along them.
void add_axes(const Sweep& sweep, Dataset& dataset);

/// Names the axes that are linked to others in the variables over their dimensions, by which readers know them for
/// coordinates (CF conventions, 5). To be called when all variables are there.
void name_linked_axes(const Sweep& sweep, Dataset& dataset);

/// Names of the sweep's dimensions.
[[nodiscard]] std::vector<std::string> axis_names(const Sweep& sweep);

/// Attributes of a `status` that tell what its values mean.
[[nodiscard]] std::vector<Attribute> status_flags();

/// How many values the variables of a sweep or a shard have at most, its impact log aside; an impact in that has four.
[[nodiscard]] double most_values(const Sweep& sweep, const std::optional<Shard>& shard);
inline constexpr double logged_values = 4;

/// The results of all points of a run, by their slots (`Share`), and the figure they make.
class ResultStore {
 public:
  /// Of a whole sweep, or of a shard. Throws std::bad_alloc.
  explicit ResultStore(const Sweep& sweep, const std::optional<Shard>& shard = {});

  /// Stores a point's result; different points may be stored at the same time.
  void store(std::size_t local_index, point::PointResult&& result);

  /// Bytes that `pack` appends for a point.
  [[nodiscard]] std::size_t packed_size(std::size_t local_index) const;
  [[nodiscard]] std::size_t packed_size_without_log() const;
  /// Appends a point's results, as `unpack` takes them from a run of the same sweep.
  void pack(std::size_t local_index, std::vector<std::byte>& to) const;
  /// Takes a point's results off the beginning of `from`; false where they aren't of this sweep, and then nothing is
  /// sure of the point.
  [[nodiscard]] bool unpack(std::size_t local_index, std::span<const std::byte>& from);

  /// Takes the results of a shard from its figure into the columns of the whole sweep. Throws std::runtime_error where
  /// the figure isn't that of the shard; then nothing is sure of its points.
  void take(Dataset& dataset, const Shard& shard);

  /// The figure: over the sweep's axes, that of a shard over its points. The columns are empty afterwards.
  [[nodiscard]] Dataset dataset();

  [[nodiscard]] std::size_t failed_points() const;

 private:
  void add_coordinates(Dataset& dataset) const;
  void add_always(Dataset& dataset);
  void add_impact_log(Dataset& dataset);
  void take_impact_log(Dataset& dataset, std::span<const std::int64_t> numbers);

  const Sweep& sweep_;
  std::optional<Shard> shard_;
  Share share_;
  std::vector<std::string> along_;  ///< the dimensions of what has a value a point
  std::vector<std::uint8_t> status_;
  std::vector<std::int64_t> impacts_;
  std::vector<double> periods_;
  std::vector<OutputVariable> outputs_;
  std::vector<std::vector<double>> values_;       ///< [output][slot][width]
  std::vector<std::vector<motion::Impact>> log_;  ///< [slot], empty where no log is observed
};

}  // namespace clatter::sweep
