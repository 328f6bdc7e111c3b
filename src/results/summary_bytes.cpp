#include "results/summary_bytes.hpp"

#include <utility>

#include "storage/packed.hpp"

namespace clatter::results {
namespace {

/// All fields of a summary in one order, to pack and to unpack.
template <typename Pass, typename Summary>
void pass_summary(Pass& pass, Summary& summary) {
  const auto pair = [](auto& each, auto& item) { each(item.first), each(item.second); };
  const auto dimension = [](auto& each, auto& item) { each(item.name), each(item.length); };
  const auto entry = [&](auto& each, auto& item) {
    each(item.name), each(item.type), each(item.units), each(item.long_name), each(item.dimensions, dimension);
    each(item.frame);
  };
  pass(summary.attributes, pair), pass(summary.variables, entry), pass(summary.status_counts, pair);
}

}  // namespace

std::string bytes_of(const FileSummary& summary) {
  storage::Packer packer;
  pass_summary(packer, summary);
  return std::move(packer).bytes();
}

std::optional<FileSummary> summary_from(std::string_view bytes) {
  storage::Unpacker unpacker(bytes);
  FileSummary summary;
  pass_summary(unpacker, summary);
  return unpacker.complete() ? std::optional(std::move(summary)) : std::nullopt;
}

}  // namespace clatter::results
