#pragma once

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "accuracy/run_record.hpp"
#include "motion/walls.hpp"
#include "point/problem.hpp"
#include "scene/effects.hpp"
#include "steady/observed_time.hpp"
#include "stepping/integration.hpp"
#include "support/seen_arc.hpp"

namespace clatter::support {

/// A general method on a scene, with all effects that this can have.
class GeneralMethod {
 public:
  virtual ~GeneralMethod() = default;
  [[nodiscard]] virtual double period() const = 0;
  [[nodiscard]] virtual double impacts() const = 0;
  [[nodiscard]] virtual double evaluations() const = 0;
  /// As the functions of these names in `steady` and `stepping`; without an observer nobody looks on.
  [[nodiscard]] virtual stepping::Outcome advance(motion::State<double>& state, double end,
                                                  AnyObserver* observer = nullptr) = 0;
  [[nodiscard]] virtual stepping::Outcome advance_to_section(motion::State<double>& state, std::int64_t origin,
                                                             AnyObserver* observer = nullptr) = 0;
  [[nodiscard]] virtual stepping::Outcome run_for(motion::State<double>& state, double turns,
                                                  AnyObserver* observer = nullptr) = 0;
  [[nodiscard]] virtual steady::ObservedTime find_steady(motion::State<double> start) = 0;
};

[[nodiscard]] motion::State<double> start_of(const Scene& scene);

/// `Method`: stepping::DormandPrince or stepping::Moreau.
template <template <Effects> class Method>
[[nodiscard]] std::unique_ptr<GeneralMethod> general_method(const point::Problem& scene);

/// Runs a scene from its start for a time in tau by a general method, DormandPrince or Moreau, reporting to an
/// observer; returns the final state and the work.
template <template <Effects> class Method, class Observer>
accuracy::RunRecord run_by(const point::Problem& scene, double duration, Observer& observer) {
  const auto method = general_method<Method>(scene);
  Seeing<Observer> seeing(observer);
  motion::State<double> state = start_of(scene);
  accuracy::RunRecord record;
  record.duration = duration;
  record.outcome = method->run_for(state, duration / method->period(), &seeing);
  record.x = state.x, record.v = state.v;
  if (has_loose_mass(scene.loose)) {
    const auto [z, w] = motion::place_in_housing(state, scene.loose);
    record.z = z, record.w = w;
  }
  record.impacts = method->impacts(), record.evaluations = method->evaluations();
  return record;
}

/// Records the events of a run.
struct EventList {
  std::vector<accuracy::Event> events{};

  void arc(const SeenArc&, double, double) {}
  void event(const motion::Event& event) {
    if (event.kind != motion::Event::Kind::press) events.push_back(event.in_housing());
  }
};

/// The run of a scene by a general method, as record_of gives that of the exact one.
template <template <Effects> class Method>
accuracy::RunRecord record_by(const point::Problem& scene, double duration) {
  EventList list;
  accuracy::RunRecord record = run_by<Method>(scene, duration, list);
  record.events = accuracy::as_compared(list.events);
  if (has_loose_mass(scene.loose)) record.events = accuracy::with_slow_impacts_summed(record.events);
  return record;
}

/// The rests of a run that last longer than a time; of those that sections cut, the whole.
inline std::vector<accuracy::Event> rests_of(const accuracy::RunRecord& record, double longer_than = 0.0) {
  std::vector<accuracy::Event> rests = accuracy::with_rests_joined(record.events);
  std::erase_if(rests, [&](const accuracy::Event& event) {
    return event.kind != accuracy::Event::Kind::rest || event.length <= longer_than;
  });
  return rests;
}

/// The order of y in x: slope of the straight line through (log x, log y), by least squares.
inline double order_of(const std::vector<double>& x, const std::vector<double>& y) {
  double n = 0, sx = 0, sy = 0, sxx = 0, sxy = 0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    const double u = std::log(x[i]), w = std::log(y[i]);
    n += 1, sx += u, sy += w, sxx += u * u, sxy += u * w;
  }
  return (n * sxy - sx * sy) / (n * sxx - sx * sx);
}

}  // namespace clatter::support
