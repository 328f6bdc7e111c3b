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

Handle space_of(const Shape& shape) {
  if (shape.empty()) return {H5Screate(H5S_SCALAR), H5Sclose};
  return {H5Screate_simple(static_cast<int>(shape.size()), shape.data(), nullptr), H5Sclose};
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

void each_block(const Shape& shape, std::size_t value_size,
                const std::function<void(hid_t space, std::size_t values)>& visit) {
  if (std::ranges::find(shape, hsize_t{0}) != shape.end()) return;
  const Handle space = space_of(shape);
  const Shape blocks = blocks_of(shape, value_size);
  Shape begin(shape.size(), 0), size(shape.size(), 1);
  do {
    for (std::size_t d = 0; d < shape.size(); ++d) size[d] = std::min(blocks[d], shape[d] - begin[d]);
    if (!shape.empty())
      checked(H5Sselect_hyperslab(space, H5S_SELECT_SET, begin.data(), nullptr, size.data(), nullptr));
    visit(space, count(size));
  } while (advance(begin, blocks, shape));
}

std::size_t values_in_block(hid_t dataset, std::size_t value_size) {
  const Shape shape = shape_of(dataset);
  return count(shape) == 0 ? 0 : count(blocks_of(shape, value_size));
}

Handle room_for(std::size_t values) {
  const hsize_t length = values;
  return {H5Screate_simple(1, &length, nullptr), H5Sclose};
}

void read_blocks(hid_t dataset, hid_t type, void* memory, const std::function<void(std::size_t)>& take,
                 hid_t transfer) {
  each_block(shape_of(dataset), H5Tget_size(type), [&](hid_t space, std::size_t values) {
    checked(H5Dread(dataset, type, room_for(values), space, transfer, memory));
    take(values);
  });
}

}  // namespace clatter::results::detail
