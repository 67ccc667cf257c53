#pragma once

/// @file
/// What patches carry, one and all, and what the bending of their summits and their edges take from
/// the attraction: equations (S4) to (S8c) of doc/separation_curve.md. Sums over the patches of a
/// sweep take four at a time.

#include <vector>

#include "mems_stiction/contact/contact_settings.hpp"
#include "numeric/packet.hpp"
#include "separation/contact_traction.hpp"
#include "separation/overlap_sweep.hpp"
#include "separation/place_sums.hpp"

namespace mems_stiction {

/// What one patch carries at an approach.
struct PatchLoad {
  double elastic = 0.0;  ///< without flow [N]
  double carried = 0.0;  ///< with it [N]
  /// What the layer of the law takes of the overlap, (S6) [-]; the bodies take the rest.
  double layer_share = 0.0;
  double flatness = 0.0;  ///< 1 - m of its profile, (S8c), from a paraboloid (0) to a punch (1) [-]
  /// What flow has left of the overlap [-]: 1 elastic.
  double elasticShare() const { return elastic > 0.0 ? carried / elastic : 1.0; }
};

/// Of a pair of surfaces.
class PatchForces {
 public:
  /// P/(Ha A) at which a paraboloid begins to flow: its largest pressure is three times P over the
  /// overlapped area.
  static constexpr double kFlowOnset = 1.0 / 3.0;

  /// - @p cell_area dA [m^2]
  /// - @p flows whether the hardness limits what patches carry
  PatchForces(const ContactSettings& settings, double cell_area, bool flows);

  const ContactTraction& law() const { return law_; }
  double contactModulus() const { return contact_modulus_; }  ///< [Pa]
  double hardness() const { return hardness_; }               ///< infinite if nothing flows [Pa]

  /// What each patch of a sweep carries, in the order of its patches().
  void loadsOf(const OverlapSweep& contacts, double approach, std::vector<PatchLoad>& loads) const;
  /// Adds what all patches of a sweep carry and open.
  void addContacts(const OverlapSweep& contacts, double approach, PlaceSums& sums) const;
  /// c of a summit of radius R [m]: its pull-off force is c pi Gamma R [-], between DMT (2) and JKR
  /// (1.5).
  double pullOffPrefactor(double radius) const;
  /// Adds the sums of (S7) and (S8c).
  /// - @p in_reach the patches of the surfaces brought z0 closer, or more
  void addReach(const OverlapSweep& in_reach, double approach, PlaceSums& sums) const;

 private:
  /// PatchLoad of four patches.
  struct Loads {
    Packet elastic;
    Packet carried;
    Packet layer_share;
  };
  /// By number of cells, sum of their gaps [m] and P0 [m].
  Loads loadsOf(const Packet& cells, const Packet& gap_sum, const Packet& merged_term,
                double approach) const;

  ContactTraction law_;
  double cell_area_;
  double contact_modulus_;
  double hardness_;
  double load_factor_;    ///< 0.6 E sqrt(pi dA) [N/m]
  double maugis_factor_;  ///< lambda^3 per R [1/m]
  double flaw_length_;    ///< a0, (S8c) [m]
};

}  // namespace mems_stiction
