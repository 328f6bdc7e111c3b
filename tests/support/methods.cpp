#include "support/methods.hpp"

#include "steady/find_steady.hpp"
#include "stepping/dormand_prince.hpp"
#include "stepping/moreau.hpp"
#include "stepping/run.hpp"

namespace clatter::support {
namespace {

template <class Integrator>
class OfScene : public GeneralMethod {
 public:
  explicit OfScene(const point::Problem& scene)
      : scene_(scene), integrator_(scene_, scene_.integration, limits_of(scene_)) {}

  [[nodiscard]] double period() const override { return integrator_.period(); }
  [[nodiscard]] double impacts() const override { return integrator_.impacts(); }
  [[nodiscard]] double evaluations() const override { return integrator_.evaluations(); }
  [[nodiscard]] stepping::Outcome advance(motion::State<double>& state, double end, AnyObserver* observer) override {
    Showing shown{observer};
    return integrator_.advance(state, end, 0, shown);
  }
  [[nodiscard]] stepping::Outcome advance_to_section(motion::State<double>& state, std::int64_t origin,
                                                     AnyObserver* observer) override {
    Showing shown{observer};
    return stepping::advance_to_section(integrator_, state, origin, shown);
  }
  [[nodiscard]] stepping::Outcome run_for(motion::State<double>& state, double turns, AnyObserver* observer) override {
    Showing shown{observer};
    return stepping::run_for(integrator_, state, turns, shown);
  }
  [[nodiscard]] steady::ObservedTime find_steady(motion::State<double> start) override {
    return steady::find_steady(integrator_, start, scene_, scene_.time, scene_.integration);
  }

 private:
  point::Problem scene_;
  Integrator integrator_;
};

}  // namespace

motion::State<double> start_of(const Scene& scene) {
  motion::State<double> state;
  state.x = scene.start.displacement, state.v = scene.start.velocity;
  if (has_loose_mass(scene.loose)) state.loose = motion::loose_start<double>(scene);
  return state;
}

template <template <Effects> class Method>
std::unique_ptr<GeneralMethod> general_method(const point::Problem& scene) {
  return with_general_effects(scene, [&]<Effects effects>() -> std::unique_ptr<GeneralMethod> {
    return std::make_unique<OfScene<Method<effects>>>(scene);
  });
}

template std::unique_ptr<GeneralMethod> general_method<stepping::DormandPrince>(const point::Problem&);
template std::unique_ptr<GeneralMethod> general_method<stepping::Moreau>(const point::Problem&);

}  // namespace clatter::support
