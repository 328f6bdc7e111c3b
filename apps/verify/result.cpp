#include "result.hpp"

#include <iostream>
#include <nlohmann/json.hpp>

#include "printable.hpp"

namespace verify {

void Result::add_malformed(const std::string& file, std::size_t line, const std::string& what) {
  ++malformed_;
  std::cerr << printable(file) << ':' << line << ": " << printable(what) << '\n';
}

void Result::add_failure(ExitCode code, const std::string& what) {
  (code == io_error ? has_unread_files_ : has_empty_files_) = true;
  std::cerr << "clatter-verify: " << printable(what) << '\n';
}

void Result::add(const std::string& file, const Line& line) {
  ++certificates_;
  if (!line.malformed.empty()) return add_malformed(file, line.number, line.malformed);
  if (!line.bug.empty()) {
    ++bugs_;
    return tell(file, line, "bug", {"bug: " + line.bug + "; please report it with this line"});
  }
  for_people_.insert(line.for_people.begin(), line.for_people.end());
  ++count_[static_cast<std::size_t>(line.finding.verdict)];
  if (line.finding.verdict == Verdict::proved) return;
  tell(file, line, line.finding.verdict == Verdict::refuted ? "refuted" : "undecided", line.finding.remarks);
}

void Result::tell(const std::string& file, const Line& line, const char* verdict,
                  const std::vector<std::string>& remarks) {
  if (json_) {
    claims_.push_back({file, line.place, verdict, line.number, line.finding.bits, remarks});
    return;
  }
  for (const std::string& remark : remarks)
    std::cout << printable(file + ':' + std::to_string(line.number) + ": " + line.place +
                           (line.place.empty() ? "" : ": ") + remark)
              << '\n';
}

void Result::print() const {
  const auto [proved, undecided, refuted] = count_;
  if (json_) {
    nlohmann::json claims = nlohmann::json::array();
    for (const Told& told : claims_)
      claims.push_back({{"file", told.file},
                        {"line", told.line},
                        {"place", told.place},
                        {"verdict", told.verdict},
                        {"bits", told.bits},
                        {"remarks", told.remarks}});
    std::cout << nlohmann::json{{"proved", proved},        {"refuted", refuted}, {"undecided", undecided},
                                {"malformed", malformed_}, {"bugs", bugs_},      {"for_people", for_people_},
                                {"claims", claims}}
                     .dump(2, ' ', true, nlohmann::json::error_handler_t::replace)
              << '\n';
    return;
  }
  std::cout << proved << " proved, " << refuted << " refuted, " << undecided << " undecided";
  if (bugs_ > 0) std::cout << ", " << bugs_ << (bugs_ == 1 ? " bug" : " bugs");
  std::cout << '\n';
  std::string names;
  for (const std::string& name : for_people_) names += (names.empty() ? "" : ", ") + name;
  if (!names.empty()) std::cerr << "for people, and not proved: " << names << '\n';
}

ExitCode Result::exit_code() const {
  if (count_[static_cast<std::size_t>(Verdict::refuted)] > 0) return some_refuted;
  if (bugs_ > 0) return internal_error;
  if (has_unread_files_) return io_error;
  if (malformed_ > 0 || has_empty_files_) return usage_error;
  return count_[static_cast<std::size_t>(Verdict::undecided)] > 0 ? some_undecided : all_proved;
}

}  // namespace verify
