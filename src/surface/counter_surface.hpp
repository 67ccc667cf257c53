#pragma once

/// @file
/// What is the scan brought into contact with?
///
/// | type        | heights                                           | beyond its edge            |
/// |-------------|---------------------------------------------------|----------------------------|
/// | flat        | a plane                                           | goes on                    |
/// | topic       | a measured height map that comes beside the scans | nothing: cells are invalid |
/// | file        | a scan file that scan_file.hpp reads, read once   | nothing: cells are invalid |
/// | gaussian    | random heights, lengths, skewness and kurtosis    | wraps around               |
/// | self_affine | random heights, alike on many scales              | wraps around               |
///
/// Generated surfaces have the scan's size and pitch, and depend on it and the seed alone: the same
/// scan size gives the same surface. With a correlation they fit the scan's heights, too
/// (correlated_surface.hpp). They are described as a probe would see them, asperities up,
/// and turned over for mounting. Where each lies over the scan is said by the pose (alignment.hpp);
/// a plane takes only its tilts.

#include <string>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/surface/counter_surface_options.hpp"

namespace mems_stiction {

/// A height map that faces the other way: z negated, columns mirrored. Twice gives back the
/// surface.
HeightMap turnedOver(const HeightMap& surface);

/// "must be stated: up = ..., down = ...", where a measured counter-surface comes without its
/// facing.
std::string facingComplaint();

/// The counter-surface in the scan's frame.
/// @throw OptionsError if `facing` is unstated.
HeightMap mountedCounterSurface(const HeightMap& measured, CounterSurfaceFacing facing);

/// A generated counter-surface as it is mounted, on the scan's grid, before its pose: drawn by
/// itself, by the grid alone.
/// @throw SurfaceError if the settings cannot be drawn on the scan's grid; the message names them.
HeightMap drawnCounterSurface(const HeightMap& scan, const CounterSurfaceOptions& options);
/// The same with what it shares with the scan; without a correlation as drawn.
HeightMap fittedCounterSurface(const HeightMap& scan, const HeightMap& drawn,
                               const CounterSurfaceOptions& options);
/// Both.
HeightMap generatedCounterSurface(const HeightMap& scan, const CounterSurfaceOptions& options);

/// True if the pose leaves every surface where it is.
bool isIdentity(const SurfacePose& pose);

}  // namespace mems_stiction
