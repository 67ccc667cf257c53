#pragma once

/// @file
/// Bodies that bend under what presses and pulls at them, at one height of the upper body:
///
///     u = sum over waves of C(q) f_q,   f = what patches carry - what attracts, per area          (S15)
///
/// f is that of the relief as u has lowered it. What C is: plate_bending.hpp. The bodies stay in the equilibrium in which
/// they are, from one height to the next, until there is none near by: then they jump to where the energy falls to, as plates do.
///
/// In v with u = sqrt(C) v, energy of bending is v^2/2 and the steps are Newton's with the stiffness of the patches, (3/4) P/(V/A)
/// each (Hertz). That of the attraction is below 0 and left out: what is left is more than the stiffness there is, so that each step goes down.

#include <vector>

#include <opencv2/core.hpp>

#include "approach/gap_field.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "separation/frame_sums.hpp"
#include "separation/plate_bending.hpp"
#include "separation/separation_curve.hpp"

namespace mems_stiction {

/// Keeps its memory between frames.
class PressedPlate {
 public:
  /// Straight bodies. All of it must outlive the object's use.
  void start(PlateBending& bending, const GapField& field, const ContactSettings& settings);
  /// The same bodies over a relief that contacts have changed, which do not flow any more.
  void change(const GapField& field);

  /// On which way the surfaces are.
  struct HeightWay {
    double rest = 0.0;          ///< height from which they part [m]
    double longest_hold = 0.0;  ///< as in Way
  };
  /// Lets the bodies settle.
  /// - @p height of the upper body over the mean of the relief [m]
  const SeparationState& settle(double height, const HeightWay& way);
  /// Whether the last settle() came to an end: bodies that still fall to another place go on at the next height.
  bool hasSettled() const { return has_settled_; }

  /// How far the bodies as they are would move at a height, at most [m]; they stay.
  double firstMove(double height, const HeightWay& way);

  const SeparationState& state() const { return state_; }
  FrameSums& frame() { return frame_; }
  /// v; taken back where another height is tried from the same bodies.
  const cv::Mat1d& shape() const { return shape_; }
  void takeBack(const cv::Mat1d& shape) { shape.copyTo(shape_); }
  /// u by block [m].
  cv::Mat1d blocks() const { return blocks_.clone(); }
  double energy() const;  ///< of bending, per area [J/m^2]

 private:
  void stateOf(double height, const HeightWay& way);
  void takeForces();
  /// residual_ of state and shape.
  void takeResidual();
  /// step_ from residual_: to the equilibrium where there is one near by, else to where the energy falls.
  void findStep();
  /// - @p stiffness of what lies between the bodies, by block [Pa/m]
  /// @return whether they are stiff enough, all together
  bool solve(const cv::Mat1d& stiffness);
  void mirror(cv::Mat1d& blocks, cv::Mat1d& all) const;

  PlateBending* bending_ = nullptr;
  const GapField* field_ = nullptr;
  const ContactSettings* settings_ = nullptr;
  bool flows_ = true;
  bool has_settled_ = false;
  FrameSums frame_;
  const GapField* bent_ = nullptr;
  SeparationState state_;
  cv::Mat1d shape_;   ///< v
  cv::Mat1d blocks_;  ///< u [m]
  cv::Mat1d pressure_block_;
  cv::Mat1d stiffness_block_;
  cv::Mat1d softness_block_;
  cv::Mat1d pressure_;         ///< f [Pa]
  cv::Mat1d stiffness_;        ///< of patches [Pa/m]
  cv::Mat1d total_stiffness_;  ///< with what attracts, which takes from it [Pa/m]
  cv::Mat1d residual_;
  cv::Mat1d step_;
  cv::Mat1d rooted_;
  cv::Mat1d product_;
  cv::Mat1d left_;
  cv::Mat1d direction_;
  cv::Mat1d from_;
  std::vector<PatchLoad> loads_;
  std::vector<double> line_;
  std::vector<int> columns_;  ///< block of each
  std::vector<double> overlaps_;
};

}  // namespace mems_stiction
