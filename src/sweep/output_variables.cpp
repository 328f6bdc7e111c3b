#include "sweep/result_store.hpp"

namespace clatter::sweep {

std::vector<OutputVariable> outputs_of(const point::RunSettings& settings) {
  std::vector<OutputVariable> outputs;
  if (settings.time.mode == steady::Mode::steady)
    outputs.push_back(observables::scalar("settling_estimate",
                                          "forcing periods until within the tolerance of the steady motion",
                                          &point::PointResult::settling_estimate));
  for (OutputVariable& output : observables::All::columns<point::PointResult>(settings.observe))
    outputs.push_back(std::move(output));
  return outputs;
}

std::vector<std::string> names_of_texts() {
  std::vector<std::string> names = observables::All::names_of_texts();
  names.insert(names.end(), {"motion_word", "motion_regime"});
  return names;
}

}  // namespace clatter::sweep
