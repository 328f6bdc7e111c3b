#pragma once

#include <hdf5.h>

#include <cstdint>
#include <string>
#include <vector>

namespace clatter::results::detail {

/// The type of values in the file, the same on every machine, and in memory.
struct ValueType {
  hid_t file, memory;
};

inline ValueType type_of(double) { return {H5T_IEEE_F64LE, H5T_NATIVE_DOUBLE}; }
inline ValueType type_of(std::uint8_t) { return {H5T_STD_U8LE, H5T_NATIVE_UINT8}; }
inline ValueType type_of(std::int8_t) { return {H5T_STD_I8LE, H5T_NATIVE_INT8}; }
inline ValueType type_of(std::int32_t) { return {H5T_STD_I32LE, H5T_NATIVE_INT32}; }
inline ValueType type_of(std::int64_t) { return {H5T_STD_I64LE, H5T_NATIVE_INT64}; }

/// Writes a text, which may be as long as a configuration.
void put(hid_t object, const std::string& name, const std::string& text);

/// Writes numbers as lists, a single number as well: netCDF's _FillValue has to be a list of one.
void put(hid_t object, const std::string& name, double value);
void put(hid_t object, const std::string& name, const std::vector<std::uint8_t>& values);

/// The text of an attribute, of any string type that another tool may have made it; empty if there is none.
[[nodiscard]] std::string text_attribute(hid_t object, const std::string& name);

/// The small integers of an attribute such as flag_values; empty if there is none.
[[nodiscard]] std::vector<std::uint8_t> byte_attribute(hid_t object, const std::string& name);

}  // namespace clatter::results::detail
