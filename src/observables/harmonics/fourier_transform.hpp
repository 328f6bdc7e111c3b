#pragma once

#include <array>
#include <complex>
#include <cstddef>
#include <memory>
#include <span>

namespace clatter::observables {

/// A plan for the transforms of `batch` rows of `size` real samples each, all at once, made once; `transform` may then
/// run in any number of threads.
class FourierTransform {
 public:
  static constexpr std::size_t batch = 2;  ///< displacement and velocity of a point; more at once are no faster
  template <class T>
  using Rows = std::array<std::span<T>, batch>;

  explicit FourierTransform(std::size_t size);  ///< Throws std::bad_alloc.
  ~FourierTransform();
  FourierTransform(FourierTransform&&) noexcept;
  FourierTransform& operator=(FourierTransform&&) noexcept;

  /// Memory of one thread, aligned as the plan requires.
  class Workspace;
  [[nodiscard]] std::unique_ptr<Workspace, void (*)(Workspace*)> workspace() const;

  [[nodiscard]] std::size_t size() const;  ///< N
  /// The samples that are transformed, shape [row][N], to be written.
  [[nodiscard]] Rows<double> samples(Workspace& workspace) const;
  /// Sums S_j = sum_i samples[i] exp(-2 pi i j i/N) of each row, shape [row][N/2 + 1], valid until the workspace is
  /// used again; S_j / N are the Fourier coefficients.
  [[nodiscard]] Rows<const std::complex<double>> transform(Workspace& workspace) const;

 private:
  struct Plan;
  std::unique_ptr<Plan> plan_;
};

/// A transform that threads share, and the memory that each of them has for it; empty if none is made.
struct FourierScratch {
  std::shared_ptr<const FourierTransform> transform{};
  std::unique_ptr<FourierTransform::Workspace, void (*)(FourierTransform::Workspace*)> workspace{nullptr, nullptr};

  /// The transform that this one shares, with memory of its own.
  [[nodiscard]] FourierScratch for_another_thread() const {
    if (!transform) return {};
    return {transform, transform->workspace()};
  }
};

}  // namespace clatter::observables
