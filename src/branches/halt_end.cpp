#include "branches/halt_end.hpp"

#include <algorithm>

namespace clatter::branches {

void end_in_change(const Equations& equations, double tolerance, const NearEnd& end,
                   const std::vector<HaltChange>& changes, Record& record, std::deque<Waiting>& waiting,
                   std::int64_t generation) {
  std::optional<ExactGraze> exact;
  const auto found = std::ranges::find_if(changes, [&](const HaltChange& change) {
    return (exact = exact_change(equations, end.beyond, change, end.within, tolerance)).has_value();
  });
  if (found == changes.end()) return record.add(end.last), record.fail(end.last, no_halt_change);
  const HaltChange& change = *found;
  const auto with_form = [&](HaltForm form) { return formed(exact->scene, exact->orbit, exact->impact, form); };
  BranchPoint at = end.last;
  at.scene = exact->scene, at.orbit = with_form(change.before.value_or(HaltForm::stick));
  const BranchPoint& last = change.before ? at : end.last;
  record.add(last);
  const auto [special, is_new] = record.note(change.kind, at, change.condition);
  record.end(last, std::string(name_of(change.kind)));
  if (!is_new || !(change.beyond || change.strikes)) return no_longer_waits(waiting, special, last.orbit);
  waiting.push_back({exact->scene, with_form(change.beyond.value_or(HaltForm::stick)), {}, special, generation});
  if (change.strikes) waiting.back().opens = exact->impact;
}

}  // namespace clatter::branches
