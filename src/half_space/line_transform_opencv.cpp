#include <opencv2/core.hpp>

#include "line_transform.hpp"

namespace mems_stiction {

template <typename Scalar>
struct LineTransform<Scalar>::Plans {
  void apply(Scalar* from, Scalar* to, int flags) const {
    const int type = CV_MAKETYPE(cv::DataType<Scalar>::depth, 2);
    const cv::Mat source(1, length, type, from);
    cv::Mat target(1, length, type, to);  // of the right size and type: OpenCV writes into it
    cv::dft(source, target, flags);
  }

  int length;
};

template <typename Scalar>
LineTransform<Scalar>::LineTransform(int length, Scalar* /*from*/, Scalar* /*to*/)
    : plans_(std::make_unique<Plans>(Plans{length})) {}

template <typename Scalar>
LineTransform<Scalar>::~LineTransform() = default;

template <typename Scalar>
void LineTransform<Scalar>::forward(Scalar* from, Scalar* to) const {
  plans_->apply(from, to, 0);
}

template <typename Scalar>
void LineTransform<Scalar>::backward(Scalar* from, Scalar* to) const {
  plans_->apply(from, to, cv::DFT_INVERSE);
}

template class LineTransform<float>;
template class LineTransform<double>;

}  // namespace mems_stiction
