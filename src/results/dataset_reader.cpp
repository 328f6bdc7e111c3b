#include <hdf5_hl.h>

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <utility>

#include "results/dataset_file.hpp"
#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_plain.hpp"
#include "results/hdf5_shape.hpp"
#include "results/hdf5_values.hpp"
#include "results/summary_bytes.hpp"
#include "storage/error.hpp"
#include "storage/input_file.hpp"
#include "storage/run_in_child.hpp"

namespace clatter::results {

void refuse_damaged(const std::string& path, const std::string& why) {
  storage::refuse_reading(path, "cannot be read: " + why, "copy it again, or run its configuration again");
}

namespace {

using detail::checked;
using detail::Handle;
using detail::text_attribute;

Handle open(const std::string& path) {
  const htri_t is_hdf5 = H5Fis_hdf5(path.c_str());
  if (is_hdf5 == 0) storage::refuse_reading(path, "is not an HDF5 file", "name an output of clatter");
  if (is_hdf5 < 0) throw detail::Failure{};
  detail::require_sound_heaps(path);
  return detail::open_file(path);
}

/// Reads the texts of a file, in total no more than its size can hold: all of them may refer to the same bytes.
class Texts {
 public:
  explicit Texts(std::uint64_t stored_bytes) : left_(2 * stored_bytes + 16UL * 1024 * 1024) {}

  [[nodiscard]] std::string of(hid_t object, const std::string& name) {
    std::string text = text_attribute(object, name);
    if (text.size() > left_) throw detail::Failure("it holds more text than its size can hold");
    left_ -= text.size();
    return text;
  }

 private:
  std::uint64_t left_;
};

/// The name of an object at the root, without its slash.
std::string object_name(hid_t object) {
  std::string path(static_cast<std::size_t>(checked(H5Iget_name(object, nullptr, 0))), '\0');
  checked(H5Iget_name(object, path.data(), path.size() + 1));
  return path.substr(path.rfind('/') + 1);
}

/// The order of creation, if the file keeps it: a tool that has copied the file may have dropped it.
H5_index_t attribute_order(hid_t file) {
  const Handle root{H5Gopen2(file, "/", H5P_DEFAULT), H5Gclose};
  const Handle properties{H5Gget_create_plist(root), H5Pclose};  // the file's own list forgets the order
  unsigned flags = 0;
  checked(H5Pget_attr_creation_order(properties, &flags));
  return (flags & H5P_CRT_ORDER_INDEXED) != 0 ? H5_INDEX_CRT_ORDER : H5_INDEX_NAME;
}

herr_t collect_name(hid_t, const char* name, const H5A_info_t*, void* names) {
  static_cast<std::vector<std::string>*>(names)->emplace_back(name);
  return 0;
}

std::vector<std::pair<std::string, std::string>> root_attributes(hid_t file, Texts& texts) {
  std::vector<std::string> names;
  checked(H5Aiterate2(file, attribute_order(file), H5_ITER_INC, nullptr, collect_name, &names));
  std::vector<std::pair<std::string, std::string>> attributes;
  attributes.reserve(names.size());
  for (const std::string& name : names) attributes.emplace_back(name, texts.of(file, name));
  return attributes;
}

/// "float64" and the like, as numpy and xarray call them; "string" for texts.
std::string type_name(hid_t dataset) {
  if (detail::is_text(dataset)) return "string";
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const std::string bits = std::to_string(8 * H5Tget_size(type));
  if (H5Tget_class(type) == H5T_FLOAT) return "float" + bits;
  return (H5Tget_sign(type) == H5T_SGN_NONE ? "uint" : "int") + bits;
}

herr_t keep_name(hid_t, unsigned, hid_t scale, void* name) try {
  *static_cast<std::string*>(name) = object_name(scale);
  return 1;  // the first scale is enough
} catch (const detail::Failure&) {
  return -1;
}

std::vector<NamedLength> dimensions_of(hid_t dataset, const std::string& variable) {
  const bool is_scale = checked(H5DSis_scale(dataset)) > 0;
  std::vector<NamedLength> dimensions;
  for (const hsize_t length : detail::shape_of(dataset)) {
    std::string name = is_scale ? variable : "";
    const auto d = static_cast<unsigned>(dimensions.size());
    if (!is_scale) checked(H5DSiterate_scales(dataset, d, nullptr, keep_name, &name));
    dimensions.push_back({name, static_cast<std::size_t>(length)});
  }
  return dimensions;
}

/// Whether a scale only gives a dimension its name and length.
bool is_bare_scale(hid_t dataset) {
  if (checked(H5DSis_scale(dataset)) == 0) return false;
  return text_attribute(dataset, "NAME").starts_with("This is a netCDF dimension but not a netCDF variable.");
}

/// Refuses a file that claims more values than it can have, however short it is.
void require_possible(const FileSummary::Entry& status, std::uint64_t stored_bytes) {
  double values = 1;
  for (const NamedLength& dimension : status.dimensions) values *= static_cast<double>(dimension.length);
  if (values > detail::most_deflated * static_cast<double>(stored_bytes))
    throw detail::Failure("its 'status' is longer than a file of its size can hold");
}

/// The number of values of a variable with each of its flags, in the order of flag_values.
std::vector<std::pair<std::string, std::size_t>> flag_counts(const Handle& dataset) {
  std::array<std::size_t, 256> counts{};
  std::vector<std::uint8_t> values(detail::values_in_block(dataset, 1));
  detail::read_blocks(dataset, H5T_NATIVE_UINT8, values.data(), [&](std::size_t count) {
    for (std::size_t i = 0; i < count; ++i) ++counts[values[i]];
  });
  std::istringstream meanings{text_attribute(dataset, "flag_meanings")};
  std::vector<std::pair<std::string, std::size_t>> result;
  for (const std::uint8_t flag : detail::byte_attribute(dataset, "flag_values")) {
    std::string meaning;
    if (meanings >> meaning) result.emplace_back(meaning, counts[flag]);
  }
  return result;
}

void add_variable(FileSummary& summary, hid_t file, const std::string& name, Texts& texts) {
  const Handle dataset = detail::open_variable(file, name);
  if (is_bare_scale(dataset)) return;
  summary.variables.push_back({name, type_name(dataset), texts.of(dataset, "units"), texts.of(dataset, "long_name"),
                               dimensions_of(dataset, name), texts.of(dataset, "frame")});
}

FileSummary summary_of(const Handle& file, const std::string& path, std::uint64_t stored_bytes) {
  if (text_attribute(file, "clatter_schema") != "clatter/1") {
    storage::refuse_reading(path,
                            "an HDF5 file, but not one of clatter's (no attribute clatter_schema = \"clatter/1\")",
                            "name an output of clatter");
  }
  FileSummary summary;
  Texts texts(stored_bytes);
  summary.attributes = root_attributes(file, texts);
  for (const std::string& name : detail::variables_in(file)) add_variable(summary, file, name, texts);
  const auto status = std::ranges::find(summary.variables, "status", &FileSummary::Entry::name);
  if (status == summary.variables.end()) return summary;
  require_possible(*status, stored_bytes);
  summary.status_counts = flag_counts(detail::open_variable(file, "status"));
  return summary;
}

/// Reads in this process, which the library may crash.
FileSummary unguarded_summary(const std::string& path, std::uint64_t stored_bytes) try {
  const detail::QuietErrors quiet;
  return summary_of(open(path), path, stored_bytes);
} catch (const detail::Failure& failure) {
  refuse_damaged(path, failure.what());
} catch (const std::length_error&) {
  refuse_damaged(path, "it holds an impossible length");
}

Variable variable_in(const Handle& file, const std::string& name) {
  const Handle dataset = detail::open_variable(file, name);
  Variable variable{name, {}, detail::values_of(dataset), "", ""};
  for (const NamedLength& dimension : dimensions_of(dataset, name)) variable.dimensions.push_back(dimension.name);
  if (std::string meanings = text_attribute(dataset, "flag_meanings"); !meanings.empty())
    variable.attributes = {{"flag_values", detail::byte_attribute(dataset, "flag_values")},
                           {"flag_meanings", std::move(meanings)}};
  return variable;
}

/// Reads the values as `read_variables` does and keeps none, in a process that the library may crash.
void try_variables(const std::string& path, const std::vector<std::string>& names, std::uint64_t stored_bytes) try {
  const detail::QuietErrors quiet;
  const Handle file = open(path);
  for (const std::string& name : names) {
    const Handle dataset = detail::open_variable(file, name);
    if (static_cast<double>(detail::length_of(dataset)) > detail::most_deflated * static_cast<double>(stored_bytes))
      throw detail::Failure("its '" + name + "' is longer than a file of its size can hold");
    detail::try_values(dataset);
  }
} catch (const detail::Failure& failure) {
  refuse_damaged(path, failure.what());
}

/// Throws IoError unless all values of some variables can be read.
void require_readable(const std::string& path, const std::vector<std::string>& names) try {
  const std::uint64_t stored = storage::open_input(path, "an output of clatter").stored_bytes;
  static_cast<void>(
      storage::run_in_child([&] { return try_variables(path, names, stored), ""; }, storage::limits_for(stored)));
} catch (const storage::ChildFailed& death) {
  refuse_damaged(path, death.what());
}

}  // namespace

void require_readable(const FileSummary& summary, const std::string& path) {
  std::vector<std::string> names;
  for (const FileSummary::Entry& entry : summary.variables) names.push_back(entry.name);
  require_readable(path, names);
}

Dataset read_variables(const std::string& path, const std::vector<std::string>& names) try {
  require_readable(path, names);
  const detail::QuietErrors quiet;
  const Handle file = open(path);
  Dataset dataset;
  for (const std::string& name : names) dataset.variables.push_back(variable_in(file, name));
  return dataset;
} catch (const detail::Failure& failure) {
  refuse_damaged(path, failure.what());
}

FileSummary read_summary(const std::string& path) try {
  const std::uint64_t stored = storage::open_input(path, "an output of clatter").stored_bytes;
  auto summary = summary_from(
      storage::run_in_child([&] { return bytes_of(unguarded_summary(path, stored)); }, storage::limits_for(stored)));
  if (!summary) refuse_damaged(path, "it makes the HDF5 library corrupt its memory");
  return std::move(*summary);
} catch (const storage::ChildFailed& death) {
  refuse_damaged(path, death.what());
}

}  // namespace clatter::results
