#include "observables/harmonics/fourier_transform.hpp"

#include <fftw3.h>

#include <new>

namespace clatter::observables {
namespace {

/// Distance between rows of samples; even, so that every row is aligned like the first.
std::size_t sample_stride(std::size_t size) { return size + size % 2; }
std::size_t sums_of(std::size_t size) { return size / 2 + 1; }

}  // namespace

class FourierTransform::Workspace {
 public:
  explicit Workspace(std::size_t size)
      : samples(fftw_alloc_real(batch * sample_stride(size))),
        sums(reinterpret_cast<std::complex<double>*>(fftw_alloc_complex(batch * sums_of(size)))) {
    if (samples && sums) return;
    release();
    throw std::bad_alloc();
  }
  ~Workspace() { release(); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  [[nodiscard]] fftw_complex* output() const { return reinterpret_cast<fftw_complex*>(sums); }

  double* samples;             ///< shape [row][sample_stride]
  std::complex<double>* sums;  ///< shape [row][N/2 + 1]

 private:
  void release() { fftw_free(samples), fftw_free(sums); }
};

struct FourierTransform::Plan {
  std::size_t size;
  fftw_plan plan;
};

// FFTW_ESTIMATE and one alignment: FFTW_MEASURE picks other plans, and other bits, from run to run.
FourierTransform::FourierTransform(std::size_t size) : plan_(new Plan{size, nullptr}) {
  Workspace memory(size);
  const int length = static_cast<int>(size), rows = static_cast<int>(batch);
  plan_->plan =
      fftw_plan_many_dft_r2c(1, &length, rows, memory.samples, nullptr, 1, static_cast<int>(sample_stride(size)),
                             memory.output(), nullptr, 1, static_cast<int>(sums_of(size)), FFTW_ESTIMATE);
  if (!plan_->plan) throw std::bad_alloc();
}

FourierTransform::~FourierTransform() {
  if (plan_) fftw_destroy_plan(plan_->plan);
}
FourierTransform::FourierTransform(FourierTransform&&) noexcept = default;
FourierTransform& FourierTransform::operator=(FourierTransform&&) noexcept = default;

std::unique_ptr<FourierTransform::Workspace, void (*)(FourierTransform::Workspace*)> FourierTransform::workspace()
    const {
  return {new Workspace(plan_->size), [](Workspace* workspace) { delete workspace; }};
}

std::size_t FourierTransform::size() const { return plan_->size; }

auto FourierTransform::samples(Workspace& workspace) const -> Rows<double> {
  return {std::span(workspace.samples, size()), std::span(workspace.samples + sample_stride(size()), size())};
}

auto FourierTransform::transform(Workspace& workspace) const -> Rows<const std::complex<double>> {
  fftw_execute_dft_r2c(plan_->plan, workspace.samples, workspace.output());
  const std::size_t each = sums_of(size());
  return {std::span(workspace.sums, each), std::span(workspace.sums + each, each)};
}

}  // namespace clatter::observables
