#pragma once

/// @file
/// Are the scans alike everywhere, and if not, which place holds most?
///
/// Made surfaces are alike everywhere: their law is that of all scans together. Each scan is
/// divided into kBlocks x kBlocks blocks. Mean squared gradient and variance of a block's levelled
/// heights, as the logarithm of their ratio to the scan's median block, say how far places differ;
/// scans that were made by the law say how far they differ by chance. Of a scan that goes beyond
/// that, blocks are predicted as frames by themselves, and the one that holds most is the place.
///
/// What such a place may do to the device: if it bonds all over by itself, it may close in the
/// device, too, and then holds as much more as it does beyond the strongest blocks of made scans.
/// If not, rougher places keep the surfaces apart there as they do in the scan, and the scan that
/// holds most says how much more (LawCheck). In either case the device may rest on such a place
/// alone, where it lies higher than in the scan. Blocks lie under a part of the counter-surface of
/// their size, without its tilt; without one that is as large, under a plane.

#include <optional>
#include <string>
#include <vector>

#include <opencv2/core.hpp>

#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/height_map/height_map.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"

namespace mems_stiction {

/// What a block of a scan is like.
struct PlaceTexture {
  cv::Rect place;         ///< [pixels]
  double gradient = 0.0;  ///< ln of the mean squared gradient over that of the scan's median block
  double height = 0.0;    ///< the same of the variance of its heights, levelled
};
/// Of each block of which half was measured; none of a scan that is too small to be divided.
std::vector<PlaceTexture> placeTextures(const HeightMap& scan);

/// What the place that holds most does by itself.
struct PlaceAlone {
  double force = 0.0;  ///< pull-off force [N]
  double work = 0.0;   ///< apparent work of adhesion [J/m^2]
  double area = 0.0;   ///< [m^2]
};

/// Compares the places of scans with those of scans that were made like them. One object serves one
/// thread.
class PlaceCheck {
 public:
  /// - @p scans of the lower surface
  /// - @p loaded_area that load.mechanical_load of the model goes for [m^2]
  PlaceCheck(const Options& model, double loaded_area, const std::vector<NamedScan>& scans,
             const std::vector<HeightMap>& counter_surface);

  /// - @p made like the scans, in their order
  /// - @p same_scans a check of the same scans under another model, to which @p made has been
  /// added: they differ as there; may
  ///   be null
  void add(const std::vector<HeightMap>& made, const PlaceCheck* same_scans = nullptr);
  /// After the last of them: looks for the place that holds most where places differ, and nowhere
  /// else, since to predict blocks takes longer than all the rest.
  /// @return whether that place bonds all over, so that compare() is to get all made scans once
  /// more
  bool find();
  void compare(const std::vector<HeightMap>& made,
               const std::vector<HeightMap>& made_counter_surface);

  bool isUneven() const { return place() != nullptr; }
  /// Which scan has the place that holds most, where, and what it is like; empty if the scans are
  /// even.
  std::string sentence() const;
  /// Whether the place that holds most bonds all over by itself.
  bool closes() const;
  /// That place as a frame; all 0 if the scans are even.
  PlaceAlone alone() const;
  /// Of ln F and ln w, by how much that place holds more than the strongest ones of made scans,
  /// where it closes; else 0 [-].
  double forceExcess() const { return excess(&Strongest::force); }
  double workExcess() const { return excess(&Strongest::work); }

 private:
  /// How far the places of a scan differ: the largest logarithm.
  struct Range {
    double gradient = 0.0;
    double height = 0.0;
  };
  /// Of the block of a scan that holds most, logarithms.
  struct Strongest {
    double force = 0.0;
    double work = 0.0;
    bool is_conforming = false;
    PlaceTexture texture;
  };
  struct Checked {
    std::size_t scan = 0;  ///< among all of them
    Range own;
    std::vector<Range> made;
    std::optional<Strongest> strongest;
  };

  static Range rangeOf(const std::vector<PlaceTexture>& textures);
  /// Of a figure of all scans that were made on the grid of this one: its law is that of all.
  std::vector<double> madeLike(const Checked& checked, double Range::*figure) const;
  /// Whether its places differ by more than chance.
  bool isBeyond(const Checked& checked) const;
  Strongest strongestOf(const HeightMap& scan, const std::vector<HeightMap>& counter_surface);
  double excess(double Strongest::*figure) const;
  /// The scan that has the place which holds most, of those whose places differ; null if none do.
  const Checked* place() const;

  Options model_;
  double loaded_area_;
  AdhesionModel adhesion_;
  std::vector<NamedScan> scans_;
  std::vector<HeightMap> counter_surface_;
  std::vector<Checked> checked_;
  std::vector<Strongest> made_;  ///< of made scans, where a place closes
};

}  // namespace mems_stiction
