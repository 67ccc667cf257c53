#pragma once

/// @file
/// Two surfaces whose bodies bend under the long waves of their relief: how far at rest, and how they part.
///
/// The relief lies on a bed of stiffness k (plate_bending.hpp), and k is what costs least, contact and bending together:
///
///     E(Z) = min over k of [ B(k) A - integral of F_k from Z to apart dZ ],   F(Z) = F_k(Z) at that k            (S16)
///
/// Z is the height of the upper body over the mean of the relief, F_k the curve of the relief on a bed of k, B what bending
/// stores per area. Where E is least, k is the contact's own stiffness, -(dF/dZ)/A. At rest all k are compared, each at its own
/// rest under the load: the answer does not depend on where a search begins. On the way out the bodies stay in the valley of E
/// in which they are, and spring back where it ends: long waves come back one after another, and what they have stored with
/// them.

#include <vector>

#include "separation/conforming_contact.hpp"
#include "separation/contact_curve.hpp"
#include "separation/plate_bending.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class BentContact {
 public:
  /// Finds rest and way out. Field and settings must outlive the object's use.
  /// @return the gap at rest, valid until the next call
  const GapField& solve(const GapField& field, const ContactSettings& settings);
  /// Whether bodies bend so little that they are as good as thick.
  bool isStiff() const { return at_rest_ == 0; }
  double bedStiffness() const { return beds_[at_rest_].stiffness; }  ///< at rest [Pa/m]
  double energyAtRest() const { return beds_[at_rest_].energy; }     ///< of bending, per area [J/m^2]

  /// The way out by contacts.
  struct Parting {
    double bed_stiffness = 0.0;  ///< where the force is largest [Pa/m]
    double force = 0.0;          ///< the largest [N]
    double work = 0.0;           ///< per area [J/m^2]
    std::vector<SeparationCurvePoint>
        curve;  ///< by descending displacement, counted from the first touch of stiff bodies
  };
  const Parting& parting() const { return parting_; }

  /// The gap of another k, valid until the next call.
  const GapField& bent(double bed_stiffness) { return bed_stiffness > 0.0 ? bending_.bent(bed_stiffness) : *field_; }
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
  struct Bed {
    double stiffness = 0.0;  ///< k [Pa/m]
    double energy = 0.0;     ///< B [J/m^2]
    double work_apart = 0.0;
    std::vector<double> heights;  ///< Z [m], ascending from rest
    std::vector<double> forces;   ///< on the way out [N]
    std::vector<double> works;    ///< from there to apart [J]
    /// Of the way out at a height, 0 beyond its end.
    double forceAt(double height) const;
    /// E at a height [J], infinite nearer than rest.
    double energyAt(double height, double area) const;
  };
  void addBed(double stiffness);
  void takeRest();
  void part();

  const GapField* field_ = nullptr;
  const ContactSettings* settings_ = nullptr;
  PlateBending bending_;
  ContactCurve curve_;
  double area_ = 0.0;
  std::vector<Bed> beds_;
  std::size_t at_rest_ = 0;
  Parting parting_;
};

}  // namespace mems_stiction
