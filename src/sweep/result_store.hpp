#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "attractors/numbering.hpp"
#include "point/point.hpp"
#include "results/dataset.hpp"
#include "storage/scratch.hpp"
#include "sweep/output_variables.hpp"
#include "sweep/share.hpp"
#include "sweep/status_tally.hpp"
#include "sweep/sweep.hpp"

namespace clatter::sweep {

/// The results of all points of a run, by their local index (`Share`), in a scratch space.
class ResultStore {
 public:
  /// Makes room for the results of a whole sweep, or of a shard. Throws std::bad_alloc, storage::IoError.
  ResultStore(const Sweep& sweep, const std::optional<results::Shard>& shard,
              std::shared_ptr<storage::Scratch> scratch);

  /// Stores a point's result, which is in `units`, in those of the user; different points may be stored at the same
  /// time.
  void store(std::size_t local_index, point::PointResult&& result, const Units& units);

  /// Bytes that `pack` appends for a point, at most.
  [[nodiscard]] std::size_t most_packed(std::size_t local_index) const;
  [[nodiscard]] std::size_t most_packed_without_log() const { return most_packed_without_log_; }
  /// Appends a point's results, as `unpack` takes them from a run of the same sweep.
  void pack(std::size_t local_index, std::vector<std::byte>& to) const;
  /// Takes a point's results off the beginning of `from`. Returns false if they don't belong to this sweep; the point's
  /// values are then unspecified.
  [[nodiscard]] bool unpack(std::size_t local_index, std::span<const std::byte>& from);

  /// Numbers the motions that the points end in, once all results are there. Throws std::bad_alloc.
  void number_motions(int threads);

  /// The dataset over the sweep's axes, or over the points of a shard. Its values are taken from the store while they
  /// are written, each once.
  [[nodiscard]] results::Dataset dataset();

  [[nodiscard]] StatusTally statuses() const;

 private:
  using Column = std::shared_ptr<const storage::Region>;
  /// The numbers in a column, so many a point.
  struct Rows {
    double* begin;
    std::size_t width;
  };

  /// What a point has of a length of its own, a text or a log: the number of its parts, and behind it the parts. A null
  /// pointer is nothing.
  using Kept = const std::uint64_t*;
  template <class Part>
  static std::span<const Part> parts_of(Kept kept) {
    return kept == nullptr ? std::span<const Part>() : std::span(reinterpret_cast<const Part*>(kept + 1), *kept);
  }
  template <class Part>
  [[nodiscard]] Kept keep(std::span<const Part> parts);

  void to_users_units(std::size_t local_index, const Units& units);
  [[nodiscard]] std::span<double> values(std::size_t output, std::size_t local_index) const {
    return {rows_[output].begin + local_index * rows_[output].width, rows_[output].width};
  }
  [[nodiscard]] std::span<Kept> texts(std::size_t output) const { return columns_[output]->as<Kept>(); }
  [[nodiscard]] std::span<Kept> logs() const { return log_->as<Kept>(); }
  [[nodiscard]] std::size_t logged() const;
  [[nodiscard]] results::NextValues values_of(std::string_view variable);
  [[nodiscard]] std::span<const double> numbers_of(std::string_view output) const;

  const Sweep& sweep_;
  std::optional<results::Shard> shard_;
  Share share_;
  std::shared_ptr<storage::Scratch> scratch_;
  std::shared_ptr<storage::Arena> arena_;  ///< of texts and logs
  std::vector<OutputVariable> outputs_;
  Column status_;                ///< std::uint8_t [local index]
  Column impacts_;               ///< std::int64_t [local index]
  Column periods_;               ///< double [local index]
  std::vector<Column> columns_;  ///< [output]: double [local index][width], of a text Kept [local index]
  std::vector<Rows> rows_;       ///< [output]: the numbers in its column
  Column log_;                   ///< Kept [local index]; none if no log is observed
  std::size_t most_packed_without_log_ = 0;
  std::size_t pages_of_point_ = 0;  ///< that storing one touches, at most
  std::optional<attractors::Numbering> numbering_;
};

}  // namespace clatter::sweep
