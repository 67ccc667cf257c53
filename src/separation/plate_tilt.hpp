#pragma once

/// @file
/// A plate that may tilt comes to rest where the moments of all that pushes and pulls vanish about
/// its middle, where the load acts.
///
///     sum over patches P_i r_i = sum over cells p r dA,
///             p: attraction of the cells apart, field, water  (S14)
///
/// From the rigid plate on its three places (support_plane.hpp), where the contacts need only share
/// the load otherwise, by Newton's steps with the stiffness of the patches, (3/4) P/(V/A) each
/// (Hertz), within a trusted range of heights (Levenberg's damping where fewer than three carry).
/// The moments are those of the curve at its own rest.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "separation/contact_curve.hpp"
#include "separation/support_plane.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class PlateTilt {
 public:
  /// The gap when the plate has settled, valid until the next call.
  /// @throw SurfaceError where no three places surround the middle
  const GapField& settle(const GapField& level, const ContactSettings& settings);
  /// Of the plate over the relief as it was given.
  const PlaneSlopes& slopes() const { return slopes_; }
  /// Whether the loads would tip the plate further than the relief is high.
  bool isTipped() const { return is_tipped_; }

 private:
  /// On the plate at one tilt: push minus pull [N m], what turns it about y and about x, and how it
  /// answers to slopes.
  struct Balance {
    double x = 0.0;
    double y = 0.0;
    double largest = 0.0;    ///< the same with nothing that cancels [N m]
    double stiffness = 0.0;  ///< of all patches [N/m]
    double xx = 0.0;         ///< second moments of the stiffness about its own middle [N m]
    double xy = 0.0;
    double yy = 0.0;
    double reach = 0.0;    ///< depth of contact and range of the law [m]
    double share() const;  ///< of the moments in `largest` [-]
  };

  void tiltTo(const GapField& level, const PlaneSlopes& slopes);
  Balance balanceAt(const GapField& level, const PlaneSlopes& slopes,
                    const ContactSettings& settings);
  void addPatches(Balance& balance);
  void addAttraction(const ContactSettings& settings, Balance& balance);

  PlaneSlopes slopes_;
  bool is_tipped_ = false;
  cv::Mat1d plane_;
  GapField tilted_;
  ContactCurve curve_;
  std::vector<double> line_;
  std::vector<double> overlaps_;    ///< by patch [m]
  std::vector<PlaceOnPlate> sums_;  ///< by patch: overlap times place [m^2]
};

}  // namespace mems_stiction
