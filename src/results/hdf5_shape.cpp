#include "results/hdf5_shape.hpp"

#include <algorithm>

#include "results/hdf5_handle.hpp"

namespace clatter::results::detail {
namespace {

/// Advances to the next block, the fastest dimension first; false after the last one.
bool advance(Shape& begin, const Shape& blocks, const Shape& shape) {
  for (std::size_t d = shape.size(); d-- > 0;) {
    begin[d] += blocks[d];
    if (begin[d] < shape[d]) return true;
    begin[d] = 0;
  }
  return false;
}

}  // namespace

Shape shape_of(hid_t dataset) {
  const Handle space{H5Dget_space(dataset), H5Sclose};
  Shape shape(static_cast<std::size_t>(checked(H5Sget_simple_extent_ndims(space))));
  if (!shape.empty()) checked(H5Sget_simple_extent_dims(space, shape.data(), nullptr));
  return shape;
}

std::size_t count(const Shape& shape) {
  std::size_t product = 1;
  for (const hsize_t length : shape) product *= length;
  return product;
}

Shape blocks_of(const Shape& shape, std::size_t value_size) {
  Shape blocks(shape.size(), 1);
  hsize_t room = largest_block / value_size;
  for (std::size_t d = shape.size(); d-- > 0 && room > 1;) {
    const hsize_t parts = (shape[d] + room - 1) / room;
    blocks[d] = (shape[d] + parts - 1) / parts;
    room /= blocks[d];
  }
  return blocks;
}

void read_blocks(hid_t dataset, hid_t type, void* memory, const std::function<void(std::size_t)>& take,
                 hid_t transfer) {
  const Shape shape = shape_of(dataset);
  if (std::ranges::find(shape, hsize_t{0}) != shape.end()) return;
  const Handle space{H5Dget_space(dataset), H5Sclose};
  const Shape blocks = blocks_of(shape, H5Tget_size(type));
  Shape begin(shape.size(), 0), size(shape.size(), 1);
  do {
    for (std::size_t d = 0; d < shape.size(); ++d) size[d] = std::min(blocks[d], shape[d] - begin[d]);
    if (!shape.empty())
      checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr));
    const hsize_t values = count(size);
    const Handle room{H5Screate_simple(1, &values, nullptr), H5Sclose};
    checked(H5Dread(dataset, type, room, space, transfer, memory));
    take(static_cast<std::size_t>(values));
  } while (advance(begin, blocks, shape));
}

}  // namespace clatter::results::detail
