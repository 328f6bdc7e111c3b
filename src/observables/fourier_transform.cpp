#include "observables/fourier_transform.hpp"

#include <fftw3.h>

#include <algorithm>
#include <cassert>
#include <new>

namespace clatter {

class FourierTransform::Workspace {
 public:
  explicit Workspace(std::size_t size)
      : samples(fftw_alloc_real(size)),
        coefficients(reinterpret_cast<std::complex<double>*>(fftw_alloc_complex(size / 2 + 1))) {
    if (samples && coefficients) return;
    release();
    throw std::bad_alloc();
  }
  ~Workspace() { release(); }
  Workspace(const Workspace&) = delete;
  Workspace& operator=(const Workspace&) = delete;

  [[nodiscard]] fftw_complex* output() const { return reinterpret_cast<fftw_complex*>(coefficients); }

  double* samples;
  std::complex<double>* coefficients;

 private:
  void release() { fftw_free(samples), fftw_free(coefficients); }
};

struct FourierTransform::Plan {
  std::size_t size;
  fftw_plan plan;
};

// FFTW_ESTIMATE and one alignment: FFTW_MEASURE picks other plans, and other bits, from run to run.
FourierTransform::FourierTransform(std::size_t size) : plan_(new Plan{size, nullptr}) {
  Workspace memory(size);
  plan_->plan = fftw_plan_dft_r2c_1d(static_cast<int>(size), memory.samples, memory.output(), FFTW_ESTIMATE);
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

std::span<const std::complex<double>> FourierTransform::transform(std::span<const double> samples,
                                                                  Workspace& workspace) const {
  assert(samples.size() == plan_->size);
  std::copy(samples.begin(), samples.end(), workspace.samples);
  fftw_execute_dft_r2c(plan_->plan, workspace.samples, workspace.output());
  const std::span<std::complex<double>> result(workspace.coefficients, plan_->size / 2 + 1);
  for (auto& coefficient : result) coefficient /= static_cast<double>(plan_->size);
  return result;
}

}  // namespace clatter
