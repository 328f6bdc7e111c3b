#pragma once

#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace clatter {

/// A plan for the transform of `size` real samples, made once; `transform` may then run in any number of threads.
class FourierTransform {
 public:
  explicit FourierTransform(std::size_t size);  ///< Throws std::bad_alloc.
  ~FourierTransform();
  FourierTransform(FourierTransform&&) noexcept;
  FourierTransform& operator=(FourierTransform&&) noexcept;

  /// Memory of one thread, aligned as the plan wants it.
  class Workspace;
  [[nodiscard]] std::unique_ptr<Workspace, void (*)(Workspace*)> workspace() const;

  /// Coefficients X_j = (1/N) sum_i samples[i] exp(-2 pi i j i/N), shape [N/2 + 1], valid until the workspace is used
  /// again.
  [[nodiscard]] std::span<const std::complex<double>> transform(std::span<const double> samples,
                                                                Workspace& workspace) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

}  // namespace clatter
