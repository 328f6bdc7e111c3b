#include "storage/free_name.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>

#include "storage/journal.hpp"
#include "storage/utf8.hpp"

namespace clatter::storage {
namespace {

namespace fs = std::filesystem;

constexpr int most_tried = 10'000;

/// Whether anything has the name, a dangling link too; in doubt, yes.
bool is_taken(const std::string& path) {
  std::error_code error;
  return fs::symlink_status(path, error).type() != fs::file_type::not_found;
}

/// A name as a shell takes it.
std::string as_word(const std::string& name) {
  const bool is_plain = std::ranges::all_of(name, [](unsigned char c) {
    return std::isalnum(c) != 0 || std::string_view("._-+/=,").find(static_cast<char>(c)) != std::string_view::npos;
  });
  return is_plain ? name : quoted_name(name);
}

}  // namespace

std::string free_name(const std::string& path) {
  const fs::path given(path);
  const std::string begin = (given.parent_path() / given.stem()).string(), ending = given.extension().string();
  for (int number = 2; number < most_tried; ++number) {
    std::string name = begin + '-' + std::to_string(number) + ending;
    if (!is_taken(name) && !is_taken(name + journal_ending)) return name;
  }
  return path;
}

std::string name_another(const std::string& path) {
  const std::string other = free_name(path);
  return "name another with -o" + (other == path ? "" : ", e.g. -o " + as_word(other));
}

std::string instead_of_replacing(const std::string& path) {
  return name_another(path) + ", move that one away, or replace it with --force";
}

}  // namespace clatter::storage
