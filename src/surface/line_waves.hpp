#pragma once

/// @file
/// The discrete Fourier transform of lines whose length is a power of two, in place, for
/// convolutions: `forward` leaves the coefficients in the order in which its butterflies end, and
/// `backward` starts from that order. A line may be several lines side by side, one in each element
/// of FloatPacket. Additions and multiplications alone, in a fixed order: the same bits on every
/// processor, which libraries that fuse the two where the processor can do not promise. Source:
/// Gentleman and Sande, AFIPS Conf. Proc. 29 (1966) 563, with four-point butterflies.

#include <cstddef>
#include <vector>

#include "numeric/vectorized.hpp"

namespace mems_stiction {

/// A complex number, or one in each element.
template <typename Real>
struct Complex {
  Real re;
  Real im;
};

/// The transform of lines of one length. Scalar float or double.
template <typename Scalar>
class LineWaves {
 public:
  /// - @p length a power of two, >= 2
  explicit LineWaves(std::size_t length);

  std::size_t length() const { return length_; }
  /// Number of the wave whose coefficient `forward` leaves at each place: wave k is exp(2 pi i j
  /// k/length).
  const std::vector<std::size_t>& order() const { return order_; }

  /// Sum over j of line_j exp(-2 pi i j k/length). Real is Scalar, or packets of it.
  template <typename Real>
  MEMS_STICTION_INLINE void forward(Complex<Real>* line) const;
  /// The same with exp(+2 pi i j k/length), from the order of forward() to that of places. Not
  /// divided by the length.
  template <typename Real>
  MEMS_STICTION_INLINE void backward(Complex<Real>* line) const;

 private:
  struct Turns {
    Complex<Scalar> once;
    Complex<Scalar> twice;
    Complex<Scalar> thrice;
  };

  std::size_t length_;
  std::vector<std::size_t> order_;
  std::vector<std::vector<Turns>> turns_;  ///< for each pass of forward(), by place in a quarter
};

template <typename Real, typename Scalar>
MEMS_STICTION_INLINE void multiply(const Complex<Real>& a, const Complex<Scalar>& turn,
                                   Complex<Real>& product) {
  const Real re = a.re * turn.re - a.im * turn.im;
  product.im = a.re * turn.im + a.im * turn.re;
  product.re = re;
}

/// With the conjugate of the turn.
template <typename Real, typename Scalar>
MEMS_STICTION_INLINE void multiplyBack(const Complex<Real>& a, const Complex<Scalar>& turn,
                                       Complex<Real>& product) {
  const Real re = a.re * turn.re + a.im * turn.im;
  product.im = a.im * turn.re - a.re * turn.im;
  product.re = re;
}

template <typename Real>
MEMS_STICTION_INLINE void addPairs(Complex<Real>* line, std::size_t length) {
  for (std::size_t j = 0; j < length; j += 2) {
    const Complex<Real> a = line[j];
    const Complex<Real> b = line[j + 1];
    line[j] = {a.re + b.re, a.im + b.im};
    line[j + 1] = {a.re - b.re, a.im - b.im};
  }
}

template <typename Scalar>
template <typename Real>
MEMS_STICTION_INLINE void LineWaves<Scalar>::forward(Complex<Real>* line) const {
  std::size_t span = length_;
  for (const std::vector<Turns>& turns : turns_) {
    const std::size_t quarter = span / 4;
    for (std::size_t begin = 0; begin < length_; begin += span) {
      for (std::size_t j = 0; j < quarter; ++j) {
        Complex<Real>* const x = line + begin + j;
        const Complex<Real> a = x[0];
        const Complex<Real> b = x[quarter];
        const Complex<Real> c = x[2 * quarter];
        const Complex<Real> d = x[3 * quarter];
        const Complex<Real> even_sum{a.re + c.re, a.im + c.im};
        const Complex<Real> even_rest{a.re - c.re, a.im - c.im};
        const Complex<Real> odd_sum{b.re + d.re, b.im + d.im};
        const Complex<Real> odd_rest{b.im - d.im, d.re - b.re};  // -i (b - d)
        x[0] = {even_sum.re + odd_sum.re, even_sum.im + odd_sum.im};
        multiply({even_rest.re + odd_rest.re, even_rest.im + odd_rest.im}, turns[j].once,
                 x[quarter]);
        multiply({even_sum.re - odd_sum.re, even_sum.im - odd_sum.im}, turns[j].twice,
                 x[2 * quarter]);
        multiply({even_rest.re - odd_rest.re, even_rest.im - odd_rest.im}, turns[j].thrice,
                 x[3 * quarter]);
      }
    }
    span = quarter;
  }
  if (span == 2) addPairs(line, length_);
}

template <typename Scalar>
template <typename Real>
MEMS_STICTION_INLINE void LineWaves<Scalar>::backward(Complex<Real>* line) const {
  std::size_t quarter = 1;
  if (length_ >> (2 * turns_.size()) == 2) {
    addPairs(line, length_);
    quarter = 2;
  }
  for (std::size_t pass = turns_.size(); pass-- > 0;) {
    const std::vector<Turns>& turns = turns_[pass];
    const std::size_t span = 4 * quarter;
    for (std::size_t begin = 0; begin < length_; begin += span) {
      for (std::size_t j = 0; j < quarter; ++j) {
        Complex<Real>* const x = line + begin + j;
        const Complex<Real> a = x[0];
        Complex<Real> b;
        Complex<Real> c;
        Complex<Real> d;
        multiplyBack(x[quarter], turns[j].once, b);
        multiplyBack(x[2 * quarter], turns[j].twice, c);
        multiplyBack(x[3 * quarter], turns[j].thrice, d);
        const Complex<Real> even_sum{a.re + c.re, a.im + c.im};
        const Complex<Real> even_rest{a.re - c.re, a.im - c.im};
        const Complex<Real> odd_sum{b.re + d.re, b.im + d.im};
        const Complex<Real> odd_rest{d.im - b.im, b.re - d.re};  // i (b - d)
        x[0] = {even_sum.re + odd_sum.re, even_sum.im + odd_sum.im};
        x[quarter] = {even_rest.re + odd_rest.re, even_rest.im + odd_rest.im};
        x[2 * quarter] = {even_sum.re - odd_sum.re, even_sum.im - odd_sum.im};
        x[3 * quarter] = {even_rest.re - odd_rest.re, even_rest.im - odd_rest.im};
      }
    }
    quarter = span;
  }
}

extern template class LineWaves<float>;
extern template class LineWaves<double>;

}  // namespace mems_stiction
