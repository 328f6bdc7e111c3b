#include "results/origin.hpp"

#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_plain.hpp"
#include "storage/guarded.hpp"

namespace clatter {
namespace {

using hdf5::checked;
using hdf5::Handle;
using hdf5::text_attribute;

/// The origin as a text, for it has to come out of a child process: kind, shard and title, a NUL between them.
std::string origin_text(const std::string& path) try {
  const hdf5::QuietErrors quiet;
  const Handle file = hdf5::open_file(path);
  (void)hdf5::variables_in(file);
  if (text_attribute(file, "clatter_schema") != "clatter/1") return {};
  std::string text = checked(H5Lexists(file, "ns_per_period", H5P_DEFAULT)) > 0 ? "study" : "run";
  return text.append(1, '\0')
      .append(text_attribute(file, "shard"))
      .append(1, '\0')
      .append(text_attribute(file, "title"));
} catch (const hdf5::Failure&) {
  return {};
}

}  // namespace

std::optional<Origin> origin_of(const std::string& path) try {
  constexpr GuardLimits few{.memory = std::uint64_t{256} << 20U, .seconds = 1, .wall_seconds = 60};
  const std::string text = guarded([&] { return origin_text(path); }, few);
  const std::size_t kind = text.find('\0'), shard = text.find('\0', kind + 1);
  if (kind == std::string::npos || shard == std::string::npos) return std::nullopt;
  return Origin{.is_study = text.substr(0, kind) == "study",
                .shard = text.substr(kind + 1, shard - kind - 1),
                .title = text.substr(shard + 1)};
} catch (const GuardedDeath&) {
  return std::nullopt;
}

}  // namespace clatter
