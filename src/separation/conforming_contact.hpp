#pragma once

/// @file
/// Surfaces that lie against each other everywhere: what it takes to draw them apart.
///
/// Where flattening costs less than adhesion gives, contacts grow together until nothing is left
/// between them, and a sum over patches says little. Each cell then hangs on a spring
/// (spring_contact.hpp), which gives curve, force and contact area. All springs are equal, and none
/// hears of its neighbours. Long waves of the flattened relief pull at the interface, and it tears
/// at one place before all springs pull at their best. Where that may be, the force is doubted, and
/// the half-space has it:
///
///     pi/q > a0 = pi E Gamma/(2 s^2),  q = 4 U/(A E sigma^2)  a crack has room in half a wave
///     2 U/(A sigma) > 0.03 s                                  the tension of the waves     (S10b)
///
/// with U by lines or by waves (flattening_waves.hpp).
///
/// s is the strength of the law, sigma the rms height, a0 the radius from which a crack needs less
/// than s. The work is that of the springs with the flattening energy of all waves, and of what
/// jumps lose, (S10a).

#include <vector>

#include "approach/gap_field.hpp"
#include "separation/contact_traction.hpp"
#include "separation/flattening_waves.hpp"
#include "separation/spring_contact.hpp"
#include "separation/unloading.hpp"

namespace mems_stiction {

/// Bonded surfaces of one frame. Keeps its memory between frames.
class ConformingContact {
 public:
  /// What the next calls are about. Everything must outlive them; nothing is computed yet.
  /// - @p field that stays on the way out
  /// - @p water between the surfaces
  /// - @p flattening_energy U/A [J/m^2], >= 0
  /// - @p contact_modulus E [Pa], > 0
  void start(const GapField& gap, const ContactTraction& law, const FieldLaw& field,
             const WaterLaw& water, double contact_modulus, double flattening_energy);

  /// Whether springs hold the bonded surfaces together without a load.
  bool holds();
  /// From rest under a pressure [Pa], >= 0.
  /// - @p by_contacts whose work is taken where it is more, and that says what jumps lose
  Unloading unloading(const Unloading& by_contacts, double pressure);

 private:
  const std::vector<ReliefClass>& relief();
  /// Of springs that store this energy when all is flat [J/m^2].
  std::vector<SpringState> springsOf(double flattening_energy);
  const std::vector<SpringState>& branch();
  /// By springs and law without a load, per area [J/m^2].
  static double energyGained(const std::vector<SpringState>& springs);
  /// - @p flattening_energy U/A by waves [J/m^2]
  void takeWork(const Unloading& by_contacts, double flattening_energy, Unloading& unloading);
  /// (S10b): whether the interface may tear before all springs pull at their best. Lines see no
  /// waves that are long against the frame, blocks none that are short: both are asked.
  bool mayTear(double flattening_energy) const;
  double area() const { return gap_->validCount() * gap_->cellArea(); }

  const GapField* gap_ = nullptr;
  const ContactTraction* law_ = nullptr;
  FieldLaw field_{0.0, 0.0, 1.0};
  WaterLaw water_;
  double contact_modulus_ = 0.0;
  double flattening_energy_ = 0.0;
  std::vector<ReliefClass> relief_;  ///< empty until it is asked for, as the branch
  std::vector<SpringState> branch_;
  FlatteningWaves waves_;
  std::vector<double> line_;
};

}  // namespace mems_stiction
