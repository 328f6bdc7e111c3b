#include <algorithm>
#include <boost/program_options.hpp>
#include <cstdlib>
#include <exception>
#include <iostream>
#include <string>
#include <thread>
#include <vector>

#include "printable.hpp"
#include "stream.hpp"

namespace verify {
namespace {

namespace options = boost::program_options;

/// scripts/manual.py makes the man page of it.
constexpr const char* usage =
    "clatter-verify FILE.jsonl... [OPTION]...\n\n"
    "prove or refute the motions that certificates claim\n\n"
    "Each motion is computed anew in ball arithmetic, numbers with proved bounds of their error. Each claim\n"
    "that isn't proved is printed with its place, the claimed value, and bounds of the true one. FILE.jsonl holds a\n"
    "certificate on each line, as clatter certify writes them; - reads standard input. All files are examined,\n"
    "whatever is wrong with one; of several exit codes the first of 1, 70, 74, 2, 3 counts.\n\n"
    "Options\n"
    "      --json           print one JSON object instead\n"
    "      --limit SECONDS  time for a claim, after which it is undecided; default: 60\n"
    "      --threads N      certificates checked at once; default: all cores\n"
    "  -h, --help           print this help\n"
    "      --version        print the version\n\n"
    "Exit codes\n"
    "  0    every claim is proved\n"
    "  1    at least one is refuted\n"
    "  2    wrong command line, or a malformed certificate\n"
    "  3    none is refuted, but at least one is undecided\n"
    "  70   a bug in clatter-verify\n"
    "  74   a file cannot be read, or the result cannot be written\n\n"
    "Examples\n"
    "  clatter certify fig23.h5 -o fig23.jsonl\n"
    "  clatter-verify fig23.jsonl\n"
    "  clatter certify map.h5 --sample 100 | clatter-verify -\n";

[[noreturn]] void fail(ExitCode code, const std::string& message) {
  std::cerr << "clatter-verify: " << printable(message) << '\n';
  std::exit(code);
}

int run(int count, const char* const* words) {
  options::options_description known;
  known.add_options()("json", "")("help,h", "")("version", "")("threads", options::value<int>())(
      "limit", options::value<double>());
  options::options_description all;
  all.add(known).add_options()("file", options::value<std::vector<std::string>>());
  options::positional_options_description operands;
  operands.add("file", -1);
  options::variables_map given;
  namespace style = options::command_line_style;
  options::store(options::command_line_parser(count, words)
                     .options(all)
                     .positional(operands)
                     .style(style::unix_style & ~style::allow_guessing)
                     .run(),
                 given);
  if (given.count("help") != 0) return std::cout << usage, all_proved;
  if (given.count("version") != 0) return std::cout << "clatter-verify " CLATTER_VERSION "\n", all_proved;
  if (given.count("file") == 0) fail(usage_error, "no file is named; give a file of certificates, or - for stdin");
  int threads = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  if (given.count("threads") != 0) threads = given["threads"].as<int>();
  if (threads < 1 || threads > 1024) fail(usage_error, "--threads must be 1 to 1024");
  const double limit = given.count("limit") != 0 ? given["limit"].as<double>() : Manner{}.limit;
  if (!(limit > 0 && limit <= 1e9)) fail(usage_error, "--limit must be above 0, and 1e9 at most");
  Result result(given.count("json") != 0);
  for (const std::string& name : given["file"].as<std::vector<std::string>>())
    examine_file(name, {.threads = static_cast<unsigned>(threads), .limit = limit}, result);
  result.print();
  if (!std::cout.flush()) fail(io_error, "cannot write the result");
  return result.exit_code();
}

}  // namespace
}  // namespace verify

int main(int count, char** words) try {
  return verify::run(count, words);
} catch (const boost::program_options::error& error) {
  verify::fail(verify::usage_error, std::string(error.what()) + "; see clatter-verify --help");
} catch (const std::exception& error) {
  std::cerr << "clatter-verify: " << error.what() << '\n';
  return verify::internal_error;
}
