#pragma once

/// @file
/// Work on the rows of a frame by several threads, with the same bits for any number of them: each
/// row is worked on as a whole, and what rows add up to is summed in the order of the frame.

#include <vector>

#include <opencv2/core/utility.hpp>

namespace mems_stiction {

/// work(part) for part = 0 .. parts - 1, each part by one thread.
template <typename Work>
void forParts(int parts, const Work& work) {
  if (parts <= 1) {
    work(0);
    return;
  }
  cv::parallel_for_(
      cv::Range(0, parts),
      [&](const cv::Range& range) {
        for (int part = range.start; part < range.end; ++part) work(part);
      },
      parts);
}

/// work(i) for i = 0 .. count - 1, in as many contiguous pieces as there are threads.
template <typename Work>
void forEachRow(int count, int threads, const Work& work) {
  forParts(threads, [&](int part) {
    const int end = static_cast<int>(static_cast<long>(count) * (part + 1) / threads);
    for (int i = static_cast<int>(static_cast<long>(count) * part / threads); i < end; ++i) work(i);
  });
}

/// The sum of work(row) over the rows, in their order. Sums has operator+=.
template <typename Sums, typename Work>
Sums sumOverRows(std::vector<Sums>& row_sums, int rows, int threads, const Work& work) {
  row_sums.resize(static_cast<std::size_t>(rows));
  forEachRow(rows, threads, [&](int row) { row_sums[static_cast<std::size_t>(row)] = work(row); });
  Sums total;
  for (const Sums& sums : row_sums) total += sums;
  return total;
}

}  // namespace mems_stiction
