#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "attractors/numbering.hpp"
#include "point/point.hpp"
#include "results/dataset.hpp"
#include "sweep/output_variables.hpp"
#include "sweep/share.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// The results of all points of a run, by their local index (`Share`), and the dataset that they make.
class ResultStore {
 public:
  /// Makes room for the results of a whole sweep, or of a shard. Throws std::bad_alloc.
  explicit ResultStore(const Sweep& sweep, const std::optional<results::Shard>& shard = {});

  /// Stores a point's result, which is in `units`, in those of the user; different points may be stored at the same
  /// time.
  void store(std::size_t local_index, point::PointResult&& result, const Units& units);

  /// Bytes that `pack` appends for a point, at most.
  [[nodiscard]] std::size_t most_packed(std::size_t local_index) const;
  [[nodiscard]] std::size_t most_packed_without_log() const;
  /// Appends a point's results, as `unpack` takes them from a run of the same sweep.
  void pack(std::size_t local_index, std::vector<std::byte>& to) const;
  /// Takes a point's results off the beginning of `from`. Returns false if they don't belong to this sweep; the point's
  /// values are then unspecified.
  [[nodiscard]] bool unpack(std::size_t local_index, std::span<const std::byte>& from);

  /// Moves the results of a shard's dataset into those of the whole sweep. Throws std::runtime_error if the dataset
  /// isn't that of the shard; the values of its points are then unspecified.
  void take(results::Dataset& dataset, const results::Shard& shard);

  /// The dataset over the sweep's axes, or over the points of a shard. Empties the store.
  [[nodiscard]] results::Dataset dataset();

  /// Numbers the motions that the points end in, once all results are there. Throws std::bad_alloc.
  void number_motions(int threads);

  /// The variables of such a sweep without results: names, dimensions, meanings. There is one motion if attractors are
  /// numbered. Empties the store.
  [[nodiscard]] results::Dataset description();

  [[nodiscard]] std::size_t failed_points() const;

 private:
  using Log = std::vector<observables::LoggedImpact>;

  void to_users_units(std::size_t local_index, const Units& units);
  void add_coordinates(results::Dataset& dataset) const;
  void add_always(results::Dataset& dataset);
  void add_impact_log(results::Dataset& dataset);
  [[nodiscard]] std::vector<double>& values_of(std::string_view output);
  void take_impact_log(results::Dataset& dataset, std::span<const std::int64_t> numbers);

  const Sweep& sweep_;
  std::optional<results::Shard> shard_;
  Share share_;
  std::vector<std::string> along_;  ///< dimensions of a variable with one value a point
  std::vector<std::uint8_t> status_;
  std::vector<std::int64_t> impacts_;
  std::vector<double> periods_;
  std::vector<OutputVariable> outputs_;
  std::vector<std::vector<double>> values_;      ///< [output][local index][width]; empty for texts
  std::vector<std::vector<std::string>> texts_;  ///< [output][local index]; empty for numbers
  std::vector<Log> log_;                         ///< [local index]; empty if no log is observed
  std::optional<attractors::Numbering> numbering_;
};

}  // namespace clatter::sweep
