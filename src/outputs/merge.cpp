#include "outputs/merge.hpp"

#include <algorithm>
#include <exception>
#include <numeric>
#include <optional>
#include <utility>

#include "config/config_diff.hpp"
#include "plan/memory_need.hpp"
#include "results/version.hpp"
#include "storage/error.hpp"
#include "storage/utf8.hpp"
#include "sweep/output_variables.hpp"
#include "sweep/parallel.hpp"
#include "sweep/run.hpp"
#include "sweep/share.hpp"

namespace clatter::outputs {
namespace {

constexpr std::size_t shown = 5;  ///< lines of a long list

[[noreturn]] void refuse_pair(const results::ShardHeader& one, const results::ShardHeader& other,
                              const std::string& what, const std::string& way_out) {
  throw storage::IoError(storage::quoted_name(other.path) + " and " + storage::quoted_name(one.path) + ' ' + what +
                         "; " + way_out);
}

/// Throws unless all shards are of one sweep, and were computed by this very program with one rounding: else no single
/// run would write the merged file.
void check_origins(const std::vector<results::ShardHeader>& headers) {
  const results::ShardHeader& first = headers.front();
  if (first.schema != "clatter/1" || first.version != results::version() || first.git_commit != results::git_commit() ||
      first.compiler != results::compiler())
    throw storage::IoError(storage::quoted_name(first.path) + " was written by clatter " +
                           storage::excerpt(first.version) + " (commit " + storage::excerpt(first.git_commit) + ", " +
                           storage::excerpt(first.compiler) + "), this is " + std::string(results::version()) +
                           " (commit " + std::string(results::git_commit()) + ", " + std::string(results::compiler()) +
                           "); merge with the program that ran the shards");
  for (const results::ShardHeader& header : headers) {
    if (header.config_sha256 != first.config_sha256 || header.config != first.config)
      refuse_pair(first, header, "are of different configurations",
                  "leave out the one that doesn't belong to the sweep:" +
                      config::config_diff({storage::printable(header.path) + ": ", header.config},
                                          {storage::printable(first.path) + ": ", first.config}));
    if (header.schema != first.schema || header.version != first.version || header.git_commit != first.git_commit ||
        header.compiler != first.compiler)
      refuse_pair(first, header, "were written by different builds of clatter", "run all shards with one program");
    for (const auto text : {&results::ShardHeader::rounding, &results::ShardHeader::instruction_set})
      if (header.*text != first.*text)
        refuse_pair(
            first, header,
            "were rounded differently (" + storage::excerpt(header.*text) + "; " + storage::excerpt(first.*text) + ")",
            "run all shards with one --arch, on machines of one kind");
  }
}

/// The missing points, as those shards out of `of` that would have them.
std::string missing_text(const sweep::Sweep& sweep, const std::vector<results::ShardHeader>& headers, std::size_t of) {
  std::vector<char> there(of, 0);
  for (const results::ShardHeader& header : headers)
    for (std::size_t number = header.shard.number; number < of; number += header.shard.of) there[number] = 1;
  std::string text;
  std::size_t missing = 0;
  for (std::size_t number = 0; number < of; ++number) {
    const std::size_t points = sweep::Share(sweep, results::Shard{number, of}).points();
    if (there[number] != 0 || points == 0 || ++missing > shown) continue;
    const std::string name = text_of(results::Shard{number, of});
    text.append(missing > 1 ? "\nshard " : "shard ").append(name).append(": ").append(std::to_string(points));
    text.append(points == 1 ? " point" : " points").append(" missing: rerun with --shard ").append(name);
  }
  return missing > shown ? text + "\nand " + std::to_string(missing - shown) + " more shards" : text;
}

/// Throws unless every point is there exactly once. Two shards have a chain in common if their numbers agree modulo
/// the greatest common divisor of their counts.
void check_points(const sweep::Sweep& sweep, const std::vector<results::ShardHeader>& headers) {
  for (auto one = headers.begin(); one != headers.end(); ++one)
    for (auto other = headers.begin(); other != one; ++other) {
      const std::size_t divisor = std::gcd(one->shard.of, other->shard.of);
      if (one->shard.number % divisor == other->shard.number % divisor)
        refuse_pair(*other, *one,
                    "have points in common (shards " + text_of(one->shard) + " and " + text_of(other->shard) + ")",
                    "leave one of them out");
    }
  std::size_t of = 1;
  for (const results::ShardHeader& header : headers) {
    of = std::lcm(of, header.shard.of);
    if (of > results::Shard::most)
      throw storage::IoError("the shards are of too many different counts; run all with the same N");
  }
  const std::string missing = missing_text(sweep, headers, of);
  if (!missing.empty()) throw storage::IoError(missing);
}

void add_sizes(ShardSet& set) {
  const sweep::Sweep& sweep = set.config.sweep;
  double impacts = 0.0;
  for (const results::ShardHeader& header : set.headers) impacts += static_cast<double>(header.impacts);
  set.bytes = plan::merge_bytes(sweep, set.headers.size(), impacts, set.config.compression);
  set.output_bytes = plan::memory_need(sweep, std::nullopt, 1, impacts).output;
}

/// The most values that a run of a shard's configuration writes; one that can't be read is of another version, and
/// `check_origins` refuses that.
std::optional<double> most_values_of(const results::ShardHeader& header) try {
  const sweep::Sweep sweep = config::parse_config(header.config, header.path).sweep;
  const double logged =
      sweep.problem.observe.impact_log ? sweep::logged_values(sweep) * static_cast<double>(header.impacts) : 0.0;
  return most_values(sweep, header.shard) + logged;
} catch (const config::ConfigError&) {
  return std::nullopt;
}

/// Reads several at a time, each in a process of its own. Throws the error of the first one that has one.
std::vector<results::ShardHeader> headers_of(const std::vector<std::string>& paths) {
  std::vector<results::ShardHeader> headers(paths.size());
  std::vector<std::exception_ptr> errors(paths.size());
  sweep::parallel_for(paths.size(), sweep::default_threads(), [&](std::size_t i) {
    try {
      headers[i] = results::read_shard_header(paths[i], most_values_of);
    } catch (...) {
      errors[i] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return headers;
}

}  // namespace

ShardSet shard_set(const std::vector<std::string>& paths) {
  ShardSet set;
  set.headers = headers_of(paths);
  check_origins(set.headers);
  set.config = config::parse_config(set.headers.front().config, set.headers.front().path);
  check_points(set.config.sweep, set.headers);
  add_sizes(set);
  return set;
}

Merge::Merge(const ShardSet& shards) : shards_(shards) {
  for (const results::ShardHeader& header : shards.headers) readers_.emplace_back(header.path);
  for (std::size_t i = 0; i < readers_.size(); ++i)
    parts_.push_back({shards.headers[i].shard,
                      [this, i](const std::string& variable) { return reader(i).rows(variable); },
                      [this, i](const std::string& variable, std::size_t first, std::size_t rows) {
                        return reader(i).values(variable, first, rows);
                      }});
}

/// Of a great many shards only some files are open.
results::ShardReader& Merge::reader(std::size_t shard) {
  const auto found = std::ranges::find(open_, shard);
  if (found == open_.end() && open_.size() == results::most_open_shards)
    readers_[open_.front()].close(), open_.pop_front();
  if (found == open_.end()) open_.push_back(shard);
  return readers_[shard];
}

sweep::StatusTally Merge::write(const results::OutputPlace& place) try {
  const results::FileHead& head = shards_.config;
  sweep::Joined joined = sweep::joined(shards_.config.sweep, parts_, sweep::default_threads());
  joined.dataset.attributes.emplace_back(sweep::instruction_set_attribute, shards_.headers.front().instruction_set);
  place.write_atomically(
      [&](storage::FileWriter& file) { results::write_file(file, std::move(joined.dataset), head); });
  return joined.statuses;
} catch (const sweep::PartError& error) {
  const results::ShardHeader& header = shards_.headers[error.part()];
  throw storage::IoError(storage::quoted_name(header.path) + " isn't what a run of its configuration writes: " +
                         error.what() + "; run shard " + text_of(header.shard) + " again");
}

}  // namespace clatter::outputs
