#include "results/hdf5_values.hpp"

#include <vector>

#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_shape.hpp"
#include "results/hdf5_texts.hpp"

namespace clatter::results::detail {
namespace {

template <typename Value>
sweep::ValueArray numbers_of(hid_t dataset) {
  std::vector<Value> values(length_of(dataset));
  if (!values.empty()) checked(H5Dread(dataset, type_of(Value{}).memory, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data()));
  return values;
}

}  // namespace

std::size_t length_of(hid_t dataset) {
  const Handle space{H5Dget_space(dataset), H5Sclose};
  return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space)));
}

sweep::ValueArray values_of(hid_t dataset) {
  if (is_text(dataset)) return read_texts(dataset);
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const std::size_t bytes = H5Tget_size(type);
  if (H5Tget_class(type) != H5T_INTEGER) return numbers_of<double>(dataset);
  if (bytes == sizeof(std::int32_t)) return numbers_of<std::int32_t>(dataset);
  if (bytes > 1) return numbers_of<std::int64_t>(dataset);
  return H5Tget_sign(type) == H5T_SGN_NONE ? numbers_of<std::uint8_t>(dataset) : numbers_of<std::int8_t>(dataset);
}

void try_values(hid_t dataset) {
  if (is_text(dataset)) return try_texts(dataset);
  std::vector<std::byte> memory(largest_block);
  const Handle type{H5Dget_type(dataset), H5Tclose}, native{H5Tget_native_type(type, H5T_DIR_ASCEND), H5Tclose};
  read_blocks(dataset, native, memory.data(), [](std::size_t) {});
}

}  // namespace clatter::results::detail
