#pragma once

#include <optional>
#include <vector>

#include "linear.hpp"

namespace verify {

/// All eigenvalues, each by (real part, imaginary part); nothing if balls are too wide to tell them.
[[nodiscard]] std::optional<std::vector<Vector>> eigenvalues(const Matrix& m);
[[nodiscard]] std::optional<std::vector<Vector>> eigenvalues(const FourByFour& m);

}  // namespace verify
