#pragma once

/// @file
/// Surfaces that lie against each other everywhere: what it takes to draw them apart.
///
/// Where flattening costs less than adhesion gives, contacts grow together until nothing is left between them, and a sum
/// over patches says little. Each cell then hangs on a spring (spring_contact.hpp), which gives the curve and the work.
/// The interface breaks
///
/// - as a whole, at the largest traction that the springs of all waves reach, or before that
/// - from its weakest place: where the long waves (relief_waves.hpp) already pull with p_max, the short ones of that
///   place have what is left of their own strength, so that the mean traction is (strength of the short waves) - p_max.
///
/// For one long wave this is the strength of the law less Westergaard's pressure. Where valleys stay open
/// (open_valleys.hpp), neither holds: the surfaces part from there. Derivation and figures: doc/separation_curve.md.

#include <vector>

#include "mems_stiction/approach/gap_field.hpp"
#include "mems_stiction/separation/contact_traction.hpp"
#include "mems_stiction/separation/flattening.hpp"
#include "mems_stiction/separation/open_valleys.hpp"
#include "mems_stiction/separation/relief_waves.hpp"
#include "mems_stiction/separation/spring_contact.hpp"

namespace mems_stiction {

/// One height of the conforming branch, per area.
struct ConformingState {
  double approach = 0.0;          ///< D, z0 less the height of the upper body over first touch [m]
  double traction = 0.0;          ///< [Pa], attraction positive
  double contact_fraction = 0.0;  ///< cells that repel each other [-]
};

/// The bodies as they conform.
struct ConformingBodies {
  double contact_modulus = 0.0;    ///< E [Pa], > 0
  double flattening_energy = 0.0;  ///< U/A [J/m^2], >= 0
};

/// The way out.
struct ConformingWayOut {
  std::vector<ConformingState> states;  ///< by descending approach, from rest to where the interface breaks
  double strength = 0.0;                ///< largest traction [Pa]
  bool has_open_valleys = false;
};

/// Bonded surfaces of one frame. Keeps its memory between frames.
class ConformingContact {
 public:
  /// - @p law that attracts
  void start(const GapField& field, const ContactTraction& law, const ConformingBodies& bodies);

  /// Whether valleys stay open under a pressure [Pa], >= 0.
  bool hasOpenValleys(double pressure);
  /// What they hold if so.
  OpenValleyStrength openStrength() const { return strengthWithOpenValleys(bondedBodies()); }
  /// What they hold under a pressure [Pa] if all valleys close [Pa]; negative if the weakest place tears by itself.
  double closedStrength(double pressure);
  /// What drawing the bonded surfaces apart takes [J/m^2]; 0 if they do not stay together.
  double work() const;
  /// The way out from rest under a pressure [Pa], >= 0.
  /// - @p least_strength what the contacts of surfaces without open valleys hold in any case [Pa]
  ConformingWayOut partFrom(double pressure, double least_strength);

 private:
  /// Mean traction at which the weakest place tears [Pa]; negative if flattening alone does it.
  double strengthAtWeakestPlace();
  /// The short waves over the whole frame: rms height [m]; and those near a place, as depths below the mean plane [m].
  double takeShortWaves(cv::Point2d place, double radius);
  BondedBodies bondedBodies() const;
  ReliefSpectrum& relief();

  const GapField* field_ = nullptr;
  const ContactTraction* law_ = nullptr;
  ConformingBodies bodies_;
  std::vector<SpringState> branch_;
  ReliefSpectrum relief_;
  bool has_relief_ = false;
  ReliefWaves waves_;
  FlatteningEnergy flattening_;  ///< of the short waves
  std::vector<double> line_;
  std::vector<double> depths_at_place_;  ///< of the short waves [m]
};

}  // namespace mems_stiction
