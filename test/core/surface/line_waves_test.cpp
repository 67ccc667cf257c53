#include "surface/line_waves.hpp"

#include <cmath>
#include <complex>

#include <gtest/gtest.h>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

std::vector<Complex<double>> someLine(std::size_t length) {
  std::vector<Complex<double>> line(length);
  for (std::size_t i = 0; i < length; ++i)
    line[i] = {std::sin(1.0 + 7.0 * static_cast<double>(i * i)), 0.1 * static_cast<double>(i % 5)};
  return line;
}

TEST(LineWaves, areTheSumsOfTheirDefinitionInTheOrderThatTheyState) {
  for (const std::size_t length : {2u, 4u, 8u, 16u, 32u, 64u, 128u}) {
    const std::vector<Complex<double>> line = someLine(length);
    std::vector<Complex<double>> waves = line;
    const LineWaves<double> transform(length);
    transform.forward(waves.data());
    for (std::size_t place = 0; place < length; ++place) {
      std::complex<double> sum = 0.0;
      for (std::size_t j = 0; j < length; ++j) {
        const double turns = static_cast<double>(j * transform.order()[place] % length) /
                             static_cast<double>(length);
        sum += std::complex<double>(line[j].re, line[j].im) * std::polar(1.0, -2.0 * kPi * turns);
      }
      EXPECT_NEAR(waves[place].re, sum.real(), 1e-12 * static_cast<double>(length))
          << length << ", " << place;
      EXPECT_NEAR(waves[place].im, sum.imag(), 1e-12 * static_cast<double>(length))
          << length << ", " << place;
    }
  }
}

TEST(LineWaves, backwardUndoesForward) {
  for (const std::size_t length : {8u, 512u, 1024u}) {
    const std::vector<Complex<double>> line = someLine(length);
    std::vector<Complex<double>> back = line;
    const LineWaves<double> transform(length);
    transform.forward(back.data());
    transform.backward(back.data());
    for (std::size_t i = 0; i < length; ++i) {
      EXPECT_NEAR(back[i].re / static_cast<double>(length), line[i].re, 1e-13);
      EXPECT_NEAR(back[i].im / static_cast<double>(length), line[i].im, 1e-13);
    }
  }
}

}  // namespace
}  // namespace mems_stiction
