#include "scene/restitution.hpp"

#include <algorithm>
#include <deque>
#include <mutex>

namespace clatter {
inline namespace scene {

const SpeedTable* kept(const SpeedTable& table) {
  static std::mutex mutex;
  static std::deque<SpeedTable> all;  // which never move
  const std::lock_guard lock(mutex);
  const auto same = std::ranges::find(all, table);
  return same != all.end() ? &*same : &all.emplace_back(table);
}

}  // namespace scene
}  // namespace clatter
