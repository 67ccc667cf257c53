#pragma once

/// @file
/// Do scans of the surfaces that a law makes hold as strongly as the scans that it was found from?
///
/// Domes of grains keep their curvature up to the top, the summits of a translated Gaussian field
/// do not: a law may have the spectrum and the heights of the scans, and other summits. Scans like
/// the given ones, made by the law, tell it by their forces (a posterior predictive check: Gelman
/// et al., Bayesian Data Analysis). What of the difference is beyond chance is a misfit of the law,
/// and its surfaces of the device's size have a part of it.
///
///     LawCheck check(model, scans, counter_surface);
///     check.add(made_scans, made_counter_surface);  // of each realisation
///     const LawMisfit misfit = check.force();

#include <cstddef>
#include <vector>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/prediction/options.hpp"

namespace mems_stiction {

/// The scan under the first part of the counter-surface that has its grid; under a plane if none
/// has.
SurfacePair underCounterSurface(const HeightMap& scan,
                                const std::vector<HeightMap>& counter_surface);

/// Of a figure; of nothing that of the smallest number.
double logOf(double figure);

/// Of the logarithm of a figure: scans against scans of the law.
struct LawMisfit {
  double difference = 0.0;  ///< mean of the logarithms [-]
  double deviation = 0.0;   ///< standard error of it [-]

  /// Share of the difference that is not chance, in [0, 1).
  double share() const;
  /// What is to be added to the logarithm of the device's figure,
  double shift() const;
  /// and how sure that is: standard deviation.
  double shiftDeviation() const;
  /// Whether surfaces of the law are none as the scans: what the misfit becomes on a larger area is
  /// not known, and all of it widens the interval.
  bool fails() const;
};

/// Collects the forces of scans that a law has made.
class LawCheck {
 public:
  /// - @p model its load is that of a frame as large as the first of the scans, the finest
  /// - @p scans only those with the finest pixels are looked at
  LawCheck(const Options& model, const std::vector<HeightMap>& scans,
           const std::vector<HeightMap>& counter_surface);

  /// - @p made like the scans, in their order
  void add(const std::vector<HeightMap>& made, const std::vector<HeightMap>& made_counter_surface);

  /// How many scans are looked at.
  std::size_t scanCount() const { return checked_.size(); }
  /// By how much the scan that holds most holds more than those that were made like it, of ln F and
  /// ln w; >= 0 [-].
  double largestForceExcess() const { return largestExcess(&Logs::force); }
  double largestWorkExcess() const { return largestExcess(&Logs::work); }
  LawMisfit force() const { return misfit(&Logs::force); }
  LawMisfit work() const { return misfit(&Logs::work); }

 private:
  /// Logarithms of figures.
  struct Logs {
    std::vector<double> force;
    std::vector<double> work;
  };
  /// One of the scans that are looked at.
  struct Checked {
    std::size_t place = 0;  ///< among all of them
    cv::Mat missing;        ///< not 0 at pixels that were not measured; empty = none
    Logs own;               ///< one number each
    Logs made;              ///< of scans that were made like it
  };

  void predict(const HeightMap& scan, const std::vector<HeightMap>& counter_surface, Logs& logs);
  LawMisfit misfit(std::vector<double> Logs::*figure) const;
  double largestExcess(std::vector<double> Logs::*figure) const;

  Options options_;
  double loaded_area_;
  AdhesionModel adhesion_;
  std::vector<Checked> checked_;
  std::vector<cv::Mat> missing_above_;  ///< of the counter-surface's scans
  std::size_t rounds_ = 0;
};

}  // namespace mems_stiction
