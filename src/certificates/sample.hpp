#pragma once

#include <cstddef>
#include <vector>

namespace clatter::certificates {

/// So many of some items, spread evenly over them, the first and the last among them; of one the middle; all if there
/// are no more.
template <class Item>
[[nodiscard]] std::vector<Item> spread(const std::vector<Item>& items, std::size_t count) {
  if (count >= items.size()) return items;
  if (count == 1) return {items[items.size() / 2]};
  std::vector<Item> chosen;
  for (std::size_t i = 0; i < count; ++i) chosen.push_back(items[i * (items.size() - 1) / (count - 1)]);
  return chosen;
}

}  // namespace clatter::certificates
