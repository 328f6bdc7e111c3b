#include "sweep/binomial_share.hpp"

#include <boost/math/distributions/binomial.hpp>

namespace clatter::sweep {

BinomialShare binomial_share(std::size_t some, std::size_t all) {
  using Binomial = boost::math::binomial_distribution<>;
  constexpr double beyond = 0.05 / 2;  // on each side
  const auto trials = static_cast<double>(all), successes = static_cast<double>(some);
  return {successes / trials, Binomial::find_lower_bound_on_p(trials, successes, beyond),
          Binomial::find_upper_bound_on_p(trials, successes, beyond)};
}

}  // namespace clatter::sweep
