#include "results/hdf5_plain.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cerrno>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>
#include <tuple>
#include <vector>

#include "results/dataset.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_values.hpp"
#include "storage/file_calls.hpp"
#include "storage/utf8.hpp"

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
  const bool is_word = std::ranges::all_of(name, [](unsigned char c) { return std::isalnum(c) != 0 || c == '_'; });
  if (name.empty() || !is_word) refuse(name, "is no name of a variable");
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

void require_own_storage(hid_t dataset, const std::string& name) {
  const Handle properties{H5Dget_create_plist(dataset), H5Pclose};
  const H5D_layout_t layout = H5Pget_layout(properties);
  if (layout == H5D_VIRTUAL || checked(H5Pget_external_count(properties)) > 0)
    refuse(name, "has its values in another file");
  if (layout != H5D_CONTIGUOUS && layout != H5D_CHUNKED) refuse(name, "is stored compactly");
  require_own_filters(properties, name);
  const Handle type{H5Dget_type(dataset), H5Tclose};
  const H5T_class_t kind = H5Tget_class(type);
  if (std::ranges::find(text_variables, name) != text_variables.end()) {
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

using namespace std::string_view_literals;

// HDF5 file format, III.E "Disk Format: Level 1E - Global Heap": a collection is signature, version, size, then
// objects, each of a header {index 2, references 2, reserved 4, size 8} and its data.
constexpr std::string_view signature = "GCOL\1\0\0\0"sv;
constexpr std::size_t header = 16;

template <typename Integer>
Integer little_endian(std::string_view bytes) {
  Integer value = 0;
  for (std::size_t i = sizeof(Integer); i-- > 0;) {
    value = static_cast<Integer>(static_cast<Integer>(value << 8U) | static_cast<unsigned char>(bytes[i]));
  }
  return value;
}

/// Reads parts of a file; a part is cut at the end of the file.
class Parts {
 public:
  explicit Parts(const std::string& path) : file_{::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK)} {
    struct stat status {};
    if (file_.number() < 0 || ::fstat(file_.number(), &status) != 0) throw Failure{"it cannot be opened"};
    size_ = static_cast<std::uint64_t>(status.st_size);
  }

  [[nodiscard]] std::uint64_t size() const { return size_; }

  [[nodiscard]] std::string_view read(std::uint64_t begin, std::span<char> to) const {
    std::size_t got = 0;
    while (got < to.size()) {
      const ssize_t more = storage::uninterrupted(
          [&] { return ::pread(file_.number(), to.data() + got, to.size() - got, static_cast<off_t>(begin + got)); });
      if (more < 0) throw Failure{"it cannot be read"};
      if (more == 0) break;
      got += static_cast<std::size_t>(more);
    }
    return {to.data(), got};
  }

  /// The next byte from `begin` on that is stored, else the end of the file. The hole before it reads as zeros, and may
  /// be far longer than the disk.
  [[nodiscard]] std::uint64_t next_stored(std::uint64_t begin) const {
    const off_t data = ::lseek(file_.number(), static_cast<off_t>(begin), SEEK_DATA);
    if (data < 0) return errno == ENXIO ? size_ : begin;  // some file systems don't tell
    return static_cast<std::uint64_t>(data);
  }

 private:
  storage::Descriptor file_;
  std::uint64_t size_ = 0;
};

/// Reads headers one after the other, many at once: most are a few bytes apart.
class Headers {
 public:
  explicit Headers(const Parts& file) : file_{file} {}

  /// That at a place, or the part of it that the file has.
  [[nodiscard]] std::string_view at(std::uint64_t place) {
    if (place < begin_ || place + header > begin_ + read_.size()) begin_ = place, read_ = file_.read(place, memory_);
    return read_.substr(static_cast<std::size_t>(place - begin_), header);
  }

 private:
  const Parts& file_;
  std::array<char, 4096> memory_{};
  std::uint64_t begin_ = 0;
  std::string_view read_{};
};

/// Walks the objects from `at` to `end` as the library does; true if every step leads forward and none beyond the end.
bool is_sound(Headers& headers, std::uint64_t at, std::uint64_t end) {
  while (end - at >= header) {
    const std::string_view object = headers.at(at);
    if (object.size() < header) return false;
    const auto index = little_endian<std::uint16_t>(object);
    const auto size = little_endian<std::uint64_t>(object.substr(8));
    if (size > end - at) return false;
    const std::uint64_t step = index == 0 ? size : header + (size + 7) / 8 * 8;  // 0: the free rest, header included
    if (step == 0 || step > end - at) return false;
    at += step;
  }
  return true;
}

void require_sound_heap(const Parts& file, std::uint64_t at) {
  Headers headers{file};
  const std::string_view collection = headers.at(at);
  if (collection.size() < header) return;
  const auto size = little_endian<std::uint64_t>(collection.substr(8));
  if (size < header || size > file.size() - at || !is_sound(headers, at + header, at + size))
    throw Failure{"a heap of texts at byte " + std::to_string(at) + " is damaged"};
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

void require_sound_heaps(const std::string& path) {
  const Parts file{path};
  constexpr std::size_t overlap = signature.size() - 1;
  std::vector<char> piece(std::min(file.size() + 1, std::uint64_t{1} << 20U));  // no more, since each byte is zeroed
  for (std::uint64_t begin = file.next_stored(0); begin < file.size(); begin = file.next_stored(begin)) {
    const std::string_view bytes = file.read(begin, piece);
    for (std::size_t at = 0; (at = bytes.find(signature, at)) != std::string_view::npos; at += header)
      require_sound_heap(file, begin + at);
    if (bytes.size() < piece.size()) return;  // the end
    begin += bytes.size() - overlap;
  }
}

}  // namespace clatter::results::detail
