#pragma once

#include <cstddef>

namespace clatter::sweep {

/// A share of samples and its 95 % interval (Clopper & Pearson 1934).
struct BinomialShare {
  double share = 0.0, low = 0.0, high = 1.0;
};

/// The share that `some` of `all` are, of which there is one at least.
[[nodiscard]] BinomialShare binomial_share(std::size_t some, std::size_t all);

}  // namespace clatter::sweep
