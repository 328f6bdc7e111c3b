#include "curve.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "orbit.hpp"

namespace verify {

Ball dot(const Place& a, const Place& b) { return a.x * b.x + a.v * b.v + a.p * b.p; }
Place cross(const Place& a, const Place& b) {
  return {a.v * b.p - a.p * b.v, a.p * b.x - a.x * b.p, a.x * b.v - a.v * b.x};
}

namespace {

using Rows = std::array<Place, 3>;

Place operator*(const Rows& m, const Place& a) { return {dot(m[0], a), dot(m[1], a), dot(m[2], a)}; }

Rows inverse_of(const Rows& m) {
  const Place a = cross(m[1], m[2]), b = cross(m[2], m[0]), c = cross(m[0], m[1]);
  const Ball one = Ball(1) / dot(m[0], a);
  return {one * Place{a.x, b.x, c.x}, one * Place{a.v, b.v, c.v}, one * Place{a.p, b.p, c.p}};
}

/// The columns of a matrix.
Rows transposed(const Rows& m) {
  return {Place{m[0].x, m[1].x, m[2].x}, Place{m[0].v, m[1].v, m[2].v}, Place{m[0].p, m[1].p, m[2].p}};
}

Scene values_of(const MovingScene& moving) {
  Scene scene{moving.h.value,
              moving.k.value,
              values_of(moving.force),
              moving.nu.value,
              moving.load.value,
              moving.phase.value,
              {}};
  for (std::size_t i = 0; i < 2; ++i)
    if (const auto& stop = moving.stops[i])
      scene.stops[i] =
          Stop{stop->position.value, stop->soft, stop->R.value, stop->kappa.value, stop->zeta.value, stop->h_s.value};
  return scene;
}

Ball within(const Ball& width) { return Ball::around_zero(width); }

}  // namespace

Curve::Curve(const Certificate& certificate)
    : certificate_(certificate),
      kept_(certificate),
      mirrored_(certificate.symmetric.value_or(false) && !certificate.released),
      claimed_{certificate.start_x.value.ball(), certificate.start_v.value.ball(), Ball(0)},
      errors_{certificate.start_x.error.ball(), certificate.start_v.error.ball(),
              certificate.special->parameter.error.ball()} {
  if (mirrored_) {
    if (certificate.periods % 2 == 0 || certificate.events.size() % 2 != 0)
      throw Refuted("symmetric: claimed true, found false");
    kept_.events.resize(certificate.events.size() / 2);
    if (!mirror_centre(certificate.moving_scene(Ball(0))))
      throw Undecided("symmetric: the scenes aren't, to their last digit");
  }
  if (certificate.released) {
    centre_ = {Ball(0), Ball(0), Ball(0)}, reach_ = errors_.p * Ball(1.5);
    return;
  }
  try {
    find_centre();
  } catch (const Refuted& near) {  // of motion from the middle of the claimed errors
    (void)pass({claimed_.x + within(errors_.x), claimed_.v + within(errors_.v), within(errors_.p)});
    throw Undecided(near.what());
  }
  prove();
}

Curve::Passage Curve::pass(const Place& at) const {
  struct Kept {
    Family family;
    Scene scene;
  };
  const auto keep = std::make_shared<Kept>();
  keep->family.scene = certificate_.moving_scene(at.p), keep->scene = values_of(keep->family.scene);
  const Dual whole = Dual(Ball(certificate_.periods)) * keep->family.scene.period();
  const Dual length = mirrored_ ? whole / Dual(2) : whole;
  keep->family.end_slope = length.slope;
  Start start = certificate_.start_in_balls();
  start.x = at.x, start.v = at.v;
  Motion motion(keep->scene, keep->family, start);
  Course course(kept_, motion, motion.start_time() + length.value);
  const auto first = motion.release();
  course.run();
  if (certificate_.released) require_same_release(certificate_, course, first, motion.release());
  Passage passage{course.events(), motion.stretches(), Ball(0), Ball(0), of_main(motion.derivative()), {}, {}, keep};
  if (certificate_.released) return passage;
  Vector end = of_main(motion.centre()), by_parameter = of_main(motion.by_parameter());
  Matrix& m = passage.derivative;
  if (mirrored_) {
    const Dual twice = Dual(2) * *mirror_centre(certificate_.moving_scene(Ball(0)));
    end = {twice.value + twice.slope * at.p - end.x, -end.y};
    by_parameter = {twice.slope - by_parameter.x, -by_parameter.y};
    m = {-m.a, -m.b, -m.c, -m.d};
  }
  passage.x = end.x - at.x, passage.v = end.y - at.v;
  passage.row_x = {m.a - Ball(1), m.b, by_parameter.x}, passage.row_v = {m.c, m.d - Ball(1), by_parameter.y};
  return passage;
}

Place Curve::direction(const Passage& passage) const {
  if (certificate_.released) return {Ball(0), Ball(0), Ball(1)};
  return cross(passage.row_x, passage.row_v);
}

/// Newton's steps from the claimed place across the curve.
void Curve::find_centre() {
  centre_ = claimed_.middle();
  for (int iteration = 0; iteration < 3; ++iteration) {
    const Passage thin = pass(centre_);
    const Place along = cross(thin.row_x, thin.row_v);
    along_ = (Ball(1) / sqrt(dot(along, along)) * along).middle();
    const Rows inverse = inverse_of({thin.row_x, thin.row_v, along_});
    for (std::size_t i = 0; i < 3; ++i) inverse_[i] = inverse[i].middle();
    residual_ = {thin.x, thin.v, Ball(0)};
    if (iteration == 2) break;
    const Place step = inverse_ * residual_;
    if (!step.is_finite()) throw Undecided("Newton's step");
    centre_ = (centre_ + Ball(-1) * step).middle();
  }
  const Place away = centre_ + Ball(-1) * claimed_;
  const auto reach = [](const Ball& a, const Ball& b) { return (abs(a) * b).upper(); };
  const Place all{(errors_.x + abs(away.x)).upper(), (errors_.v + abs(away.v)).upper(),
                  (errors_.p + abs(away.p)).upper()};
  reach_ = (reach(along_.x, all.x) + reach(along_.v, all.v) + reach(along_.p, all.p)).upper();
  const Ball least = (Ball(0.05) * reach_).upper();
  const auto width = [&](const Ball& part, const Ball& error) {
    return Ball(std::max((Ball(1.25) * abs(part) * reach_ + least).near(), 1.25 * error.near()));
  };
  box_ = {width(along_.x, all.x), width(along_.v, all.v), width(along_.p, all.p)};
}

/// The part of a displacement that Newton's step leaves, by the derivatives over all of a box.
std::array<Place, 3> Curve::rest_over(const Place& box) const {
  const Passage all = pass(box);
  const Rows slope = transposed({all.row_x, all.row_v, along_});
  Rows rest;
  for (std::size_t i = 0; i < 3; ++i)
    rest[i] = {Ball(i == 0 ? 1 : 0) - dot(inverse_[i], slope[0]), Ball(i == 1 ? 1 : 0) - dot(inverse_[i], slope[1]),
               Ball(i == 2 ? 1 : 0) - dot(inverse_[i], slope[2])};
  return rest;
}

/// Krawczyk's operator on all places of the box, for all distances along the curve.
void Curve::prove() {
  const Place box{within(box_.x), within(box_.v), within(box_.p)};
  rest_ = rest_over(centre_ + box);
  const Place image = Ball(-1) * (inverse_ * (residual_ + Place{Ball(0), Ball(0), within(reach_)})) + rest_ * box;
  if (!image.is_finite()) throw Undecided("Krawczyk's operator");
  if (!image.x.overlaps(box.x) || !image.v.overlaps(box.v) || !image.p.overlaps(box.p))
    throw Refuted("no motion within the claimed errors is periodic");
  if (!box.x.holds_inside(image.x) || !box.v.holds_inside(image.v) || !box.p.holds_inside(image.p))
    throw Undecided("whether there is a periodic motion: Krawczyk's operator doesn't contract");
}

Place Curve::at(const Ball& distance) const {
  if (certificate_.released) return {Ball(0), Ball(0), distance};
  Place box{within(box_.x), within(box_.v), within(box_.p)};
  for (int iteration = 0; iteration < 3; ++iteration) {
    const Place image = inverse_ * Place{-residual_.x, -residual_.v, distance} + rest_ * box;
    box = {box.x.within(image.x), box.v.within(image.v), box.p.within(image.p)};
  }
  const Place first = centre_ + box, near = first.middle();  // once more about this place, so that less is left
  const Passage thin = pass(near);
  const Place residual{thin.x, thin.v, dot(along_, near + Ball(-1) * centre_) - distance};
  const Place image = Ball(-1) * (inverse_ * residual) + rest_over(first) * (first + Ball(-1) * near);
  return {first.x.within(near.x + image.x), first.v.within(near.v + image.v), first.p.within(near.p + image.p)};
}

Place Curve::everywhere() const {
  return certificate_.released ? Place{Ball(0), Ball(0), within(reach_)}
                               : centre_ + Place{within(box_.x), within(box_.v), within(box_.p)};
}

bool Curve::may_be_claimed(const Place& place) const {
  const auto overlaps = [](const Ball& value, const Ball& claimed, const Ball& error) {
    return !(abs(value - claimed) > error);
  };
  return overlaps(place.p, claimed_.p, errors_.p) &&
         (certificate_.released ||
          (overlaps(place.x, claimed_.x, errors_.x) && overlaps(place.v, claimed_.v, errors_.v)));
}

}  // namespace verify
