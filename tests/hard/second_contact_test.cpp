// Released, and on a stop again at once: on the same one if the force releases the mass only for a moment, on the other
// one if that is near.

#include <gtest/gtest.h>

#include "hard/measure.hpp"

namespace clatter::hard::second_contact_test {
namespace {

TEST(SecondContact, agrees_with_fifty_digits) { expect_agreement("second_contact"); }

TEST(SecondContact, follows_every_release) {
  for (const char* what : {"let go for 2e-3", "let go for 1e-6"}) {
    const Case& one = case_of("second_contact", what);
    const accuracy::RunRecord record = accuracy::record_of(one.scene, one.duration);
    std::size_t releases = 0;
    for (std::size_t i = 0; i + 1 < record.events.size(); ++i) {
      const accuracy::Event &rest = record.events[i], &next = record.events[i + 1];
      if (rest.kind != accuracy::Event::Kind::rest || next.kind != accuracy::Event::Kind::impact) continue;
      ++releases;
      EXPECT_EQ(next.side, rest.side) << what;
      EXPECT_LT(next.time - rest.time - rest.length, 0.01) << what;
    }
    EXPECT_EQ(releases, 10u) << what;  // one in each of ten forcing periods
  }
}

}  // namespace
}  // namespace clatter::hard::second_contact_test
