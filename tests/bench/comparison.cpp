#include "bench/comparison.hpp"

#include <algorithm>
#include <cmath>

namespace clatter::bench {
namespace {

/// An impact that the solver has to have, and the allowed error of its time.
struct Expected {
  double time, room;
};

/// A completed chatter or a rest.
struct Stay {
  double from, to;
};

/// The events on one stop.
struct Sequence {
  std::vector<Expected> impacts;
  std::vector<Stay> stays;
};

constexpr double share = 0.01;  // of the time to the nearest other impact, on whichever stop
std::vector<double> rooms(const std::vector<accuracy::Event>& impacts, double duration) {
  std::vector<double> result(impacts.size(), share * duration);
  for (std::size_t i = 1; i < impacts.size(); ++i) {
    const double room = (impacts[i].time - impacts[i - 1].time) * share;
    result[i] = room, result[i - 1] = std::min(result[i - 1], room);
  }
  return result;
}

Sequence sequence_of(const accuracy::RunRecord& record, Side side) {
  std::vector<accuracy::Event> impacts;
  for (const accuracy::Event& event : record.events)
    if (event.kind == accuracy::Event::Kind::impact) impacts.push_back(event);
  const std::vector<double> room = rooms(impacts, record.duration);
  Sequence sequence;
  for (std::size_t i = 0; i < impacts.size(); ++i)
    if (impacts[i].side == side) sequence.impacts.push_back({impacts[i].time, room[i]});
  for (const accuracy::Event& event : record.events) {  // the tolerance of times holds for its ends, too
    const double slack = 1e-3 * event.length;
    if (event.kind != accuracy::Event::Kind::impact && event.side == side)
      sequence.stays.push_back({event.time - slack, event.time + event.length + slack});
  }
  return sequence;
}

/// Counts the missed and the extra impacts of the solver on one stop.
class Matching {
 public:
  Matching(Sequence sequence, Comparison& result) : sequence_(std::move(sequence)), result_(result) {}

  void run(const std::vector<double>& times, double gave_up_at) {
    std::size_t j = 0;
    for (const auto& [time, room] : sequence_.impacts) {
      while (j < times.size() && times[j] - lag_ < time - room) unmatched(times[j++]);
      if (j < times.size() && times[j] - lag_ <= time + room)
        matched(times[j++] - time);
      else
        ++(time + room >= gave_up_at - lag_ ? result_.unreached : result_.missed);
    }
    while (j < times.size()) unmatched(times[j++]);
  }

 private:
  void matched(double lag) {
    lag_ = lag;
    result_.error_time = std::fmax(result_.error_time, std::abs(lag));
  }

  void unmatched(double time) {
    for (; stay_ < sequence_.stays.size(); ++stay_) {
      if (time - lag_ < sequence_.stays[stay_].from) break;
      if (time - lag_ <= sequence_.stays[stay_].to) return;
    }
    ++result_.extra;
  }

  Sequence sequence_;
  Comparison& result_;
  std::size_t stay_ = 0;
  double lag_ = 0.0;  ///< of the solver behind clatter, at the last pair
};

/// The size to which errors of the displacement are relative.
double size_of(const accuracy::RunRecord& record, const Stops& stops) {
  return record.events.empty() ? std::hypot(record.x, record.v) : (stops.upper - stops.lower) / 2;
}

}  // namespace

Comparison compare(const SolverRun& run, const accuracy::RunRecord& record, const Stops& stops) {
  Comparison result;
  for (const Side side : {Side::lower, Side::upper}) {
    std::vector<double> times;
    for (const accuracy::Event& impact : run.impacts())
      if (impact.side == side) times.push_back(impact.time);
    Sequence sequence = sequence_of(record, side);
    result.expected += sequence.impacts.size();
    Matching(std::move(sequence), result).run(times, run.gave_up_at());
  }
  result.error_x = std::abs(run.end() - record.x) / size_of(record, stops);
  return result;
}

}  // namespace clatter::bench
