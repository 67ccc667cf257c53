#pragma once

/// @file
/// One row's share of a step of conjugate gradients, in single precision with the same bits on
/// every processor: eight packets, then what is left of the row.

#include <cstddef>
#include <cstring>

#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace conjugate_rows {

/// What a row adds to the sums of a step.
struct Sums {
  double product = 0.0;
  double sum = 0.0;
  double largest = 0.0;

  Sums& operator+=(const Sums& other) {
    product += other.product;
    sum += other.sum;
    if (other.largest > largest) largest = other.largest;
    return *this;
  }
};

/// search = smoothed + ratio search, its elastic traction likewise, as K smoothed = residual - mean
/// - shift smoothed.
/// @return product: search times its whole traction, K + t'; sum: of that traction
Sums turn(std::size_t count, float ratio, float shift, float mean, const float* smoothed,
          const float* residual, const float* slope, float* search, float* search_traction);

/// smoothed = S (residual - mean), S = yielding/(yielding + positive t'): what a contact does not
/// hold by itself.
Sums weigh(std::size_t count, float yielding, float mean, const float* residual, const float* slope,
           float* smoothed);
/// smoothed = S smoothed + (residual - mean)/(rough + positive t').
/// @return product: smoothed times (residual - mean); sum: of smoothed
Sums combine(std::size_t count, float yielding, float rough, float mean, const float* residual,
             const float* slope, float* smoothed);
/// search = (smoothed - smoothed_mean) + ratio search.
Sums follow(std::size_t count, float ratio, float smoothed_mean, const float* smoothed,
            float* search);
/// @return as turn() does, of a search whose elastic traction is known
Sums respond(std::size_t count, const float* slope, const float* search,
             const float* search_traction);

/// step += length search; the residual loses length times the whole traction of the search.
/// @return largest: of |step|
Sums advance(std::size_t count, float length, const float* slope, const float* search,
             const float* search_traction, float* step, float* first_residual, float* residual);
/// The same from a step of zero; the residual before is kept as the first one.
Sums begin(std::size_t count, float length, const float* slope, const float* search,
           const float* search_traction, float* step, float* first_residual, float* residual);

/// The elastic traction of a step, in place of the first residual: what the residual lost, less
/// what t' took.
Sums finish(std::size_t count, const float* slope, const float* step, const float* residual,
            float* first_residual);

/// @return largest: of |values|
Sums largest(std::size_t count, const float* values);

}  // namespace conjugate_rows
}  // namespace mems_stiction
