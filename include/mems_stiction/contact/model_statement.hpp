#pragma once

/// @file
/// What a solver says of its own answer, for those who judge by it, and how the contact answers
/// when the constants are others than those that it was solved with: they need not know which
/// solver it was.
///
///     if (prediction.model.doubt != nullptr) report(prediction.model.doubt);

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
  double contact_potential = 1.0;
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

/// How far figures lie from the half-space's: standard deviation of the logarithm of their ratio
/// [-]; 0: not known.
struct ModelError {
  double pull_off = 0.0;
  double work = 0.0;
};

/// A setting without effect on a solver's answer, nor on the intervals of that.
struct UnusedSetting {
  const char* key;
  const char* why = nullptr;  ///< nullptr: the solver has no use for it, whatever the others are
};

/// A solver that says nothing claims nothing.
struct ModelStatement {
  ModelError error;
  ModelError error_without_doubt;  ///< where something better has answered what is doubted
  bool is_bound_where_bonded =
      true;  ///< bonded surfaces hold with the pull-off force or more: the search ended there
  bool knows_every_load =
      false;  ///< the contact at another load is found by asking again, for surfaces that bore more
  bool assumes_jkr = true;  ///< of each contact, whatever Tabor's parameter says
  /// Why the pull-off force may be out by more than 1.3 against the half-space, as a sentence
  /// without its full stop; nullptr: it is within the range of the model.
  const char* doubt = nullptr;
  /// How the figures move with the constants; nullptr: with the exponents of the solution.
  MakeContactResponse respond = nullptr;
};

}  // namespace mems_stiction
