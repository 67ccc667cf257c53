#include <mutex>

#include <fftw3.h>

#include "numeric/fftw_planner.hpp"

#include "line_transform.hpp"

namespace mems_stiction {
namespace {

/// FFTW's names for one precision. Plans are estimated, never timed, so that they are the same in
/// every run.
template <typename Scalar>
struct Fftw;

template <>
struct Fftw<double> {
  using Complex = fftw_complex;
  using Plan = fftw_plan;
  static Plan plan(int length, Complex* from, Complex* to, int sign) {
    return fftw_plan_dft_1d(length, from, to, sign, FFTW_ESTIMATE);
  }
  static void execute(Plan plan, Complex* from, Complex* to) { fftw_execute_dft(plan, from, to); }
  static void destroy(Plan plan) { fftw_destroy_plan(plan); }
};

template <>
struct Fftw<float> {
  using Complex = fftwf_complex;
  using Plan = fftwf_plan;
  static Plan plan(int length, Complex* from, Complex* to, int sign) {
    return fftwf_plan_dft_1d(length, from, to, sign, FFTW_ESTIMATE);
  }
  static void execute(Plan plan, Complex* from, Complex* to) { fftwf_execute_dft(plan, from, to); }
  static void destroy(Plan plan) { fftwf_destroy_plan(plan); }
};

}  // namespace

template <typename Scalar>
struct LineTransform<Scalar>::Plans {
  using Library = Fftw<Scalar>;
  using Complex = typename Library::Complex;
  static Complex* complex(Scalar* line) { return reinterpret_cast<Complex*>(line); }

  typename Library::Plan forward;
  typename Library::Plan backward;
};

template <typename Scalar>
LineTransform<Scalar>::LineTransform(int length, Scalar* from, Scalar* to)
    : plans_(std::make_unique<Plans>()) {
  const std::lock_guard<std::mutex> lock(plannerMutex());
  plans_->forward =
      Plans::Library::plan(length, Plans::complex(from), Plans::complex(to), FFTW_FORWARD);
  plans_->backward =
      Plans::Library::plan(length, Plans::complex(from), Plans::complex(to), FFTW_BACKWARD);
}

template <typename Scalar>
LineTransform<Scalar>::~LineTransform() {
  const std::lock_guard<std::mutex> lock(plannerMutex());
  Plans::Library::destroy(plans_->forward);
  Plans::Library::destroy(plans_->backward);
}

template <typename Scalar>
void LineTransform<Scalar>::forward(Scalar* from, Scalar* to) const {
  Plans::Library::execute(plans_->forward, Plans::complex(from), Plans::complex(to));
}

template <typename Scalar>
void LineTransform<Scalar>::backward(Scalar* from, Scalar* to) const {
  Plans::Library::execute(plans_->backward, Plans::complex(from), Plans::complex(to));
}

template class LineTransform<float>;
template class LineTransform<double>;

}  // namespace mems_stiction
