#pragma once

/// What each benchmark case predicts.

#include <string>
#include <vector>

#include "bench/frames.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/preprocess/pipeline.hpp"

namespace mems_stiction {
namespace bench {

/// What presses the surfaces together.
enum class Pressing {
  kAdhesion,  ///< nothing but adhesion: surfaces of silicon as they come to rest, with few contacts
  kOverload,  ///< a load that no contact carries, and a voltage: contact grows to its limit, 30 %
};

struct Case {
  Frame frame;
  int size;   ///< rows and columns
  int steps;  ///< of labelling, and of the paper's approach, up to 30 % contact

  std::string name() const {
    return frameName(frame) + "/" + std::to_string(size) + "/" + std::to_string(steps);
  }
};

/// Approach at which the frame reaches 30 % contact [m].
double fullApproach(const HeightMap& frame);

/// The paper's steps end at fullApproach().
/// - @p formulation which solver
Options optionsFor(const Case& setting, const std::string& formulation, Pressing pressing,
                   bool all_outputs);

/// The default formulation under a pressure on the whole frame [Pa].
Options optionsUnder(const Case& setting, double pressure);

/// How a scan is cleaned before its prediction.
struct Recipe {
  std::string name;
  PipelineOptions cleaning;
};

/// README's recipe for AFM scans, and its steps one by one.
std::vector<Recipe> cleaningRecipes();

}  // namespace bench
}  // namespace mems_stiction
