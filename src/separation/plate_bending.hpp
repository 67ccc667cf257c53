#pragma once

/// @file
/// How a relief looks when the bodies, which are not thick, give way to its long waves.
///
/// A wave h_q that is pressed by a bed of stiffness k per area keeps a share s of its height, the rest conforms:
///
///     s = 1/(1 + k C),   C = 1/K - 2/(E q)          (S15)
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
#include "separation/summit_bending.hpp"

namespace mems_stiction {

/// Of one frame. Keeps its memory between frames.
class PlateBending {
 public:
  /// The field must outlive the object's use.
  void start(const GapField& field, const WaveStiffness& stiffness);

  /// The relief on a bed of stiffness k [Pa/m], >= 0; valid until the next call.
  const GapField& bent(double bed_stiffness);
  /// The relief that bends by so much in each block [m].
  const GapField& bentBy(const cv::Mat1d& blocks);
  /// The bending of the last bent(), by block [m].
  const cv::Mat1d& blocks() const { return blocks_; }
  /// Onto summits of the relief.
  SummitBending onSummits() { return {*levelled_, relief_, compliance_, thickness_}; }

  /// What thick bodies would have to close of the relief, when bodies that bend close all of it: each wave keeps the share of K in
  /// (E/2) q.
  const GapField& closed();
  const ExtraCompliance& compliance() const { return compliance_; }
  /// Of the last bent() or closed(): rms height of what conforms [m], and the energy in it per area [J/m^2].
  double rmsBending() const { return rms_bending_; }
  double energy() const { return energy_; }

 private:
  /// - @p bed k by wave number [Pa/m]
  template <typename Bed>
  const GapField& lowered(const Bed& bed, GapField& gap);
  const GapField& lowerBy(const cv::Mat1d& blocks, GapField& gap);

  const GapField* field_ = nullptr;
  const GapField* levelled_ = nullptr;
  double thickness_ = 0.0;  ///< of the thinner body [m]
  ExtraCompliance compliance_;
  ReliefSpectrum relief_;
  GapField level_;
  GapField bent_;
  GapField closed_;
  cv::Mat1d bending_;
  cv::Mat1d blocks_;
  double rms_bending_ = 0.0;
  double energy_ = 0.0;
};

}  // namespace mems_stiction
