#include "stream.hpp"

#include <flint/flint.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdio>
#include <cstring>
#include <exception>
#include <memory>
#include <thread>
#include <utility>
#include <vector>

#include "deadline.hpp"

namespace verify {
namespace {

constexpr std::size_t lines_at_once = 4096, bytes_at_once = std::size_t{64} << 20u;
/// No list of events that can be followed is longer.
constexpr std::size_t longest_line = std::size_t{16} << 20u;

/// A bug of this program is the verdict on its line, and no other line suffers from it.
void examine(Line& line, const Manner& manner) {
  deadline.begin(manner.limit);  // reading counts
  try {
    if ((line.of_list = read_list_line(line.text))) return;
    const Certificate certificate = read_certificate(line.text);
    line.place = certificate.place, line.for_people = certificate.for_people;
    line.finding = manner.check(certificate);
  } catch (const FormatError& error) {
    line.malformed = error.what();
  } catch (const OutOfTime& over) {
    line.finding = {Verdict::undecided, {std::string("undecided: ") + over.what()}, 0};
  } catch (const std::exception& error) {
    line.bug = error.what();
  } catch (...) {  // of a library
    line.bug = "an exception of an unknown kind";
  }
  line.text = {};
}

void examine_all(std::vector<Line>& lines, const Manner& manner) {
  std::atomic<std::size_t> next = 0;
  const auto work = [&] {
    for (std::size_t i = next++; i < lines.size(); i = next++)
      if (lines[i].malformed.empty()) examine(lines[i], manner);
    flint_cleanup();
  };
  std::vector<std::jthread> pool;
  for (unsigned i = 1; i < std::min<std::size_t>(manner.threads, lines.size()); ++i) pool.emplace_back(work);
  work();
}

/// The lines of a file that aren't blank. Of one that is too long only the beginning is kept.
class Lines {
 public:
  explicit Lines(std::FILE* file) : file_(file) {}

  /// False at the end, or if the file can't be read on.
  bool read(Line& line) {
    do {
      line = {};
      line.number = ++number_;
      if (!read_text(line)) return false;
      if (line.text.starts_with("\xEF\xBB\xBF")) line.text.erase(0, 3);  // an editor's mark of UTF-8
    } while (line.malformed.empty() && line.text.find_first_not_of(" \t\r") == std::string::npos);
    return true;
  }
  /// The `errno` of a file that can't be read on, else 0. A stream of C++ doesn't tell it of standard input.
  [[nodiscard]] int error() const { return error_; }

 private:
  bool read_text(Line& line) {
    std::size_t length = 0;
    int c = next();
    if (c == EOF) return false;
    for (; c != EOF && c != '\n'; c = next())
      if (++length <= longest_line) line.text += static_cast<char>(c);
    if (error_ != 0) return false;  // the rest of the line is missing
    if (length <= longest_line) {
      if (line.text.find('\0') != std::string::npos)
        line.malformed = "the line has a byte 0; leave it out", line.text = {};
      return true;
    }
    line.malformed = "the line has " + std::to_string(length) + " bytes; write a certificate in " +
                     std::to_string(longest_line) + " at most";
    line.text = {};
    return true;
  }
  int next() {
    const int c = std::getc(file_);
    if (c == EOF && std::ferror(file_) != 0) error_ = errno;
    return c;
  }

  std::FILE* file_;
  std::size_t number_ = 0;
  int error_ = 0;
};

bool may_be_certificate(const Line& line) {
  return !line.malformed.empty() || line.text[line.text.find_first_not_of(" \t\r")] == '{';
}

/// The certificates of a file since the last line that begins or ends a list of them.
class List {
 public:
  List(const std::string& file, Result& result) : file_(file), result_(result) {}

  void add(const Line& line) {
    last_ = line.number;
    if (!line.of_list) {
      ++count_, has_any_ = true;
      return result_.add(file_, line);
    }
    if (line.of_list->begins)
      end();
    else if (line.of_list->certificates != count_)
      result_.add_malformed(file_, last_,
                            "the line counts " + std::to_string(line.of_list->certificates) +
                                " certificates before it, and there are " + std::to_string(count_) +
                                "; write them again by clatter certify");
    count_ = 0, is_open_ = line.of_list->begins;
  }
  [[nodiscard]] bool has_any() const { return has_any_; }
  /// A list that has begun ends with its count, or was cut.
  void end() const {
    if (is_open_)
      result_.add_malformed(file_, last_,
                            "the line is followed by no count of the certificates, so some are missing; write them "
                            "again by clatter certify");
  }

 private:
  const std::string& file_;
  Result& result_;
  std::size_t count_ = 0, last_ = 0;
  bool is_open_ = false, has_any_ = false;
};

/// Examines the lines of a file, some at a time, so that memory doesn't grow with it. One that begins like no
/// certificate isn't read on: each line of it would be a mistake.
void examine_stream(std::FILE* file, const std::string& name, const Manner& manner, Result& result) {
  List list(name, result);
  Lines source(file);
  bool is_first = true;
  for (bool more = true; more;) {
    std::vector<Line> lines;
    for (std::size_t bytes = 0; lines.size() < lines_at_once && bytes < bytes_at_once;) {
      Line line;
      if (!(more = source.read(line))) break;
      if (std::exchange(is_first, false) && !may_be_certificate(line))
        return result.add_failure(usage_error, name + ':' + std::to_string(line.number) +
                                                   ": isn't the JSON of a certificate; name a file that clatter "
                                                   "certify wrote");
      bytes += line.text.size();
      lines.push_back(std::move(line));
    }
    examine_all(lines, manner);
    for (const Line& line : lines) list.add(line);
  }
  if (source.error() != 0)
    return result.add_failure(io_error, "cannot read '" + name + "' to its end: " + std::strerror(source.error()));
  list.end();
  if (!list.has_any())
    result.add_failure(usage_error, "'" + name + "' holds no certificate; make some by clatter certify");
}

}  // namespace

void examine_file(const std::string& name, const Manner& manner, Result& result) {
  if (name == "-") return examine_stream(stdin, "stdin", manner, result);
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> file(std::fopen(name.c_str(), "r"), &std::fclose);
  if (!file) return result.add_failure(io_error, "cannot read '" + name + "': " + std::strerror(errno));
  examine_stream(file.get(), name, manner, result);
}

}  // namespace verify
