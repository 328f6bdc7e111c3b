#include "eigenvalues.hpp"

#include <acb_mat.h>

namespace verify {

std::optional<std::vector<Vector>> eigenvalues(const Matrix& m) {
  const Ball half = (m.a + m.d) / Ball(2), rest = square((m.a - m.d) / Ball(2)) + m.b * m.c;
  if (rest.is_positive()) return std::vector{Vector{half + sqrt(rest), Ball(0)}, Vector{half - sqrt(rest), Ball(0)}};
  if (rest.is_negative()) return std::vector{Vector{half, sqrt(-rest)}, Vector{half, -sqrt(-rest)}};
  if (rest.is_zero()) return std::vector{Vector{half, Ball(0)}, Vector{half, Ball(0)}};
  return std::nullopt;
}

std::optional<std::vector<Vector>> eigenvalues(const FourByFour& m) {
  acb_mat_t matrix, vectors;
  acb_mat_init(matrix, 4, 4), acb_mat_init(vectors, 4, 4);
  acb_ptr near = _acb_vec_init(4), found = _acb_vec_init(4);
  for (slong i = 0; i < 4; ++i)
    for (slong j = 0; j < 4; ++j)
      m[static_cast<std::size_t>(i)][static_cast<std::size_t>(j)].copy_to(acb_realref(acb_mat_entry(matrix, i, j)));
  acb_mat_approx_eig_qr(near, nullptr, vectors, matrix, nullptr, 0, bits);
  const bool apart = acb_mat_eig_multiple(found, matrix, near, vectors, bits) != 0;
  std::optional<std::vector<Vector>> values;
  if (apart) values.emplace();
  for (slong i = 0; i < 4 && apart; ++i)
    values->push_back({Ball::copied(acb_realref(found + i)), Ball::copied(acb_imagref(found + i))});
  _acb_vec_clear(near, 4), _acb_vec_clear(found, 4);
  acb_mat_clear(matrix), acb_mat_clear(vectors);
  return values;
}

}  // namespace verify
