#include "surface/line_waves.hpp"

#include <cmath>

#include "numeric/constants.hpp"

namespace mems_stiction {

template <typename Scalar>
LineWaves<Scalar>::LineWaves(std::size_t length) : length_(length), order_{0} {
  std::size_t span = length;
  for (; span >= 4; span /= 4) {
    std::vector<Turns> turns(span / 4);
    for (std::size_t j = 0; j < turns.size(); ++j) {
      const auto turn = [&](double times) {
        const double angle =
            -2.0 * kPi * times * static_cast<double>(j) / static_cast<double>(span);
        return Complex<Scalar>{static_cast<Scalar>(std::cos(angle)),
                               static_cast<Scalar>(std::sin(angle))};
      };
      turns[j] = {turn(1.0), turn(2.0), turn(3.0)};
    }
    turns_.push_back(std::move(turns));
  }
  // A pass puts the waves r, r + 4, r + 8 ... into the quarter r; what is known of shorter lines
  // tells their order.
  const auto interleave = [this](std::size_t parts) {
    std::vector<std::size_t> longer;
    for (std::size_t part = 0; part < parts; ++part) {
      for (const std::size_t wave : order_) longer.push_back(parts * wave + part);
    }
    order_ = std::move(longer);
  };
  if (span == 2) interleave(2);
  while (order_.size() < length) interleave(4);
}

template class LineWaves<float>;
template class LineWaves<double>;

}  // namespace mems_stiction
