#pragma once

/// What each benchmark case predicts.

#include <string>
#include <vector>

#include "bench/frames.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"

namespace mems_stiction {
namespace bench {

struct Case {
  Frame frame;
  int size;   ///< rows and columns
  int steps;  ///< of the approach, up to 30 % contact

  std::string name() const { return frameName(frame) + "/" + std::to_string(size) + "/" + std::to_string(steps); }
};

/// Approach at which the frame reaches 30 % contact [m].
double fullApproach(const HeightMap& frame);

/// Steps that end at fullApproach(), under a load that no contact can carry: every case goes through all of them.
Options optionsFor(const Case& setting, bool all_outputs);

/// How a scan is cleaned before its prediction.
struct Recipe {
  std::string name;
  PipelineOptions cleaning;
};

/// README's recipe for AFM scans, and its steps one by one.
std::vector<Recipe> cleaningRecipes();

}  // namespace bench
}  // namespace mems_stiction
