#include <malloc.h>

#include <exception>
#include <iostream>
#include <new>
#include <string>
#include <vector>

#include "commands.hpp"
#include "io/config.hpp"
#include "io/error.hpp"
#include "io/journal.hpp"
#include "io/version.hpp"

namespace {

using namespace clatter;

/// --help and --version stand in place of a command.
int run_program(const std::vector<std::string>& words) {
  if (words.empty()) throw UsageError("no command; see `clatter --help`");
  if (words[0] == "--help" || words[0] == "-h") {
    std::cout << program_help();
    return done;
  }
  if (words[0] == "--version") {
    std::cout << "clatter " << version() << " (commit " << git_commit() << ", " << compiler() << ")\n";
    return done;
  }
  if (words[0].starts_with('-'))
    throw UsageError("unknown option '" + words[0] + "' before the command; see `clatter --help`");
  const Command& command = find_command(words[0]);
  const Arguments arguments = parse_arguments(command, {words.begin() + 1, words.end()});
  if (!arguments.has("help")) return command.run(arguments);
  std::cout << command_help(command);
  return done;
}

int report(const char* message, int code) {
  std::cerr << "clatter: " << message << '\n';
  return code;
}

}  // namespace

int main(int argc, char** argv) {
  mallopt(M_TRIM_THRESHOLD, 64 * 1024 * 1024);  // points come and go by the million: what they free is soon taken again
  try {
    const int code = run_program({argv + 1, argv + argc});
    std::cout.flush();
    return std::cout ? code : report("standard output cannot be written; is its disk full?", io_error);
  } catch (const UsageError& error) {
    return report(error.what(), usage_error);
  } catch (const ConfigError& error) {
    std::cerr << error.what() << '\n';  // begins with the place, as editors expect it
    return usage_error;
  } catch (const IoError& error) {
    return report(error.what(), io_error);
  } catch (const BusyError& error) {
    return report(error.what(), busy);
  } catch (const std::bad_alloc&) {
    return report("the results don't fit into memory; sweep fewer points, or observe less", usage_error);
  } catch (const std::exception& error) {
    return report((std::string("a bug in clatter: ") + error.what() + "; please report it with the command").c_str(),
                  internal_error);
  }
}
