#pragma once

/// @file
/// Two surfaces whose bodies bend under what presses and pulls at them: how they come to rest, and how they part.
///
/// The upper body comes down until the force on it is balanced, and is drawn off again; at each height the bodies settle
/// (pressed_plate.hpp). They stay in the equilibrium in which they are: contacts that bending brings near close by jumps, and open by
/// jumps on the way out, with what has been stored in the bodies. Force and work are those of this way.

#include <vector>

#include "separation/conforming_contact.hpp"
#include "separation/contact_curve.hpp"
#include "separation/plate_bending.hpp"
#include "separation/pressed_plate.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class BentContact {
 public:
  /// Finds rest and way out. Field and settings must outlive the object's use.
  /// @return the gap at rest, valid until the next call
  const GapField& solve(const GapField& field, const ContactSettings& settings);
  /// Whether bodies bend so little that they are as good as thick.
  bool isStiff() const { return is_stiff_; }
  double energyAtRest() const { return energy_at_rest_; }  ///< of bending, per area [J/m^2]

  /// The way out by contacts.
  struct Parting {
    double force = 0.0;  ///< the largest [N]
    double work = 0.0;   ///< per area [J/m^2]
    std::vector<SeparationCurvePoint>
        curve;  ///< by descending displacement, counted from the first touch of stiff bodies
  };
  /// Found when it is asked for: surfaces that conform part otherwise.
  const Parting& parting();

  /// The gap where the force is largest, valid until the next call.
  const GapField& strongest() { return bending_.bentBy(*field_, strongest_); }
  /// What is left to thick bodies of a relief that closes, and how they have bent to it.
  struct Closed {
    const GapField* gap;
    BentBodies bodies;
  };
  Closed closed() {
    const GapField& gap = bending_.closed();
    return {&gap, {bending_.energy(), field_->rmsGap(), &bending_.compliance()}};
  }

 private:
  /// Whether all that presses and pulls at straight bodies, at rest and where they hold most, hardly bends them.
  bool staysStraight();
  /// From apart to rest.
  void comeToRest();
  /// The state on the way in. One that pushes is one at which the bodies have settled.
  SeparationState approached(double height);
  /// Takes the height of rest from those above and below it.
  void settleBetween(double above, double below);
  /// The relief as contacts at rest have changed it by flow, if they have.
  void flow(const GapField& at_rest);
  void part();

  const GapField* field_ = nullptr;
  const ContactSettings* settings_ = nullptr;
  PlateBending bending_;
  PressedPlate plate_;
  ContactCurve curve_;
  SeparationCurve way_in_;
  bool is_stiff_ = true;
  double height_at_rest_ = 0.0;  ///< over the mean of the relief [m]
  double energy_at_rest_ = 0.0;
  cv::Mat1d at_rest_;  ///< u by block [m]
  cv::Mat1d strongest_;
  cv::Mat1d flowed_;  ///< by cell [m]
  GapField changed_;
  Parting parting_;
  bool has_parted_ = false;
};

}  // namespace mems_stiction
