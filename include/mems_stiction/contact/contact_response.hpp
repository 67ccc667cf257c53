#pragma once

/// @file
/// How a solved contact answers when the constants that it was solved with are others.

#include <memory>
#include <vector>

namespace mems_stiction {

struct Asperity;
struct ContactSettings;

/// By which factors constants differ from those of the solution; 1: as they are.
struct ConstantFactors {
  double adhesion = 1.0;  ///< work of adhesion
  double hardness = 1.0;
  double modulus = 1.0;
  double pitch = 1.0;  ///< of the scan
  double cutoff = 1.0;
  double hamaker = 1.0;
  double place = 1.0;  ///< sum of the contacts' radii: another place of the surface has others
};

/// By which factors the figures of a solution move, per nominal area.
struct FigureFactors {
  double pull_off = 1.0;
  double work = 1.0;  ///< of drawing the surfaces apart
};

/// The figures of a solution that a response may need beside its contacts.
struct SolvedContact {
  const ContactSettings& settings;
  const std::vector<Asperity>& asperities;
  double mechanical_load;      ///< [N]
  double electrostatic_force;  ///< [N]
  double van_der_waals_force;  ///< [N]
  double pull_off_force;       ///< [N]
  double pull_off_force_jkr;   ///< [N]
  double nominal_area;         ///< [m^2]
  double contact_area;         ///< [m^2]
  double mean_gap;             ///< [m]
};

/// Of one solution.
class ContactResponse {
 public:
  ContactResponse() = default;
  virtual ~ContactResponse() = default;
  ContactResponse(const ContactResponse&) = delete;
  ContactResponse& operator=(const ContactResponse&) = delete;

  virtual FigureFactors under(const ConstantFactors& factors) const = 0;
  /// Standard deviation of the logarithm of the pull-off force from place to place.
  /// - @p deviation that of the sum of the contacts' radii
  virtual double placeDeviation(double deviation) const = 0;
  /// Energy per nominal area that parting the contacts costs when no load presses [J/m^2].
  virtual double partingWork() const = 0;
};

using MakeContactResponse = std::unique_ptr<ContactResponse> (*)(const SolvedContact& contact);

}  // namespace mems_stiction
