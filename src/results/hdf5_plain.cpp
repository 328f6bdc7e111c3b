#include "results/hdf5_plain.hpp"

#include <algorithm>
#include <cstdint>
#include <tuple>

#include "branches/branch_dataset.hpp"
#include "results/hdf5_texts.hpp"
#include "storage/utf8.hpp"
#include "sweep/result_store.hpp"

namespace clatter::results::detail {
namespace {

/// A limit above the number in any output.
constexpr std::size_t most_variables = 1000;

/// The message in the header of an object that lists external files (HDF5 file format, IV.A.2.h).
constexpr unsigned external_files_message = 7;

[[noreturn]] void refuse(const std::string& name, const std::string& why) {
  throw Failure("'" + storage::printable(name) + "' " + why + ", which clatter doesn't write");
}

/// Examines a link, and the object behind it only if that is in this file.
void require_own_object(hid_t file, const std::string& name) {
  if (name.empty() || name == "." || name.find('/') != std::string::npos) refuse(name, "is a path");
  H5L_info_t link;
  checked(H5Lget_info(file, name.c_str(), &link, H5P_DEFAULT));
  if (link.type != H5L_TYPE_HARD) refuse(name, "is a link to something else");
  H5O_info_t object;
  checked(H5Oget_info_by_name2(file, name.c_str(), &object, H5O_INFO_BASIC | H5O_INFO_HDR, H5P_DEFAULT));
  if (object.type != H5O_TYPE_DATASET) refuse(name, "is a group or a type, not a variable");
  if ((object.hdr.mesg.present >> external_files_message & 1U) != 0) refuse(name, "has its values in another file");
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

/// Whether clatter writes texts under this name.
bool holds_texts(const std::string& name) {
  static const std::vector<std::string> names = [] {
    std::vector<std::string> all = sweep::names_of_texts();
    for (std::string& own : branches::names_of_texts()) all.push_back(std::move(own));
    return all;
  }();
  return std::ranges::find(names, name) != names.end();
}

void require_own_storage(hid_t dataset, const std::string& name) {
  const Handle properties{H5Dget_create_plist(dataset), H5Pclose};
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || checked(H5Pget_external_count(properties)) > 0)
    refuse(name, "has its values in another file");
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) refuse(name, "is stored compactly");
  require_own_filters(properties, name);
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const H5T_class_t kind = H5Tget_class(type);
  if (holds_texts(name)) {
    if (!is_text(dataset)) refuse(name, "holds no texts of variable length");
  } else if (kind != H5T_INTEGER && kind != H5T_FLOAT) {
    refuse(name, "holds no numbers");
  }
}

struct Link {
  std::int64_t order;  ///< of creation, 0: not kept
  std::string name;
};

herr_t collect(hid_t, const char* name, const H5L_info_t* link, void* to) {
  auto& links = *static_cast<std::vector<Link>*>(to);
  links.push_back({link->corder_valid ? link->corder : 0, name});
  return links.size() > most_variables ? 1 : 0;
}

}  // namespace

/// Opens without locks, since some file systems have none and outputs are replaced as a whole; without plugins, which
/// are programs; and without links to other files.
Handle open_file(const std::string& path) {
  checked(H5PLset_loading_state(0));
  if (checked(H5Lis_registered(H5L_TYPE_EXTERNAL)) > 0) checked(H5Lunregister(H5L_TYPE_EXTERNAL));
  const Handle access{H5Pcreate(H5P_FILE_ACCESS), H5Pclose};
  checked(H5Pset_file_locking(access, false, true));
  return {H5Fopen(path.c_str(), H5F_ACC_RDONLY, access), H5Fclose};
}

std::vector<std::string> variables_in(hid_t file) {
  std::vector<Link> links;
  checked(H5Literate(file, H5_INDEX_NAME, H5_ITER_NATIVE, nullptr, collect, &links));
  if (links.size() > most_variables) throw Failure("it has more than " + std::to_string(most_variables) + " variables");
  H5G_info_t root;
  checked(H5Gget_info(file, &root));
  if (root.nlinks != links.size()) throw Failure("its list of variables is damaged");
  std::ranges::sort(links, {}, [](const Link& link) { return std::tie(link.order, link.name); });
  std::vector<std::string> names;
  names.reserve(links.size());
  for (const Link& link : links) names.push_back(link.name);
  for (const std::string& name : names) require_own_object(file, name);
  for (const std::string& name : names) (void)open_variable(file, name);
  return names;
}

Handle open_variable(hid_t file, const std::string& name) {
  require_own_object(file, name);
  Handle dataset{H5Dopen2(file, name.c_str(), H5P_DEFAULT), H5Dclose};
  require_own_storage(dataset, name);
  return dataset;
}

}  // namespace clatter::results::detail
