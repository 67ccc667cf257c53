#pragma once

/// @file
/// Views of a prediction for rviz: enlarged, thinned out, heights exaggerated. For looking at, not
/// for measuring. Their frame is options.frame: the middle of the scan is the origin, x points
/// along its columns to the right, y against its rows, so that from above it looks as the scan's
/// picture does; z is up.

#include <sensor_msgs/Image.h>
#include <sensor_msgs/PointCloud2.h>
#include <std_msgs/Header.h>
#include <visualization_msgs/MarkerArray.h>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/prediction.hpp"
#include "ros/parameters.hpp"

namespace mems_stiction {

/// The scanned surface after contact about its mean height. Fields: x, y, z [m on the screen],
/// height [m, about the mean, not enlarged] and rgb by deformation regime. Invalid pixels are left
/// out.
/// - @p prediction must have deformed_lower and contact_map.
sensor_msgs::PointCloud2 surfacePoints(const Prediction& prediction, const HeightMap& scan,
                                       const std_msgs::Header& header,
                                       const DisplayOptions& options);

/// One disc per contact with the radius of its cap, coloured by deformation regime, above the same
/// surface. The first marker removes those of the scan before; the second is a line of text with
/// size and exaggeration.
/// - @p prediction must have deformed_lower and asperities.
visualization_msgs::MarkerArray asperityMarkers(const Prediction& prediction, const HeightMap& scan,
                                                const std_msgs::Header& header,
                                                const DisplayOptions& options);

/// The surface as a mono8 picture, low dark and high bright: 1 at the height that 1 % of the pixels
/// lie below, 255 at that of 99 %; 0 where invalid. Its pixels are squares, also where the pitches
/// of the scan differ: a round particle is round. Rows and columns are thinned out to keep
/// options.max_preview_size. With options.preview_range dark and bright are half of it below and
/// above the mean; with options.preview_bar a bar to the right says which grey is which height.
sensor_msgs::Image previewImage(const HeightMap& surface, const std_msgs::Header& header,
                                const DisplayOptions& options);

}  // namespace mems_stiction
