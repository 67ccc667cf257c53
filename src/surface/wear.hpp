#pragma once

/// @file
/// What contacts have left on two surfaces that meet again and again: what has flowed stays flat,
/// on both.
///
///     const SurfacePair now = wear.on(as_made);           // as the contacts before have left them
///     const Prediction contact = model.predict(now);
///     wear.add(as_made, contact.deformed_lower, contact.deformed_upper);
///
/// Cycles of one scan and scans that come one after the other take it from here. Assumptions: the
/// surfaces meet in the same place each time, to the pixel, and each scan is one of the surfaces as
/// they were made.

#include <opencv2/core.hpp>

#include "mems_stiction/height_map/height_map.hpp"

namespace mems_stiction {

/// The pixels of the last contact, as they were made and as the contacts have left them. Copies
/// share them.
class Wear {
 public:
  bool empty() const { return lower_.left.empty(); }

  /// Surfaces as the contacts before have left them: height as made less what was pressed in. The
  /// same surfaces again are those of the last contact to the bit; pixels that were never in
  /// contact stay as they are. A side of another size is another surface, and one that no contact
  /// has changed is given back, a plane too.
  SurfacePair on(const SurfacePair& as_made) const;

  /// After a contact of on(as_made).
  /// - @p left_lower, left_upper heights after it, of as_made's size, CV_64FC1, NaN where there are
  /// none [m]
  void add(const SurfacePair& as_made, const cv::Mat& left_lower, const cv::Mat& left_upper);

 private:
  struct Side {
    cv::Mat made;  ///< CV_64FC1 [m]
    cv::Mat left;  ///< the same pixels now [m]
    bool is_changed = false;

    HeightMap on(const HeightMap& as_made, const HeightMap& grid) const;
    void add(const cv::Mat& as_made, const cv::Mat& after);
  };

  Side lower_, upper_;
};

}  // namespace mems_stiction
