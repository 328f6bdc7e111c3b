#include "results/origin.hpp"

#include "results/hdf5_attributes.hpp"
#include "results/hdf5_handle.hpp"
#include "results/hdf5_plain.hpp"
#include "storage/run_in_child.hpp"

namespace clatter::results {
namespace {

using detail::checked;
using detail::Handle;
using detail::text_attribute;

/// The origin as a text that a child process can send: command, shard and title, a NUL between them.
std::string origin_text(const std::string& path) try {
  const detail::QuietErrors quiet;
  const Handle file = detail::open_file(path);
  (void)detail::variables_in(file);
  if (text_attribute(file, "clatter_schema") != "clatter/1") return {};
  const auto holds = [&](const char* name) { return checked(H5Lexists(file, name, H5P_DEFAULT)) > 0; };
  std::string text = holds("ns_per_period") ? "accuracy" : holds("arclength") ? "branch" : "run";
  return text.append(1, '\0')
      .append(text_attribute(file, "shard"))
      .append(1, '\0')
      .append(text_attribute(file, "title"));
} catch (const detail::Failure&) {
  return {};
}

}  // namespace

std::optional<Origin> origin_of(const std::string& path) try {
  constexpr storage::ChildLimits few{.memory = std::uint64_t{256} << 20U, .seconds = 1, .wall_seconds = 60};
  const std::string text = run_in_child([&] { return origin_text(path); }, few);
  const std::size_t command = text.find('\0'), shard = text.find('\0', command + 1);
  if (command == std::string::npos || shard == std::string::npos) return std::nullopt;
  return Origin{.command = text.substr(0, command),
                .shard = text.substr(command + 1, shard - command - 1),
                .title = text.substr(shard + 1)};
} catch (const storage::ChildFailed&) {
  return std::nullopt;
}

}  // namespace clatter::results
