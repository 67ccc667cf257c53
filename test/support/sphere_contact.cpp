#include "support/sphere_contact.hpp"
#include "support/paper_options.hpp"

#include "support/analytic_surfaces.hpp"

namespace mems_stiction {

HeightMap sphereOn(const SphereGrid& grid, double radius, double contact_radius, double pixels) {
  const double pitch_x = contact_radius / pixels;
  const double pitch_y = pitch_x * grid.pitch_ratio;
  const int rows =
      2 * static_cast<int>(0.5 * grid.rows_per_radius * contact_radius / pitch_y) + grid.odd;
  const int cols =
      2 * static_cast<int>(0.5 * grid.cols_per_radius * contact_radius / pitch_x) + grid.odd;
  return analytic::sphere(rows, cols, pitch_x, pitch_y, radius, grid.shift_x * pitch_x,
                          grid.shift_y * pitch_y);
}

Options contactOnly(double mechanical_load, double work_of_adhesion) {
  Options options = paperOptions();  // both bodies as in material.hpp
  options.interface.work_of_adhesion = work_of_adhesion;
  options.interface.hamaker_constant = 0.0;
  options.load.mechanical_load = mechanical_load;
  return options;
}

}  // namespace mems_stiction
