#pragma once

/// @file
/// How two surfaces may part, and how they do: candidates, each by what it takes for granted, and one decision
/// (doc/separation_curve.md, "Which way the surfaces part").

#include <optional>
#include <vector>

#include "mems_stiction/contact/contact_solution.hpp"

namespace mems_stiction {

/// What a way out takes for granted.
enum class Parting {
  kByContacts,       ///< contacts let go one by one; what lies between them is apart (separation_curve.hpp)
  kAsAWhole,         ///< nothing lies between them: the interface breaks as a whole, or from its weakest place
  kFromOpenValleys,  ///< the same, but some valleys of the relief have stayed open: it tears from there
};

/// One way out, from rest to apart: whole when it is made, and never changed.
struct WayOut {
  Parting parting = Parting::kByContacts;
  double force = 0.0;         ///< largest [N]
  double work = 0.0;          ///< per area [J/m^2]
  double lost = 0.0;          ///< of the work: what jumps lose of the energy of the state at rest, per area [J/m^2]
  double contact_area = 0.0;  ///< at rest [m^2]
  Exponents force_exponents;
  Exponents work_exponents;
  const char* doubt = nullptr;              ///< why the force may be out by more than 1.3 (ModelStatement::doubt)
  std::vector<SeparationCurvePoint> curve;  ///< by descending displacement; empty where it is the way in
};

class ConformingContact;

/// The decision: the way out of surfaces that conform, or none if they part by contacts.
/// - @p by_contacts the candidate of the patches
/// - @p bonded makes the candidates of surfaces that conform
/// - @p joined_share ContactCurve::joinedShare() of the way in [-]
/// - @p flattening_ratio U/(A Gamma) [-], may be infinite or NaN
/// - @p pressure of the load that holds the surfaces together [Pa], >= 0
std::optional<WayOut> conformingWayOut(const WayOut& by_contacts, double joined_share, ConformingContact& bonded,
                                       double flattening_ratio, double pressure);

}  // namespace mems_stiction
