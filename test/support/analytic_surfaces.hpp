#pragma once

/// Surfaces whose truth is a formula. Heights are CV_64FC1, metres. Lengths x and y of the centred
/// ones count from the middle of the frame, ((cols - 1)/2, (rows - 1)/2): a pixel when the side is
/// odd, between two pixels when it is even.

#include <vector>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {
namespace analytic {

/// z = height everywhere.
HeightMap flat(int rows, int cols, double pitch_x, double pitch_y, double height = 0.0);

/// z = -((x - centre_x)^2 + (y - centre_y)^2)/(2 radius); the apex is at z = 0.
HeightMap paraboloid(int rows, int cols, double pitch_x, double pitch_y, double radius,
                     double centre_x = 0.0, double centre_y = 0.0);

/// The upper half of a sphere whose apex is at z = 0; the frame must lie within the radius.
HeightMap sphere(int rows, int cols, double pitch_x, double pitch_y, double radius,
                 double centre_x = 0.0, double centre_y = 0.0);

/// The frame in count_x x count_y equal tiles, each with a paraboloid in its middle, all apexes at
/// z = 0. Tile (i, j) has the radius radii[(j count_x + i) % radii.size()].
HeightMap sphereArray(int rows, int cols, double pitch_x, double pitch_y,
                      const std::vector<double>& radii, int count_x, int count_y);

/// z = offset + slope_x x + slope_y y.
HeightMap tiltedPlane(int rows, int cols, double pitch_x, double pitch_y, double slope_x,
                      double slope_y, double offset = 0.0);

/// z = amplitude sin(2 pi (periods_x col/cols + periods_y row/rows)); whole numbers of periods fill
/// the frame.
HeightMap sine(int rows, int cols, double pitch_x, double pitch_y, double amplitude, int periods_x,
               int periods_y = 0);

/// z = height on width x width pixels in the middle of the frame, 0 elsewhere.
HeightMap flatWithBump(int rows, int cols, double pitch_x, double pitch_y, double height,
                       int width = 1);

/// Heights added pixel by pixel: a tilted sphere is paraboloid + plane.
HeightMap sum(const HeightMap& first, const HeightMap& second);

/// The same surface narrowed to CV_32FC1.
HeightMap asSingle(const HeightMap& surface);

/// The same surface with a NaN at one pixel; the argument is left alone.
HeightMap withInvalidPixel(const HeightMap& surface, int row, int col);

}  // namespace analytic
}  // namespace mems_stiction
