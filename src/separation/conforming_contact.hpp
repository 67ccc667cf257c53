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

#include "approach/gap_field.hpp"
#include "separation/contact_traction.hpp"
#include "separation/flattening.hpp"
#include "separation/open_valleys.hpp"
#include "separation/relief_waves.hpp"
#include "separation/spring_contact.hpp"
#include "separation/way_out.hpp"

namespace mems_stiction {

/// Bonded surfaces of one frame. Keeps its memory between frames.
class ConformingContact {
 public:
  /// What the next calls are about. Everything must outlive them; nothing is computed yet.
  /// - @p flattening_energy U/A [J/m^2], >= 0
  /// - @p contact_modulus E [Pa], > 0
  void start(const GapField& field, const ContactTraction& law, double contact_modulus, double flattening_energy);

  /// What drawing the bonded surfaces apart takes [J/m^2]; 0 if they do not stay together.
  double work();
  /// U/A by the waves of the relief [J/m^2]. Each has its direction: lines along rows and columns, by which start() is told, see 0.79 of
  /// grooves along one of them, 1.11 of grooves between, and no waves that are long against the frame.
  double flatteningByWaves();
  /// Puts the work of a way out that this object made in place of the springs': with flatteningByWaves(), and with what jumps lose;
  /// that of contacts where it is more.
  void takeWork(const WayOut& by_contacts, WayOut& way_out);
  /// Whether valleys stay open under a pressure [Pa], >= 0.
  bool hasOpenValleys(double pressure);
  /// The ways out from rest under a pressure [Pa], >= 0.
  WayOut fromOpenValleys(double pressure);
  /// - @p least_force what the surfaces hold in any case [N]
  WayOut asAWhole(double pressure, double least_force);

 private:
  /// The springs up to a mean traction [Pa].
  WayOut upTo(double strength, double pressure);
  /// Strength of the short waves at the place where the long ones pull most [Pa].
  double strengthOfShortWaves();
  /// The short waves over the whole frame: rms height [m]; and those near a place, as depths below the mean plane [m].
  double takeShortWaves(cv::Point2d place, double radius);
  /// Of springs that store this energy when all is flat [J/m^2].
  std::vector<SpringState> springsOf(double flattening_energy);
  const std::vector<SpringState>& branch();
  ReliefSpectrum& relief();
  double area() const { return field_->validCount() * field_->cellArea(); }

  const GapField* field_ = nullptr;
  const ContactTraction* law_ = nullptr;
  BondedBodies bodies_;
  std::vector<SpringState> branch_;  ///< empty until it is asked for
  ReliefSpectrum relief_;
  bool has_relief_ = false;
  ReliefWaves waves_;
  ReliefSpectrum fine_relief_;  ///< in the smallest blocks
  ReliefWaves fine_waves_;
  FlatteningEnergy flattening_;  ///< of the short waves
  std::vector<double> line_;
  std::vector<double> depths_at_place_;  ///< of the short waves [m]
};

}  // namespace mems_stiction
