#pragma once

/// @file
/// Two surfaces whose bodies bend under the long waves of their relief: how far at rest, and how they part.
///
/// The relief lies on a bed of stiffness k (plate_bending.hpp), and k is what costs least, contact and bending together:
///
///     E(Z) = min over k of [ B(k) A - integral of F_k from Z to apart dZ ],   F(Z) = F_k(Z) at that k            (S15)
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
  double energyAtRest() const { return beds_[at_rest_].energy; }  ///< of bending, per area [J/m^2]

  /// The way out by contacts.
  struct Parting {
    std::size_t strongest = 0;  ///< bending where the force is largest
    double force = 0.0;         ///< the largest [N]
    double work = 0.0;          ///< per area [J/m^2]
    std::vector<SeparationCurvePoint>
        curve;  ///< by descending displacement, counted from the first touch of stiff bodies
  };
  const Parting& parting() const { return parting_; }

  /// k at rest [Pa/m]; 0 where bodies lie on summits, or are stiff.
  double bedStiffness() const { return beds_[at_rest_].stiffness; }
  /// The gap where the force is largest, valid until the next call.
  const GapField& strongest() { return bent(beds_[parting_.strongest]); }
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
    cv::Mat1d bending;       ///< by block [m]; empty: none
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
  const GapField& bent(const Bed& bed) { return bed.bending.empty() ? *field_ : bending_.bentBy(bed.bending); }
  /// - @p bed with what it does to the relief
  void follow(Bed bed);
  void followBeds();
  void followSummits();
  /// The bendings next to one: by k, or by the number of summits.
  std::vector<std::size_t> nextTo(std::size_t bed) const;
  void takeRest();
  void part();

  const GapField* field_ = nullptr;
  const ContactSettings* settings_ = nullptr;
  PlateBending bending_;
  ContactCurve curve_;
  double area_ = 0.0;
  std::vector<Bed> beds_;          ///< none, then by ascending k, then by the number of summits
  std::size_t first_summits_ = 1;  ///< where these begin
  std::size_t at_rest_ = 0;
  Parting parting_;
};

}  // namespace mems_stiction
