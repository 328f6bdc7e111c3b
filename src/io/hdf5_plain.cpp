#include "io/hdf5_plain.hpp"

#include <vector>

#include "io/utf8.hpp"

namespace clatter::hdf5 {
namespace {

/// More than any output has; looking at each takes time for all before it.
constexpr hsize_t most_variables = 1000;

/// The message in the header of an object that lists external files (HDF5 file format, IV.A.2.h).
constexpr unsigned external_files_message = 7;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Failure("'" + printable(name) + "' " + why + ", which clatter doesn't write");
}

std::string name_of(hid_t file, hsize_t index) {
  const auto get = [&](char* to, std::size_t room) {
    return checked(H5Lget_name_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, index, to, room, H5P_DEFAULT));
  };
  std::string name(static_cast<std::size_t>(get(nullptr, 0)), '\0');
  (void)get(name.data(), name.size() + 1);
  return name;
}

/// Looks at a link, and at the object behind it only if that is in this file.
void require_own_variable(hid_t file, hsize_t index) {
  const std::string name = name_of(file, index);
  H5L_info_t link;
  checked(H5Lget_info_by_idx(file, ".", H5_INDEX_NAME, H5_ITER_INC, index, &link, H5P_DEFAULT));
  if (link.type != H5L_TYPE_HARD) refuse(name, "is a link to something else");
  H5O_info_t object;
  checked(H5Oget_info_by_idx2(file, ".", H5_INDEX_NAME, H5_ITER_INC, index, &object, H5O_INFO_BASIC | H5O_INFO_HDR,
                              H5P_DEFAULT));
  if (object.type != H5O_TYPE_DATASET) refuse(name, "is a group or a type, not a variable");
  if ((object.hdr.mesg.present >> external_files_message & 1U) != 0) refuse(name, "has its values in another file");
  if (name.find('/') != std::string::npos) refuse(name, "has a path for its name");
}

/// Shuffle and deflate, each once at most: a file that is deflated many times over grows without bound.
void require_own_filters(hid_t properties, const std::string& name) {
  std::vector<H5Z_filter_t> own{H5Z_FILTER_SHUFFLE, H5Z_FILTER_DEFLATE};
  const auto count = static_cast<unsigned>(checked(H5Pget_nfilters(properties)));
  for (unsigned i = 0; i < count; ++i) {
    unsigned flags = 0, configuration = 0;
    std::size_t values = 0;
    const H5Z_filter_t filter =
        checked(H5Pget_filter2(properties, i, &flags, &values, nullptr, 0, nullptr, &configuration));
    if (std::erase(own, filter) == 0) refuse(name, "passes through filter " + std::to_string(filter));
  }
}

void require_own_storage(hid_t file, const std::string& name) {
  const Handle dataset{H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
  const Handle properties{H5Dget_create_plist(dataset), H5Pclose};
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || checked(H5Pget_external_count(properties)) > 0)
    refuse(name, "has its values in another file");
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) refuse(name, "is stored compactly");
  require_own_filters(properties, name);
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const H5T_class_t kind = H5Tget_class(type);
  if (kind != H5T_INTEGER && kind != H5T_FLOAT) refuse(name, "holds no numbers");
}

void require_plain(hid_t file) {
  H5G_info_t root;
  checked(H5Gget_info(file, &root));
  if (root.nlinks > most_variables) throw Failure("it has " + std::to_string(root.nlinks) + " variables");
  for (hsize_t index = 0; index < root.nlinks; ++index) require_own_variable(file, index);
  for (hsize_t index = 0; index < root.nlinks; ++index) require_own_storage(file, name_of(file, index));
}

}  // namespace

/// Without locks: some file systems have none, and outputs are replaced as a whole. Without plugins, which are
/// programs.
Handle open_plain(const std::string& path) {
  checked(H5PLset_loading_state(0));
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  checked(H5Pset_file_locking(access, false, true));
  Handle file{H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
  require_plain(file);
  return file;
}

}  // namespace clatter::hdf5
