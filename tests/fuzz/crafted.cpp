#include "crafted.hpp"

#include <hdf5.h>

#include <array>
#include <functional>
#include <stdexcept>

#include "scratch.hpp"

namespace clatter::fuzz {
namespace {

constexpr std::array<hsize_t, 2> shape{2, 2};
constexpr const char* elsewhere = "/etc/hostname";

void require_done(hid_t result) {
  if (result < 0) throw std::runtime_error("a crafted file can't be made");
}

/// Creates `x` anew, with properties that `set` gives it.
void create_x(hid_t file, hid_t type, const std::function<herr_t(hid_t)>& set, const hsize_t* lengths = shape.data()) {
  const hid_t properties = H5Pcreate(H5P_DATASET_CREATE), space = H5Screate_simple(2, lengths, nullptr);
  require_done(set(properties));
  const hid_t dataset = H5Dcreate2(file, "x", type, space, H5P_DEFAULT, properties, H5P_DEFAULT);
  require_done(dataset);
  H5Dclose(dataset), H5Sclose(space), H5Pclose(properties);
}

herr_t set_virtual(hid_t properties) {
  const hid_t space = H5Screate_simple(2, shape.data(), nullptr);
  const herr_t result = H5Pset_virtual(properties, space, elsewhere, "/x", space);
  H5Sclose(space);
  return result;
}

herr_t set_filter(hid_t properties) {
  if (H5Pset_chunk(properties, 2, shape.data()) < 0) return -1;
  return H5Pset_filter(properties, H5Z_FILTER_FLETCHER32, 0, 0, nullptr);
}

/// A length that the file doesn't have: no value of it is ever written.
herr_t set_claimed(hid_t properties) {
  if (H5Pset_fill_time(properties, H5D_FILL_TIME_NEVER) < 0) return -1;
  return H5Pset_alloc_time(properties, H5D_ALLOC_TIME_EARLY);
}

const std::vector<std::pair<std::string, std::function<void(hid_t)>>> crafts{
    {"external_storage",
     [](hid_t file) {
       create_x(file, H5T_NATIVE_DOUBLE, [](hid_t p) { return H5Pset_external(p, elsewhere, 0, H5F_UNLIMITED); });
     }},
    {"virtual", [](hid_t file) { create_x(file, H5T_NATIVE_DOUBLE, set_virtual); }},
    {"filter", [](hid_t file) { create_x(file, H5T_NATIVE_DOUBLE, set_filter); }},
    {"compact",
     [](hid_t file) { create_x(file, H5T_NATIVE_DOUBLE, [](hid_t p) { return H5Pset_layout(p, H5D_COMPACT); }); }},
    {"texts", [](hid_t file) { create_x(file, H5T_C_S1, [](hid_t) { return 0; }); }},
    {"claimed",
     [](hid_t file) {
       constexpr std::array<hsize_t, 2> long_shape{2, 1UL << 20};
       create_x(file, H5T_NATIVE_DOUBLE, set_claimed, long_shape.data());
     }},
    {"external_link",
     [](hid_t file) { require_done(H5Lcreate_external(elsewhere, "/x", file, "x", H5P_DEFAULT, H5P_DEFAULT)); }},
    {"soft_link", [](hid_t file) { require_done(H5Lcreate_soft("/nu", file, "x", H5P_DEFAULT, H5P_DEFAULT)); }},
    {"group", [](hid_t file) { H5Gclose(H5Gcreate2(file, "x", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT)); }},
    {"type",
     [](hid_t file) {
       const hid_t type = H5Tcopy(H5T_NATIVE_DOUBLE);
       require_done(H5Tcommit2(file, "x", type, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
       H5Tclose(type);
     }},
};

}  // namespace

std::vector<std::pair<std::string, std::string>> crafted_files(const std::string& sound) {
  std::vector<std::pair<std::string, std::string>> files;
  for (const auto& [name, craft] : crafts) {
    const std::string path = write("crafted.h5", sound);
    const hid_t file = H5Fopen(path.c_str(), H5F_ACC_RDWR, H5P_DEFAULT);
    require_done(file);
    require_done(H5Ldelete(file, "x", H5P_DEFAULT));
    craft(file);
    require_done(H5Fclose(file));
    files.emplace_back(name, content(path));
  }
  return files;
}

}  // namespace clatter::fuzz
