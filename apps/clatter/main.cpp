#include <fcntl.h>
#include <malloc.h>
#include <sys/resource.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "commands/commands.hpp"
#include "config/config.hpp"
#include "help/citation.hpp"
#include "results/version.hpp"
#include "storage/error.hpp"
#include "storage/journal.hpp"
#include "storage/utf8.hpp"
#include "sweep/thread_stacks.hpp"

namespace {

using namespace clatter;
using namespace clatter::app;

/// Runs a command, or --help, --version or --cite in its place.
int run_program(const std::vector<std::string>& words) {
  if (words.empty()) throw UsageError("no command; see `clatter --help`");
  if (words[0] == "--help" || words[0] == "-h") {
    std::cout << program_help();
    return done;
  }
  if (words[0] == "--version") {
    std::cout << "clatter " << results::version() << " (commit " << results::git_commit() << ", " << results::compiler()
              << ")\n";
    return done;
  }
  if (words[0] == "--cite") {
    std::cout << citation();
    return done;
  }
  if (words[0].starts_with('-')) refuse_option(words[0]);
  const Command& command = find_command(words[0]);
  const Arguments arguments = parse_arguments(command, {words.begin() + 1, words.end()});
  if (!arguments.has("help")) return command.run(arguments);
  std::cout << command_help(command);
  return done;
}

/// Opens any closed standard stream, since otherwise a file of ours would get its number. Writing to such a stdout is
/// still an error.
void open_standard_streams() {
  for (int number = STDIN_FILENO; number <= STDERR_FILENO; ++number)
    if (::fcntl(number, F_GETFD) < 0) (void)::open("/dev/null", number == STDERR_FILENO ? O_WRONLY : O_RDONLY);
}

bool at_its_end = false;

/// A library that calls exit, as OpenMP's does if no thread can be started, would end the process with an exit code
/// that means something else here.
void refuse_foreign_exit() {
  if (at_its_end) return;
  std::cerr << "clatter: stopped by a library; if threads can't be started, use fewer (--threads) or raise "
               "ulimit -u and ulimit -v\n";
  ::_exit(io_error);
}

/// Messages may quote files of others, so they are made printable.
int report(const std::string& message, int code) {
  std::cerr << "clatter: " << storage::printable_lines(message) << '\n';
  return code;
}

int run_main(int argc, char** argv) {
  mallopt(M_TRIM_THRESHOLD, 64 * 1024 * 1024);  // points come and go by the million, so freed memory is soon used again
  rlimit addresses{};
  if (::getrlimit(RLIMIT_AS, &addresses) == 0 && addresses.rlim_cur != RLIM_INFINITY)
    mallopt(M_ARENA_MAX, 1);  // a heap per thread would reserve 64 MiB of the few addresses each
  try {
    const int code = run_program({argv + 1, argv + argc});
    std::cout.flush();
    return std::cout ? code : report("standard output cannot be written; is its disk full?", io_error);
  } catch (const UsageError& error) {
    return report(error.what(), usage_error);
  } catch (const config::ConfigError& error) {
    std::cerr << storage::printable_lines(error.what()) << '\n';  // begins with the location, as editors expect
    return usage_error;
  } catch (const storage::IoError& error) {
    return report(error.what(), io_error);
  } catch (const sweep::LimitError& error) {
    return report(error.what(), io_error);
  } catch (const storage::BusyError& error) {
    return report(error.what(), busy);
  } catch (const std::bad_alloc&) {
    return report(storage::no_memory("it ran out").what(), io_error);
  } catch (const std::exception& error) {
    return report(std::string("a bug in clatter: ") + error.what() + "; please report it with the command",
                  internal_error);
  }
}

}  // namespace

int main(int argc, char** argv) {
  std::signal(SIGXFSZ, SIG_IGN);  // a write beyond `ulimit -f`, even to stderr, then fails as on a full disk
  open_standard_streams();
  std::atexit(refuse_foreign_exit);
  if (const std::string fault = sweep::fault_of_main_stack(); !fault.empty()) {
    at_its_end = true;
    return report(fault, io_error);
  }
  const int code = run_main(argc, argv);
  at_its_end = true;
  return code;
}
