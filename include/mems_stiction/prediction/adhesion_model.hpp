#pragma once

/// @file
/// Will this part stick? The one door for users of the core.
///
/// AdhesionModel brings two measured surfaces together until they rest on each other under the
/// loads, takes the loads away, and draws them apart again. It tells the largest force on the way,
/// the contact at rest, and the surfaces after it.
///
///     Options options;
///     options.load.mechanical_load = 1e-6;                        // N
///     AdhesionModel model(options);
///     Prediction prediction = model.predict(HeightMap(heights, 20e-9, 20e-9));
///     if (prediction.status == Status::kEquilibrium) use(prediction.pull_off_force);
///
/// Which solver answers is a matter of options.formulation (contact_solvers.hpp); assumptions stand
/// with each solver. Equations: doc/separation_curve.md for the default, doc/theory.md for what all
/// solvers share and for the paper's (Deladi, Krijnen, Tas, Elwenspoek 2002).

#include <memory>

#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// Keeps its working memory between calls; one object serves one thread at a time.
class AdhesionModel {
 public:
  /// @throw OptionsError if the options are out of range.
  explicit AdhesionModel(const Options& options);
  ~AdhesionModel();
  AdhesionModel(AdhesionModel&&) noexcept;
  AdhesionModel& operator=(AdhesionModel&&) noexcept;

  const Options& options() const;

  /// @throw OptionsError if the options are out of range; the previous ones stay.
  void setOptions(const Options& options);

  /// Two surfaces in one frame, same rows, cols and pitch; or one against a plane of the upper
  /// material.
  /// @throw SurfaceError if the grids differ or no pixel is valid in both.
  Prediction predict(const SurfacePair& surfaces);

  /// The same into an earlier prediction, whose memory is used again: from the second frame of a
  /// size on nothing is allocated. Maps of the earlier prediction that are shared elsewhere are
  /// left alone.
  void predict(const SurfacePair& surfaces, Prediction& prediction);

  /// The surfaces of the last predict() once more, under the options of now: what follows from the
  /// surfaces alone, their gap and their rms heights, is not computed again.
  /// - @p surfaces those of the last call; nobody has changed their pixels. Of another grid:
  /// predict()
  Prediction predictAgain(const SurfacePair& surfaces);

 private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

}  // namespace mems_stiction
