#pragma once

/// @file
/// All that a program outside needs, in one header: read a scan, predict, judge the device, solve
/// the half-space.
///
///     const Configuration configuration = loadConfiguration("stiction.yaml");
///     ScanPredictor predictor(configuration);
///     const PreparedScan prepared =
///         predictor.preparer().prepare(readScanFile("scan.tiff", configuration.scan));
///     const Prediction prediction = predictor.predict(prepared);
///     const Verdict verdict =
///         verdictOf(prediction, configuration.device, configuration.uncertainty,
///                   predictor.options(), prepared.surfaces.lower.cellArea());
///
/// Lengths are metres, forces newtons: SI throughout. Bad input throws an Error
/// (errors/errors.hpp).

#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/evaluation/half_space_scan.hpp"
#include "mems_stiction/evaluation/scan_predictor.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "mems_stiction/paper/paper_options.hpp"
