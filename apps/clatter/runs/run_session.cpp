#include "runs/run_session.hpp"

#include <chrono>
#include <cstdint>
#include <iostream>
#include <new>
#include <utility>

#include "commands/commands.hpp"
#include "config/config_diff.hpp"
#include "results/dataset_file.hpp"
#include "results/version.hpp"
#include "runs/plan_report.hpp"
#include "runs/room_check.hpp"
#include "runs/run_report.hpp"
#include "storage/utf8.hpp"
#include "sweep/rounding_fingerprint.hpp"
#include "terminal/format.hpp"
#include "terminal/warnings.hpp"

namespace clatter::app {
namespace {

std::string name_of(const std::optional<results::Shard>& shard) { return shard ? text_of(*shard) : ""; }

storage::JournalKey journal_key(const config::Config& config, const RunRequest& request) {
  return {.config = config.text,
          .program = std::string(results::version())
                         .append(" ")
                         .append(results::git_commit())
                         .append(", ")
                         .append(results::compiler()),
          .rounding = sweep::rounding_fingerprint(config.sweep, request.arch),
          .shard = name_of(request.shard)};
}

/// A key as lines that can be compared.
std::string lines_of(const storage::JournalKey& key) {
  return "program: " + storage::printable(key.program) + "\nrounding: " + storage::printable(key.rounding) + '\n' +
         (key.shard.empty() ? "the whole sweep" : "shard " + storage::printable(key.shard)) + '\n' + key.config;
}

void say_plan(const config::Config& config, const RunRequest& request, const plan::MemoryNeed& need) {
  const sweep::RunOptions options{.threads = request.threads, .arch = request.arch};
  const plan::Plan plan = plan::plan_of(config.sweep, options, need, request.shard);
  std::cerr << plan_text(plan, config.sweep, request.threads, {});
  say_notes(config), warn(plan);
}

}  // namespace

RunSession::RunSession(config::Config config, RunRequest request)
    : config_(std::move(config)),
      request_(std::move(request)),
      place_(request_.output, {.shard = name_of(request_.shard), .title = config_.title}, request_.force) {}

int RunSession::run() {
  const plan::MemoryNeed need = check_memory(config_, request_.shard, request_.threads);
  check_disk(config_, need, request_.output);
  announce(need);
  open_journal();
  announce_restored();
  compute();
  journal_->remove();
  report();
  return result_.statuses.failed() > 0 ? points_failed : done;
}

void RunSession::announce(const plan::MemoryNeed& need) const {
  if (request_.verbose) say_plan(config_, request_, need);
  if (request_.quiet) return;
  warn(config_);
  if (!request_.verbose) warn_of_costliest_point(config_.sweep, request_.shard);
}

void RunSession::open_journal() {
  sweep_.emplace(config_.sweep, request_.shard, std::make_shared<storage::Scratch>(request_.output));
  const storage::RecordLimit limit{sweep_->most_saved(), config_.sweep.problem.observe.impact_log};
  const storage::JournalKey key = journal_key(config_, request_);
  try {
    journal_.emplace(request_.output, key, limit, request_.begin,
                     [this](std::span<const std::byte> results) { restore(results); });
  } catch (const storage::OtherRun& other) {
    const std::string theirs = lines_of(other.key()), ours = lines_of(key);
    throw storage::IoError(other.what() + (':' + config::config_diff({"that run: ", theirs}, {"this run: ", ours})));
  }
}

void RunSession::restore(std::span<const std::byte> results) {
  if (sweep_->restore(results)) return;
  throw storage::IoError("the journal of " + storage::quoted_name(request_.output) +
                         " doesn't fit the sweep; --restart begins anew");
}

void RunSession::announce_restored() const {
  if (!journal_->is_locked())
    std::cerr << "this file system has no locks: make sure that no other run writes "
              << storage::quoted_name(request_.output) << " meanwhile\n";
  if (sweep_->restored_points() > 0 && !request_.quiet)
    std::cerr << "goes on from " << sweep_->restored_points() << " finished points\n";
}

void RunSession::compute() try {
  run_points();
  write();
} catch (const storage::IoError& error) {
  throw failure(error);
} catch (const std::bad_alloc&) {
  throw failure(storage::no_memory("it ran out"));
}

void RunSession::run_points() {
  checkpointer_.emplace(
      *journal_, [this] { save(); }, request_.end);
  run_with_progress({.threads = request_.threads, .arch = request_.arch});
  checkpointer_->finish();
}

void RunSession::run_with_progress(sweep::RunOptions options) {
  Progress progress(request_.progress, "points", static_cast<double>(sweep_->restored_points()));
  if (request_.progress != ProgressKind::none)
    options.progress = [&](double finished, std::size_t total) { progress.show(finished, static_cast<double>(total)); };
  sweep_->run(options);
}

void RunSession::save() {
  sweep_->save([this](std::span<const std::byte> results) { journal_->append(results); });
  journal_->sync();
}

void RunSession::write() {
  result_ = sweep_->result();
  summary_ = summary_of_points(result_, config_.sweep, request_.shard);
  const auto write_result = request_.shard ? results::write_file_with_checksum : results::write_file;
  place_.write_atomically([&](storage::FileWriter& file) { write_result(file, std::move(result_.dataset), config_); },
                          [this](std::uint64_t bytes) { journal_->give_back(bytes); });
}

void RunSession::report() const {
  const std::chrono::duration<double> passed = Checkpointer::Clock::now() - request_.started;
  if (!request_.quiet)
    std::cerr << summary_ << ", " << formatted("%.3g", passed.count()) << " s, " << storage::printable(request_.output)
              << '\n';
  if (request_.verbose) std::cerr << details(result_, command_line(), request_.began);
}

/// Saves what it can. The error then says what the next run will find.
storage::IoError RunSession::failure(const storage::IoError& error) {
  checkpointer_.reset();
  return storage::IoError(error.what() + (journal_->had_records() ? "\nclatter: " + journal_->leave() : ""));
}

}  // namespace clatter::app
