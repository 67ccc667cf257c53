#pragma once

/// @file
/// The force of one made surface of a device: all its contacts at one height of the
/// counter-surface.

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "approach/area_cells.hpp"
#include "device/device_surface.hpp"
#include "mems_stiction/contact/contact_solution.hpp"
#include "mems_stiction/device/device_force.hpp"
#include "mems_stiction/prediction/options.hpp"
#include "mems_stiction/prediction/prediction.hpp"

namespace mems_stiction {

/// The row of the area in which a piece's row lies: pieces are so far from each other that no
/// contact reaches over.
std::int64_t rowInArea(const DevicePieces& pieces, int piece, std::int64_t row);

/// Whether scans have room for all pieces: then they need not be made.
bool haveRoom(const std::vector<HeightMap>& scans, const DevicePieces& pieces);

/// Scans in an order by lot, each once before any comes again: of a few scans, some would else
/// speak for all.
class ScanDeck {
 public:
  /// - @p scans one at least; they outlive the object
  ScanDeck(const std::vector<HeightMap>& scans, std::uint64_t seed);

  const HeightMap& next();

 private:
  const std::vector<HeightMap>* scans_;
  std::mt19937_64 engine_;
  std::vector<std::size_t> order_;
  std::size_t next_ = 0;
};

/// Factors of figures from one area to a larger one [-].
struct AreaGrowth {
  double force = 1.0;
  double work = 1.0;
};

/// Why a plate that may tilt cannot do so over a device, as a sentence: where its contacts lie is
/// not known, or it is not made whole. Empty if it can.
std::string whyLevel(const DevicePieces& pieces);

/// Brings made surfaces to contact.
class DeviceAreaSolver {
 public:
  /// - @p model its mechanical load presses an area of `loaded_area` [m^2]; where its plate may
  /// tilt, the pieces are one
  ///   contact that is made whole (whyLevel()), which is a frame then
  DeviceAreaSolver(const Options& model, double loaded_area, const DevicePieces& pieces);

  /// On a surface that is made.
  Realisation realise(DeviceSurface& surface);
  /// Each of them on one surface, which is made once. They differ in their models alone; there is
  /// one at least.
  static std::vector<Realisation> realise(const std::vector<DeviceAreaSolver*>& solvers,
                                          DeviceSurface& surface);
  /// The same on parts of the next scans, at places by lot.
  /// - @p upper nullptr: a plane
  static std::vector<Realisation> realise(const std::vector<DeviceAreaSolver*>& solvers,
                                          ScanDeck& lower, ScanDeck* upper, std::uint64_t seed);

  /// On a surface whose cells have been collected, all of them. Where too many are in reach, a
  /// frame of it is made.
  /// @throw SurfaceError if they do not reach deep enough
  Realisation realise(const AreaCells& cells, DeviceSurface& surface);

  /// How figures go on from the area that is made to that of the device, by all realisations so
  /// far: neither falling nor faster than area.
  AreaGrowth growth();
  Exponents lastForceExponents() const { return force_exponents_; }
  Exponents lastWorkExponents() const { return work_exponents_; }
  /// Of the contact at rest, per area [Pa/m]; NaN if it is not known.
  double lastStiffness() const { return stiffness_; }
  /// The first piece of the first surface that was made, as DeviceForce has it.
  const HeightMap& madeSurface() const { return made_surface_; }
  /// About all realisations, each once.
  const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  class Gatherer;

  /// Figures of the area that is made, and how they go on from its quarters to it: powers of area.
  struct Followed {
    Realisation realisation;
    Exponents force_exponents;
    Exponents work_exponents;
    double stiffness = 0.0;  ///< [Pa/m]
    std::optional<AreaGrowth> growth;
  };

  /// Each of them by the surface's highest cells.
  /// - @p frame of the surface for one of them, made when it is needed
  /// - @p visit_once is called for its tiles, once
  static std::vector<Realisation> followCells(
      const std::vector<DeviceAreaSolver*>& solvers, DeviceSurface& surface,
      const std::function<cv::Mat(const DeviceAreaSolver&)>& frame,
      const DeviceSurface::Visit& visit_once);
  /// By cells where they suffice, else by a frame; nothing where more cells may suffice.
  /// - @p are_all as followCells() has it
  std::optional<Realisation> follow(const AreaCells& cells, const std::vector<AreaCells>& quarters,
                                    bool are_all, const std::function<cv::Mat()>& frame);
  Realisation taken(const Followed& followed);
  /// - @p are_all whether they are all cells of the surface: of fewer, those that are deep enough
  /// to say so count alone
  /// @return nothing where they do not suffice
  std::optional<Followed> followCells(const AreaCells& cells,
                                      const std::vector<AreaCells>& quarters, bool are_all,
                                      const Options& model);
  /// By places where contacts flow and a frame tells where; else as cells have it.
  /// - @p elastically finds what cells say of elastic surfaces
  Followed withFlow(const Followed& by_cells, const std::function<cv::Mat()>& frame,
                    const std::function<std::optional<Followed>()>& elastically);
  Followed followFrame(const cv::Mat& heights);
  Prediction predictFrame(const cv::Mat& heights) const;
  Followed ofFrame(const Prediction& found);
  /// The area that is made over that of a frame of it [-].
  double scaleOf(const Prediction& of_frame) const;
  bool tilts() const { return model_.guidance != Guidance::kGuided; }
  /// What followFrame() takes of a made surface.
  cv::Mat frameFrom(DeviceSurface& surface) const;
  /// Whether a frame has room for the surface, or for enough of its contacts.
  bool framesTell(int contacts) const;
  void warnOnce(const std::string& warning);

  Options model_;
  double loaded_area_;
  DevicePieces pieces_;
  std::int64_t cell_limit_;  ///< of a made surface, its highest ones
  /// The last contacts that were followed may flow, and frames tell where: cells know whole
  /// contacts alone.
  bool may_flow_ = false;
  Exponents force_exponents_;
  Exponents work_exponents_;
  double stiffness_ = 0.0;             ///< [Pa/m]
  std::vector<double> force_growths_;  ///< powers of the area with which figures go, by realisation
  std::vector<double> work_growths_;
  std::vector<std::string> warnings_;
  HeightMap made_surface_;
};

}  // namespace mems_stiction
