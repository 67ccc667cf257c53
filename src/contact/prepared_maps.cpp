#include "contact/prepared_maps.hpp"

#include <algorithm>

#include "height_map/shared_pixels.hpp"

namespace mems_stiction {

void prepareMaps(const ContactProblem& problem, ContactSolution& solution) {
  const int rows = problem.gap.rows();
  const int cols = problem.gap.cols();
  if (problem.settings.output.contact_map) {
    makeWritable(solution.contact_map, rows, cols, CV_8UC1);
    std::fill_n(solution.contact_map.ptr<std::uint8_t>(), solution.contact_map.total(),
                std::uint8_t{0});
  } else {
    solution.contact_map.release();
  }
  if (!problem.settings.output.deformed_surfaces) {
    solution.displaced_lower.release();
    solution.displaced_upper.release();
    return;
  }
  makeWritable(solution.displaced_lower, rows, cols, CV_64FC1);
  makeWritable(solution.displaced_upper, rows, cols, CV_64FC1);
  problem.surfaces.lower.heights().convertTo(solution.displaced_lower, CV_64F);
  if (problem.surfaces.upperIsPlane()) {
    std::fill_n(solution.displaced_upper.ptr<double>(), solution.displaced_upper.total(), 0.0);
  } else {
    problem.surfaces.upper.heights().convertTo(solution.displaced_upper, CV_64F);
  }
}

}  // namespace mems_stiction
