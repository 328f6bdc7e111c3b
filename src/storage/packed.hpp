#pragma once

#include <cstdint>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace clatter::storage {

/// Packs numbers and texts into bytes, to pass them to another process.
class Packer {
 public:
  void operator()(const std::uint64_t number) { bytes_.append(reinterpret_cast<const char*>(&number), sizeof number); }
  void operator()(const std::string& text) { (*this)(std::uint64_t{text.size()}), bytes_ += text; }
  template <typename Item, typename Each>
  void operator()(const std::vector<Item>& items, Each each) {
    (*this)(std::uint64_t{items.size()});
    for (const Item& item : items) each(*this, item);
  }

  [[nodiscard]] std::string&& bytes() && { return std::move(bytes_); }

 private:
  std::string bytes_;
};

/// Unpacks them again; gives nothing more once the bytes don't suffice.
class Unpacker {
 public:
  explicit Unpacker(std::string_view bytes) : bytes_{bytes} {}

  void operator()(std::uint64_t& number) {
    const std::string_view some = take(sizeof number);
    number = 0;
    if (some.size() == sizeof number) std::memcpy(&number, some.data(), sizeof number);
  }
  void operator()(std::string& text) {
    std::uint64_t length = 0;
    (*this)(length);
    text = take(length);
  }
  template <typename Item, typename Each>
  void operator()(std::vector<Item>& items, Each each) {
    std::uint64_t count = 0;
    (*this)(count);
    for (; count > 0 && sound_; --count) each(*this, items.emplace_back());
  }

  /// Whether the bytes sufficed and none are left.
  [[nodiscard]] bool complete() const { return sound_ && bytes_.empty(); }

 private:
  std::string_view take(std::uint64_t length) {
    sound_ = sound_ && length <= bytes_.size();
    const std::string_view some = sound_ ? bytes_.substr(0, length) : std::string_view{};
    bytes_.remove_prefix(some.size());
    return some;
  }

  std::string_view bytes_;
  bool sound_ = true;
};

}  // namespace clatter::storage
