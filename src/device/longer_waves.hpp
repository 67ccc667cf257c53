#pragma once

/// @file
/// Waves longer than a contact.
///
/// A contact by itself settles on its summits, and these waves do little but tilt it. Of several
/// contacts under one counter-surface, the waves make some stand higher than others: without them
/// all would be level with each other.
///
/// A few waves of random direction and phase in each narrow band of wave numbers stand for all of
/// it; heights at any place are Gaussian, with the variance of the spectrum (random-phase method;
/// Shinozuka and Deodatis, Appl. Mech. Rev. 49 (1996) 29).
///
///     LongerWaves waves(law.heights, from, to, pass);
///     waves.draw(engine);
///     waves.addTo(tile, first_x, first_y, pitch_x, pitch_y);

#include <functional>
#include <random>
#include <vector>

#include <opencv2/core.hpp>

#include "roughness/merged_spectrum.hpp"

namespace mems_stiction {

/// Of one surface, at one contact after the other.
class LongerWaves {
 public:
  /// - @p from, @p to wave numbers [rad/m]; no wave if from >= to
  /// - @p pass share of a wave's power, by wave number [-]
  LongerWaves(const MergedSpectrum& spectrum, double from, double to,
              const std::function<double(double)>& pass);

  /// Goes to another contact, anywhere on the surface; without a first call all is flat.
  void draw(std::mt19937_64& engine);
  /// - @p tile CV_32FC1 [m]
  /// - @p first_x, @p first_y of its first pixel [m]
  void addTo(cv::Mat& tile, double first_x, double first_y, double pitch_x, double pitch_y);

 private:
  /// even cos(q x) + odd sin(q x)
  struct Wave {
    double q_x = 0.0;  ///< [rad/m]
    double q_y = 0.0;
    double even = 0.0;  ///< [m]
    double odd = 0.0;
  };
  struct Band {
    double wave_number;  ///< [rad/m]
    double deviation;    ///< of the heights of each of its waves [m]
  };

  SpectrumStretch stretch_;
  std::vector<Band> bands_;
  std::vector<Wave> waves_;
  std::vector<float> cosines_;  ///< of a wave along a row
  std::vector<float> sines_;
};

}  // namespace mems_stiction
