#include "results/output_place.hpp"

#include <sys/stat.h>

#include <optional>
#include <utility>

#include "storage/atomic_write.hpp"
#include "storage/file_calls.hpp"
#include "storage/free_name.hpp"
#include "storage/utf8.hpp"

namespace clatter::results {
namespace {

/// The reason why an output must not replace another file; empty if it may.
std::string difference(const std::optional<Origin>& there, const Origin& ours) {
  const auto command = [](const Origin& origin) { return "`clatter " + origin.command + '`'; };
  const auto part = [](const Origin& origin) {
    return origin.shard.empty() ? std::string("all points") : "shard " + origin.shard;
  };
  if (!there) return "the file there is not an output of clatter, or is damaged";
  if (there->command != ours.command)
    return std::string("the file there is an output of ")
        .append(command(*there))
        .append(", this is one of ")
        .append(command(ours));
  if (there->shard != ours.shard) return "the file there has " + part(*there) + " of a sweep, this one " + part(ours);
  if (there->title != ours.title)
    return "the file there has the title '" + storage::excerpt(there->title, 60) + "', this one '" +
           storage::excerpt(ours.title, 60) + '\'';
  return {};
}

}  // namespace

OutputPlace::OutputPlace(std::string path, Origin origin, bool force)
    : path_(std::move(path)), origin_(std::move(origin)), force_(force), seen_(state()) {
  storage::check_writable(path_);
  require_replaceable();
}

/// The state of the file; nothing if there is no file, or an empty one.
std::optional<OutputPlace::State> OutputPlace::state() const {
  struct stat file {};
  if (::stat(path_.c_str(), &file) != 0 || file.st_size == 0) return std::nullopt;
  return State{static_cast<std::int64_t>(file.st_dev),
               static_cast<std::int64_t>(file.st_ino),
               file.st_size,
               file.st_mtim.tv_sec,
               file.st_mtim.tv_nsec,
               file.st_ctim.tv_sec,
               file.st_ctim.tv_nsec};
}

void OutputPlace::require_replaceable() const {
  if (force_ || !state()) return;
  const std::string why = difference(origin_of(path_), origin_);
  if (!why.empty()) storage::refuse(path_, why, storage::instead_of_replacing(path_));
}

void OutputPlace::write_atomically(const std::function<void(storage::FileWriter&)>& write,
                                   const storage::MakeRoom& make_room) const {
  const auto look_again = [&] {
    if (state() != seen_) require_replaceable();
  };
  storage::write_atomically(path_, write, {.make_room = make_room, .before_rename = look_again});
}

}  // namespace clatter::results
