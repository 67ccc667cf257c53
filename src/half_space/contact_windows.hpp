#pragma once

/// @file
/// What do contacts that are out of equilibrium come to, while the rest of the frame answers as it
/// can?
///
/// Seen from one contact, the rest of a frame is an elastic body under tractions that hardly
/// change. So cells with a large residual r = t - K u are cut out in windows, each with K^-1 of the
/// frame within it and no change of traction beyond, and are brought into equilibrium there. All
/// changes together move the frame by one product:
///
///     s = K^-1 dt,
///             dt = the window's change of traction on the cells that it was made for, r elsewhere
///
/// The residual falls by one and a half to two decades each time, however many and however stiff
/// the contacts are; Newton's method on the whole frame takes some twenty products for that. Where
/// contacts fill much of the frame, windows have no rest to rely on.
///
/// Sources: Lanzkron, Rose and Wilkes, SIAM J. Sci. Comput. 17 (1996) 538, and Cai and Keyes, SIAM
/// J. Sci. Comput. 24 (2002) 183: nonlinear elimination, of which this is the part without a Newton
/// step between.

#include <memory>
#include <mutex>
#include <vector>

#include <opencv2/core.hpp>

#include "half_space/half_space_grid.hpp"
#include "half_space/minimiser_settings.hpp"
#include "half_space/stiffness_operator.hpp"
#include "half_space/traction_law.hpp"

namespace mems_stiction {

class ContactMinimiser;

/// Relaxes the contacts of one frame, time and again.
class ContactWindows {
 public:
  /// The frame out of equilibrium. The arrays are the grid's, but for the relief.
  struct Frame {
    double height;                   ///< of the upper body over first touch [m]
    const double* relief;            ///< frame_rows x frame_cols [m]
    const double* displacement;      ///< u [m]
    const double* elastic_traction;  ///< K u [Pa]
    const float* residual;           ///< t - K u [Pa]
    double mean_residual;            ///< what K cannot resist of it [Pa]
    double largest_residual;         ///< without that [Pa]
  };

  /// - @p response of the frame, without an influence
  /// - @p settings cancel and threads are taken from it
  ContactWindows(const HalfSpaceGrid& grid, const TractionLaw& law, const ElasticResponse& response,
                 const MinimiserSettings& settings);
  ~ContactWindows();

  /// Writes dt, without what K cannot resist, to `change`, an array of the grid [Pa].
  /// - @p stiffness K; used once
  /// @return whether it did: not where windows would fill much of the frame, nor where one has no
  /// answer
  bool relax(const Frame& frame, StiffnessOperator<double>& stiffness, float* change);
  /// Another law applies from now on.
  void setLaw(const TractionLaw& law);

 private:
  /// Blocks of cells; beyond the frame's edges they go on at the opposite ones.
  struct Window {
    cv::Rect blocks;
    int label;
  };
  /// What one window came to.
  struct Relaxed {
    std::vector<float> change;  ///< of all its cells, row by row [Pa]
    bool is_sound = false;      ///< all of it is a traction that the law can have
    double gained = 0.0;        ///< sum over its own cells of dt less the residual [Pa]
  };

  cv::Mat1b blocksOf(const Frame& frame) const;
  /// Groups of marked blocks, each grown by one; labels_ has the number of each.
  std::vector<Window> windowsAround(const cv::Mat1b& marked);
  bool areWorthIt(const std::vector<Window>& windows) const;
  cv::Rect cellsOf(const Window& window) const;
  Relaxed relaxOne(const Frame& frame, const Window& window);
  /// One that nobody uses, or a new one; and back again.
  std::unique_ptr<ContactMinimiser> takeMinimiser(const HalfSpaceGrid& window);
  void giveBack(std::unique_ptr<ContactMinimiser> minimiser);
  /// work(place in the window, place in arrays of the grid, row, column) for the cells of a window,
  /// row by row.
  template <typename Work>
  void forEachCell(const cv::Rect& cells, const Work& work) const;
  bool owns(const Window& window, int row, int col) const;
  /// How a window answers: half-spaces with free edges as themselves, films with them as worked out
  /// once, a periodic frame as its impulse response says.
  void findResponse(StiffnessOperator<double>& stiffness);

  HalfSpaceGrid grid_;
  TractionLaw law_;
  MinimiserSettings settings_;
  ElasticResponse response_;
  cv::Mat1d influence_;  ///< of a periodic frame or of films, within the widest window [m/Pa]
  cv::Mat1i labels_;     ///< of the blocks: 0 for those in no window
  std::mutex idle_mutex_;
  std::vector<std::unique_ptr<ContactMinimiser>>
      idle_;  ///< minimisers of windows of all shapes that came up
};

}  // namespace mems_stiction
