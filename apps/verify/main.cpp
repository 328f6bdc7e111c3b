#include <flint/flint.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <boost/program_options.hpp>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <fstream>
#include <iostream>
#include <nlohmann/json.hpp>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include "check.hpp"

namespace verify {
namespace {

namespace options = boost::program_options;

enum ExitCode : int { all_proved = 0, some_refuted = 1, usage_error = 2, some_undecided = 3, io_error = 74 };

/// scripts/manual.py makes the man page of it.
constexpr const char* usage =
    "clatter-verify FILE.jsonl... [OPTION]...\n\n"
    "prove or refute the motions that certificates claim\n\n"
    "Each motion is computed anew in ball arithmetic, numbers with proved bounds of their error. Each claim\n"
    "that isn't proved is printed with its place, the claimed value, and bounds of the true one. FILE.jsonl holds a\n"
    "certificate on each line, as clatter certify writes them; - reads standard input.\n\n"
    "Options\n"
    "      --json       print one JSON object instead\n"
    "      --threads N  certificates checked at once; default: all cores\n"
    "  -h, --help       print this help\n"
    "      --version    print the version\n\n"
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

/// A line of a file, and what is found of it.
struct Line {
  std::size_t number = 0;
  std::string text{}, place{}, malformed{};
  std::vector<std::string> for_people{};  ///< members of which nothing is proved
  Finding finding{};
};

void examine(Line& line) {
  try {
    const Certificate certificate = read_certificate(line.text);
    line.place = certificate.place, line.for_people = certificate.for_people;
    line.finding = check(certificate);
  } catch (const FormatError& error) {
    line.malformed = error.what();
  }
  line.text.clear();
}

void examine_all(std::vector<Line>& lines, unsigned threads) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < lines.size(); i = next++) examine(lines[i]);
    flint_cleanup();
  };
  std::vector<std::jthread> pool;
  for (unsigned i = 1; i < std::min<std::size_t>(threads, lines.size()); ++i) pool.emplace_back(work);
  work();
}

/// The counts of all files, and what is printed of each line that isn't proved.
class Result {
 public:
  explicit Result(bool json) : json_(json) {}

  void add(const std::string& file, const Line& line) {
    ++lines_;
    const std::string place = file + ":" + std::to_string(line.number) + ": ";
    if (!line.malformed.empty()) {
      ++malformed_;
      std::cerr << place << line.malformed << '\n';
      return;
    }
    for_people_.insert(line.for_people.begin(), line.for_people.end());
    ++count_[static_cast<std::size_t>(line.finding.verdict)];
    if (line.finding.verdict == Verdict::proved) return;
    const bool refuted = line.finding.verdict == Verdict::refuted;
    if (json_)
      claims_.push_back({{"file", file},
                         {"line", line.number},
                         {"place", line.place},
                         {"verdict", refuted ? "refuted" : "undecided"},
                         {"bits", line.finding.bits},
                         {"remarks", line.finding.remarks}});
    else
      for (const std::string& remark : line.finding.remarks)
        std::cout << place << line.place << (line.place.empty() ? "" : ": ") << remark << '\n';
  }
  void print() const {
    const auto [proved, undecided, refuted] = count_;
    if (json_)
      std::cout << nlohmann::json{{"proved", proved},        {"refuted", refuted},        {"undecided", undecided},
                                  {"malformed", malformed_}, {"for_people", for_people_}, {"claims", claims_}}
                       .dump(2, ' ', false, nlohmann::json::error_handler_t::replace)
                << '\n';
    else
      std::cout << proved << " proved, " << refuted << " refuted, " << undecided << " undecided\n";
    if (json_ || for_people_.empty()) return;
    std::string names;
    for (const std::string& name : for_people_) names += (names.empty() ? "" : ", ") + name;
    std::cerr << "for people, and not proved: " << names << '\n';
  }
  [[nodiscard]] ExitCode exit_code() const {
    if (malformed_ > 0) return usage_error;
    if (count_[2] > 0) return some_refuted;
    return count_[1] > 0 ? some_undecided : all_proved;
  }
  [[nodiscard]] std::size_t lines() const { return lines_; }

 private:
  bool json_;
  std::size_t lines_ = 0, malformed_ = 0;
  std::array<std::size_t, 3> count_{};  ///< [Verdict]
  nlohmann::json claims_ = nlohmann::json::array();
  std::set<std::string> for_people_{};
};

[[noreturn]] void fail(ExitCode code, const std::string& message) {
  std::cerr << "clatter-verify: " << message << '\n';
  std::exit(code);
}

/// Examines the lines of a stream, some at a time, so that memory doesn't grow with the file. A stream that begins like
/// no certificate isn't read on: each line of it would be a mistake.
void examine_stream(std::istream& in, const std::string& name, unsigned threads, Result& result) {
  constexpr std::size_t at_once = 4096;
  const std::size_t before = result.lines();
  std::size_t number = 0;
  for (bool more = true; more;) {
    std::vector<Line> lines;
    std::string text;
    while (lines.size() < at_once && (more = static_cast<bool>(std::getline(in, text)))) {
      ++number;
      const std::size_t begin = text.find_first_not_of(" \t\r");
      if (begin == std::string::npos) continue;
      if (lines.empty() && result.lines() == before && text[begin] != '{')
        fail(usage_error, name + ':' + std::to_string(number) +
                              ": isn't the JSON of a certificate; name a file that clatter certify wrote");
      lines.push_back({number, std::move(text)});
    }
    examine_all(lines, threads);
    for (const Line& line : lines) result.add(name, line);
  }
}

void examine_file(const std::string& name, unsigned threads, Result& result) {
  const std::size_t before = result.lines();
  if (name == "-") {
    examine_stream(std::cin, "stdin", threads, result);
  } else {
    std::ifstream file(name);
    if (!file) fail(io_error, "cannot read '" + name + "': " + std::strerror(errno));
    examine_stream(file, name, threads, result);
    if (file.bad()) fail(io_error, "cannot read '" + name + "' to its end: " + std::strerror(errno));
  }
  if (result.lines() == before) fail(usage_error, "'" + name + "' holds no certificate; make some by clatter certify");
}

int run(int count, const char* const* words) {
  options::options_description known;
  known.add_options()("json", "")("help,h", "")("version", "")("threads", options::value<int>());
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
  Result result(given.count("json") != 0);
  for (const std::string& name : given["file"].as<std::vector<std::string>>())
    examine_file(name, static_cast<unsigned>(threads), result);
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
  return 70;
}
