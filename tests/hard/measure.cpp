#include "hard/measure.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <stdexcept>
#include <string>

namespace clatter::hard {
namespace {

const char* name_of(stepping::Outcome outcome) {
  static const char* const names[] = {"completed", "event_budget", "not_finite", "unresolved"};
  return names[static_cast<int>(outcome)];
}

}  // namespace

void report(const Case& one, const Measured& m) {
  const char* const name = std::getenv("CLATTER_HARD_CASES");
  if (name == nullptr) return;
  std::ofstream file(name, std::ios::app);
  file << "{\"row\": \"" << one.row << "\", \"what\": \"" << one.what << "\", \"outcome\": \""
       << name_of(m.record.outcome) << "\", \"impacts\": " << m.record.impacts << ", \"rests\": " << m.rests
       << ", \"evaluations\": " << m.record.evaluations << ", \"error\": " << m.error << ", \"one_ulp\": " << m.one_ulp
       << "}\n";
  if (!file.flush()) throw std::runtime_error(std::string("cannot write ") + name);
}

Measured expect_agreement(const Case& one, double rounding) {
  Measured m;
  m.record = accuracy::record_of(one.scene, one.duration);
  const accuracy::RunRecord reference = accuracy::reference_of(one.scene, one.duration);
  const support::Deviation d = support::deviation(m.record, reference);
  m.error = d.largest();
  const bool is_rounding = m.error <= epsilon<double>();  // else the inputs' own rounding is what to compare with
  if (!is_rounding) m.one_ulp = support::conditioning(one.scene, reference);
  m.impacts = d.impacts, m.chatters = d.chatters, m.rests = d.rests;
  EXPECT_EQ(m.record.outcome, stepping::Outcome::completed) << one.row << ", " << one.what;
  EXPECT_TRUE(d.same_events) << one.row << ", " << one.what << ": " << d.difference;
  EXPECT_LE(m.error, 64 * std::max(rounding, m.one_ulp)) << one.row << ", " << one.what;
  report(one, m);
  return m;
}

void expect_agreement(const std::string& row) {
  for (const Case& one : cases_of(row)) expect_agreement(one);
}

}  // namespace clatter::hard
