#include <array>
#include <charconv>

#include "certificate.hpp"

namespace verify {

Ball Number::ball() const {
  if (const double* const value = std::get_if<double>(&value_)) return Ball(*value);
  Ball ball;
  if (!Ball::read(std::get<std::string>(value_), ball)) throw FormatError("a number that can't be read");
  return ball;
}

std::string Number::text() const {
  if (const auto* const text = std::get_if<std::string>(&value_)) return *text;
  std::array<char, 32> buffer{};
  const auto end = std::to_chars(buffer.data(), buffer.data() + buffer.size(), std::get<double>(value_)).ptr;
  return {buffer.data(), end};
}

/// Numbers are below 2^1024, so with 4096 bits each is known to less than 2^-3072. A text has 400 characters at most
/// and is above 1e-300, so it is a multiple of 1e-700, a double is one of 2^-1074: two that aren't the same are at
/// least 2^-1074 5^-700 > 2^-2700 apart.
std::strong_ordering operator<=>(const Number& a, const Number& b) {
  const Precision enough(4096);
  const Ball x = a.ball(), y = b.ball();
  if (x < y) return std::strong_ordering::less;
  return x > y ? std::strong_ordering::greater : std::strong_ordering::equal;
}

namespace {

/// A scene of the numbers that `of(member, stop)` gives; stop -1: a number of the scene itself.
template <class T, class Of>
BasicScene<T> scene_made(const Certificate::SceneNumbers& shape, const Of& of) {
  using In = Certificate::SceneNumbers;
  using At = Certificate::StopNumbers;
  const auto of_scene = [&](Number In::*member) { return of([=](const In& in) { return in.*member; }); };
  BasicScene<T> scene{of_scene(&In::h),
                      of_scene(&In::k),
                      {},
                      of_scene(&In::nu),
                      of_scene(&In::load),
                      of_scene(&In::phase),
                      {},
                      of_scene(&In::friction),
                      of_scene(&In::friction_static),
                      shape.friction == shape.friction_static};
  const auto add_order = [&](int j, const T& sine, const T& cosine) {
    if (!sine.is_zero() || !cosine.is_zero()) scene.force.orders.push_back({j, sine, cosine});
  };
  const auto of_order = [&](std::size_t i, Number Certificate::OrderNumbers::*member) {
    return of([=](const In& in) { return in.orders[i].*member; });
  };
  T first_cosine(0);
  for (std::size_t i = 0; i < shape.orders.size(); ++i) {
    const T cosine = of_order(i, &Certificate::OrderNumbers::cosine);
    if (shape.orders[i].order == 1)
      first_cosine = cosine;
    else
      add_order(shape.orders[i].order, of_order(i, &Certificate::OrderNumbers::sine), cosine);
  }
  add_order(1, of_scene(&In::f), first_cosine);
  for (std::size_t i = 0; i < 2; ++i) {
    if (!shape.stops[i]) continue;
    const auto of_stop = [&](Number At::*member) {
      return of([=](const In& in) { return in.stops[i] ? *in.stops[i].*member : Number(); });
    };
    BasicStop<T> stop{of_stop(&At::position), shape.stops[i]->soft, T(0), T(0), T(0), T(0)};
    if (stop.soft)
      stop.kappa = of_stop(&At::stiffness), stop.zeta = of_stop(&At::damping), stop.h_s = stop.zeta * sqrt(stop.kappa);
    else
      stop.R = of_stop(&At::R);
    if (shape.stops[i]->law) stop.law = shape.stops[i]->law->in_balls();
    scene.stops[i] = stop;
  }
  return scene;
}

}  // namespace

/// R = 1 stays 1 at each speed.
Law Certificate::LawNumbers::in_balls() const {
  Law law{R.ball()};
  if (exponent && R < Number(1.0)) law.exponent = exponent->ball(), law.reference = reference_speed.ball();
  law.below = below.ball();
  for (const Knot& knot : table) law.knots.push_back({knot.speed.ball() * unit.ball(), knot.R.ball()});
  return law;
}

Scene Certificate::scene_in_balls() const {
  Scene made = scene_made<Ball>(scene, [&](const auto& number_in) { return number_in(scene).ball(); });
  if (!scene.loose) return made;
  const auto& R = scene.loose->R;
  LooseMass loose{scene.loose->mass.ball(), {R[0].ball(), R[1].ball()}, scene.loose->load.ball(), {}};
  loose.friction = scene.loose->friction.ball(), loose.friction_static = scene.loose->friction_static.ball();
  loose.is_let_go_gently = scene.loose->friction == scene.loose->friction_static;
  for (std::size_t i = 0; i < 2; ++i)
    if (scene.loose->walls[i]) loose.walls[i] = scene.loose->walls[i]->ball();
  for (std::size_t i = 0; i < 2; ++i)
    if (scene.loose->laws[i]) loose.laws[i] = scene.loose->laws[i]->in_balls();
  made.loose = loose;
  return made;
}

MovingScene Certificate::moving_scene(const Ball& offset) const {
  return scene_made<Dual>(scene, [&](const auto& number_in) {
    const Ball slope = number_in(special->slopes).ball();
    const Ball here = number_in(scene).ball();
    return slope.is_zero() ? Dual(here) : Dual(here + slope * offset, slope);
  });
}

std::vector<Ball> Certificate::values_of_parameter() const {
  std::vector<Ball> values;
  const auto consider = [&](const Number& slope, const Number& number) {
    const Ball s = slope.ball();
    if ((abs(s) - Ball(1)).is_zero()) values.push_back(s * number.ball());
  };
  const SceneNumbers& slopes = special->slopes;
  for (Number SceneNumbers::*const member :
       {&SceneNumbers::h, &SceneNumbers::k, &SceneNumbers::f, &SceneNumbers::nu, &SceneNumbers::load})
    consider(slopes.*member, scene.*member);  // a phase is counted from anywhere
  for (std::size_t i = 0; i < scene.orders.size(); ++i)
    for (Number OrderNumbers::*const member : {&OrderNumbers::sine, &OrderNumbers::cosine})
      consider(slopes.orders[i].*member, scene.orders[i].*member);
  for (std::size_t i = 0; i < 2; ++i)
    for (Number StopNumbers::*const member :
         {&StopNumbers::position, &StopNumbers::R, &StopNumbers::stiffness, &StopNumbers::damping})
      if (scene.stops[i] && slopes.stops[i]) consider(*slopes.stops[i].*member, *scene.stops[i].*member);
  return values;
}

Start Certificate::start_in_balls() const {
  return {start_time.ball(),
          start_x.value.ball(),
          start_v.value.ball(),
          released.has_value(),
          released.value_or(Side::lower),
          start_z.value.ball(),
          start_w.value.ball(),
          pressed};
}

}  // namespace verify
