#pragma once

/// A prediction as text for scripts: field names of StictionPrediction, SI units, words for the enumerations.

#include <string>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// One YAML document, from its "---" to the end of its last line. Numbers that are not finite are .nan, .inf, -.inf.
/// The energy curve is a list of maps, left out when the prediction has none.
/// @param file the scan's name, as the user wrote it
/// @param channel which channel of the file; left out when empty
std::string yamlRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const std::string& channel = {});

/// The same as one JSON object on one line, without a line end. Numbers that are not finite are null: JSON has no
/// others.
std::string jsonRecord(const std::string& file, const HeightMap& scan, const Prediction& prediction,
                       const std::string& channel = {});

}  // namespace mems_stiction
