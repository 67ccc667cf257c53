#pragma once

/// @file
/// How the bodies under a relief, which are not thick, give way to its long waves. They yield to a pressure p_q by
///
///     u_q = C p_q,   C = 1/K - 2/(E q)          (S14)
///
/// K is the stiffness of both bodies against the wave (mechanics/wave_stiffness.hpp). C is what they yield more than thick ones: how
/// half-spaces yield is in what patches carry already. For waves much longer than the bodies are thick C is 1/K, for short
/// ones 0; where a substrate makes them stiffer than thick ones C counts as 0. The frame repeats itself or is mirrored
/// (relief_spectrum.hpp); the mean plane of a mirrored one is no wave, and stays as its guide holds it.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "mechanics/wave_stiffness.hpp"
#include "separation/extra_compliance.hpp"
#include "separation/relief_spectrum.hpp"

namespace mems_stiction {

/// Of one frame. Keeps its memory between frames.
class PlateBending {
 public:
  /// The field must outlive the object's use.
  void start(const GapField& field, const WaveStiffness& stiffness);

  /// A relief that bends by so much in each block [m]: that of the field, or as contacts have changed it.
  const GapField& bentBy(const GapField& field, const cv::Mat1d& blocks);
  /// The sum of an image's waves, each times sqrt(C).
  void root(const cv::Mat1d& image, cv::Mat1d& rooted) { relief_.filter(image, roots_, rooted); }
  const ReliefSpectrum& waves() const { return relief_; }
  /// What thick bodies would have to close of the relief, when bodies that bend close all of it: each wave keeps the share of K in
  /// (E/2) q. Valid until the next call.
  const GapField& closed();
  const ExtraCompliance& compliance() const { return compliance_; }
  /// Of what conforms when all is closed, per area [J/m^2].
  double energy() const { return energy_; }

 private:
  const GapField& lowerBy(const GapField& field, const cv::Mat1d& blocks, GapField& gap);

  const GapField* field_ = nullptr;
  ExtraCompliance compliance_;
  ReliefSpectrum relief_;
  cv::Mat1d roots_;  ///< sqrt(C), as ReliefSpectrum::filter() takes it
  GapField level_;
  GapField bent_;
  GapField closed_;
  cv::Mat1d bending_;
  double energy_ = 0.0;
};

}  // namespace mems_stiction
