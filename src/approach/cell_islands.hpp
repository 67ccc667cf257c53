#pragma once

/// @file
/// The highest cells of an area as a frame that is no larger than it must be. They lie in islands;
/// each is moved as it is, with invalid places around it, to where there is room. So neighbours
/// stay neighbours, at sides and at corners, and no others become any; cells of equal relief in one
/// island stand in the same order.

#include <optional>
#include <vector>

#include "approach/area_cells.hpp"
#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// - @p cells row by row, at least one
/// - @p most_places of the frame, less than 2^31
/// @return in single precision where that holds the cells exactly; nothing if the islands have no
/// room
std::optional<HeightMap> frameOfIslands(const std::vector<AreaCell>& cells, double pitch_x,
                                        double pitch_y, std::int64_t most_places);

}  // namespace mems_stiction
