#pragma once

#include <hdf5.h>

#include <cstddef>
#include <functional>
#include <vector>

#include "results/hdf5_handle.hpp"

namespace clatter::results::detail {

/// Lengths of dimensions, the slowest first.
using Shape = std::vector<hsize_t>;

[[nodiscard]] Shape shape_of(hid_t dataset);
[[nodiscard]] Handle space_of(const Shape& shape);

[[nodiscard]] std::size_t count(const Shape& shape);

/// The size of the chunk cache that every reader has: larger chunks are inflated again for every access.
inline constexpr std::size_t largest_block = 1024UL * 1024;  // bytes

/// The most bytes that one byte of a deflated file can give (zlib's technical details).
inline constexpr double most_deflated = 1032;

/// The shape of the blocks in which an array is written and read: as many of the fastest dimensions as fit whole, the
/// next one in equal parts, so that no block is mostly empty.
[[nodiscard]] Shape blocks_of(const Shape& shape, std::size_t value_size);

/// Calls `visit(space, number of values)` for each block of an array, in the order of its values: `space` is that of
/// the array with the block selected.
void each_block(const Shape& shape, std::size_t value_size,
                const std::function<void(hid_t space, std::size_t values)>& visit);

/// The space of so many values in memory.
[[nodiscard]] Handle room_for(std::size_t values);

/// The number of values in the largest block of a variable: its memory, where a whole megabyte would be zeroed for a
/// few numbers each time.
[[nodiscard]] std::size_t values_in_block(hid_t dataset, std::size_t value_size);

/// Reads a variable block by block into `memory` for `values_in_block`, as values of `type` and with the properties
/// `transfer`, and calls `take(number of values)` after each. Throws Failure.
void read_blocks(hid_t dataset, hid_t type, void* memory, const std::function<void(std::size_t)>& take,
                 hid_t transfer = H5P_DEFAULT);

}  // namespace clatter::results::detail
