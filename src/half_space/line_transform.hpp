#pragma once

/// @file
/// The discrete Fourier transform of one line of complex numbers, by FFTW or, without it, by
/// OpenCV.
///
/// CMake's MEMS_STICTION_WITH_FFTW chooses: line_transform_fftw.cpp is up to three times as fast
/// (doc/performance.md), and GPL; line_transform_opencv.cpp leaves the binaries free of that
/// licence. Neither divides by the length.
///
///     const LineTransform<float> rows(cols, from, to);
///     rows.forward(from, to);

#include <memory>

namespace mems_stiction {

/// Transforms lines of one length, for any number of threads at a time. Scalar float or double.
template <typename Scalar>
class LineTransform {
 public:
  /// - @p length of the lines, in complex numbers, >= 1
  /// - @p from, @p to show the alignment that all lines share; nothing is written to them
  LineTransform(int length, Scalar* from, Scalar* to);
  ~LineTransform();
  LineTransform(const LineTransform&) = delete;
  LineTransform& operator=(const LineTransform&) = delete;

  /// Sum over j of from_j exp(-2 pi i j k/length). The lines lie apart.
  void forward(Scalar* from, Scalar* to) const;
  /// The same with exp(+2 pi i j k/length).
  void backward(Scalar* from, Scalar* to) const;

 private:
  struct Plans;
  std::unique_ptr<Plans> plans_;
};

}  // namespace mems_stiction
