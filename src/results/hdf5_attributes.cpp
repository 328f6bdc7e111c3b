#include "results/hdf5_attributes.hpp"

#include "results/hdf5_handle.hpp"
#include "results/hdf5_values.hpp"

namespace clatter::results::detail {
namespace {

void put(hid_t object, const std::string& name, const ValueType& type, const Handle& space, const void* values) {
  const Handle attribute{H5Acreate2(object, name.c_str(), type.file, space, H5P_DEFAULT, H5P_DEFAULT), H5Aclose};
  checked(H5Awrite(attribute, type.memory, values));
}

template <typename Value>
void put_list(hid_t object, const std::string& name, const Value* values, hsize_t count) {
  put(object, name, type_of(Value{}), {H5Screate_simple(1, &count, nullptr), H5Sclose}, values);
}

std::size_t size_of(hid_t attribute) {
  const Handle space{H5Aget_space(attribute), H5Sclose};
  return static_cast<std::size_t>(checked(H5Sget_simple_extent_npoints(space)));
}

std::string read_variable_length(hid_t attribute, hid_t type) {
  char* characters = nullptr;
  checked(H5Aread(attribute, type, &characters));
  std::string text = characters == nullptr ? "" : characters;
  H5free_memory(characters);
  return text;
}

std::string read_fixed_length(hid_t attribute, hid_t type) {
  std::string text(H5Tget_size(type), '\0');
  checked(H5Aread(attribute, type, text.data()));
  return text.substr(0, text.find('\0'));
}

}  // namespace

void put(hid_t object, const std::string& name, const std::string& text) {
  const Handle type = text_type();
  const char* const characters = text.c_str();
  put(object, name, ValueType{type, type}, {H5Screate(H5S_SCALAR), H5Sclose}, &characters);
}

void put(hid_t object, const std::string& name, double value) { put_list(object, name, &value, 1); }

void put(hid_t object, const std::string& name, const std::vector<std::uint8_t>& values) {
  put_list(object, name, values.data(), values.size());
}

std::string text_attribute(hid_t object, const std::string& name) {
  if (checked(H5Aexists(object, name.c_str())) == 0) return {};
  const Handle attribute{H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose};
  const Handle type{H5Aget_type(attribute), H5Tclose};
  if (H5Tget_class(type) != H5T_STRING || size_of(attribute) != 1) return {};
  return checked(H5Tis_variable_str(type)) > 0 ? read_variable_length(attribute, type)
                                               : read_fixed_length(attribute, type);
}

std::vector<std::uint8_t> byte_attribute(hid_t object, const std::string& name) {
  if (checked(H5Aexists(object, name.c_str())) == 0) return {};
  const Handle attribute{H5Aopen(object, name.c_str(), H5P_DEFAULT), H5Aclose};
  std::vector<std::uint8_t> values(size_of(attribute));
  if (!values.empty()) checked(H5Aread(attribute, H5T_NATIVE_UINT8, values.data()));
  return values;
}

}  // namespace clatter::results::detail
