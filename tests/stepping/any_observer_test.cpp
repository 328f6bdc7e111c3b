#include "stepping/any_observer.hpp"

#include <string>
#include <vector>

#include <gtest/gtest.h>

namespace clatter::stepping::any_observer_test {
namespace {

struct Base {
  int number = 0;
};
struct Derived : Base {};

struct Record {
  std::vector<std::string> seen;

  void arc(const Base& arc, double begin, double length) { add("base", arc, begin, length); }
  void arc(const Derived& arc, double begin, double length) { add("derived", arc, begin, length); }
  void event(const motion::Event& event) { seen.push_back("event at " + std::to_string(event.time)); }

 private:
  void add(const std::string& type, const Base& arc, double begin, double length) {
    seen.push_back(type + " " + std::to_string(arc.number) + ": " + std::to_string(begin + 100 * length));
  }
};

TEST(AnyObserver, shows_each_arc_by_its_own_type_and_each_event_in_their_order) {
  Record record;
  AnyObserver<Base, Derived> any(record);
  const auto copy = any;
  any.arc(Derived{{3}}, 0.5, 0.25);
  copy.event({.time = 0.75});
  any.arc(Base{4}, 0.75, 0.0);
  EXPECT_EQ(record.seen, (std::vector<std::string>{"derived 3: 25.500000", "event at 0.750000", "base 4: 0.750000"}));
}

}  // namespace
}  // namespace clatter::stepping::any_observer_test
