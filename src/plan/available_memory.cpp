#include "plan/available_memory.hpp"

#include <pthread.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <optional>
#include <sstream>
#include <string_view>

namespace clatter::plan {
namespace {

namespace fs = std::filesystem;

/// A greater number means no limit: version 1 writes the largest that is a whole number of pages.
constexpr double unlimited = 0x1p60;

/// A file system of control groups that limits memory.
struct GroupMount {
  std::string shown;  ///< the group that is visible at `place`
  std::string place;
  bool is_version_2 = false;
};

/// A path from mountinfo, which writes blanks and the like as octal numbers.
std::string unescaped(std::string_view text) {
  std::string path;
  for (std::size_t i = 0; i < text.size(); ++i) {
    if (text[i] != '\\' || i + 3 >= text.size()) {
      path += text[i];
      continue;
    }
    int code = 0;
    for (int digit = 0; digit < 3; ++digit) code = 8 * code + (text[++i] - '0');
    path += static_cast<char>(code);
  }
  return path;
}

bool names(const std::string& list, std::string_view name) {
  std::istringstream words(list);
  for (std::string word; std::getline(words, word, ',');)
    if (word == name) return true;
  return false;
}

/// "31 23 0:28 /group /sys/fs/cgroup rw - cgroup2 cgroup2 rw" (proc_pid_mountinfo(5)).
std::optional<GroupMount> mount_of(const std::string& line) {
  std::istringstream fields(line);
  std::string skipped, shown, place, type, source, options;
  fields >> skipped >> skipped >> skipped >> shown >> place;
  while (fields >> skipped && skipped != "-") {
  }
  fields >> type >> source >> options;
  const bool is_version_2 = type == "cgroup2";
  if (!is_version_2 && !(type == "cgroup" && names(options, "memory"))) return std::nullopt;
  return GroupMount{unescaped(shown), unescaped(place), is_version_2};
}

/// The path of a group below the one that its file system shows; if it lies elsewhere, as within a container, the one
/// that is shown counts.
std::string below(const std::string& group, const std::string& shown) {
  const std::string top = shown == "/" ? "" : shown;
  if (!group.starts_with(top + '/') || group.find("/..") != std::string::npos) return {};
  return group.substr(top.size());
}

void add_limits(const fs::path& place, std::string group, const char* file, std::vector<MemoryLimit>& limits) {
  while (group.ends_with('/')) group.pop_back();
  for (;; group.erase(group.rfind('/'))) {
    double limit = 0;
    if (std::ifstream(place.string() + group + '/' + file) >> limit && limit < unlimited)  // else "max", or none
      limits.push_back({limit, "its control group" + (group.empty() ? "" : " '" + group + '\'') + " permits"});
    if (group.empty()) return;
  }
}

double machine_limit() {
  const double bytes = static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGESIZE));
  return bytes > 0 ? bytes : MemoryLimit{}.bytes;
}

double resource_limit(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  const bool is_there = getrlimit(resource, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY;
  return is_there ? static_cast<double>(limit.rlim_cur) : MemoryLimit{}.bytes;
}

ProcessSize size_now() {
  std::ifstream statm("/proc/self/statm");
  double addresses = 0, resident = 0, shared = 0, text = 0, library = 0, data = 0;
  statm >> addresses >> resident >> shared >> text >> library >> data;
  const auto page = static_cast<double>(sysconf(_SC_PAGESIZE));
  return {addresses * page, resident * page, data * page};
}

/// The stack that a thread gets unless told otherwise.
double stack_of_thread() {
  pthread_attr_t attributes;
  std::size_t size = 0;
  if (pthread_attr_init(&attributes) != 0) return 0;
  (void)pthread_attr_getstacksize(&attributes, &size);
  pthread_attr_destroy(&attributes);
  return static_cast<double>(size);
}

}  // namespace

std::vector<MemoryLimit> group_limits(const fs::path& root) {
  std::vector<GroupMount> mounts;
  std::ifstream mountinfo(root / "proc/self/mountinfo"), groups(root / "proc/self/cgroup");
  for (std::string line; std::getline(mountinfo, line);)
    if (const auto mount = mount_of(line)) mounts.push_back(*mount);
  std::vector<MemoryLimit> limits;
  for (std::string line; std::getline(groups, line);) {  // "4:memory:/group", of version 2 "0::/group"
    const std::size_t list = line.find(':') + 1, group = line.find(':', list) + 1;
    if (list == 0 || group == 0) continue;
    const bool is_version_2 = line.starts_with("0::");
    if (!is_version_2 && !names(line.substr(list, group - 1 - list), "memory")) continue;
    for (const GroupMount& mount : mounts)
      if (mount.is_version_2 == is_version_2)
        add_limits(root / fs::path(mount.place).relative_path(), below(line.substr(group), mount.shown),
                   is_version_2 ? "memory.max" : "memory.limit_in_bytes", limits);
  }
  return limits;
}

std::vector<MemoryLimit> address_limits(double addresses, double data, const ProcessSize& now, int threads) {
  const double stacks = threads * stack_of_thread();
  // The need includes the memory that is resident now; the rest of the addresses comes on top.
  const double left = addresses - (now.addresses - now.resident) - stacks;
  return {{std::max(0.0, left), "ulimit -v leaves", true},
          {std::max(0.0, data - (now.data - now.resident) - stacks), "ulimit -d leaves"}};
}

MemoryLimit memory_limit(int threads, double mapped) {
  std::vector<MemoryLimit> limits = group_limits();
  const MemoryLimit machine{machine_limit(), "this machine has"};
  limits.push_back(machine);
  std::ranges::move(address_limits(resource_limit(RLIMIT_AS), resource_limit(RLIMIT_DATA), size_now(), threads),
                    std::back_inserter(limits));
  return *std::ranges::min_element(limits, {}, [=](const MemoryLimit& limit) { return limit.besides(mapped); });
}

double peak_bytes() {
  std::ifstream status("/proc/self/status");
  for (std::string line; std::getline(status, line);)
    if (line.starts_with("VmHWM:")) return 1024 * std::stod(line.substr(6));
  return 0.0;
}

}  // namespace clatter::plan
