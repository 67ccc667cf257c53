#include "paper/contact_growth.hpp"

#include <algorithm>
#include <cmath>

#include "mechanics/jkr.hpp"
#include "mechanics/surface_forces.hpp"
#include "mems_stiction/contact/contact_settings.hpp"
#include "mems_stiction/mechanics/plasticity.hpp"
#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// What a response needs of the contacts, as arrays.
class ContactList {
 public:
  ContactList(const std::vector<Asperity>& asperities, const ContactPair& pair, bool is_elastic) {
    const double stiffness = 4.0 / 3.0 * pair.contact_modulus;
    for (const Asperity& asperity : asperities) {
      const double area = asperity.cap_radius * asperity.cap_radius;
      imposed_.push_back(stiffness * area * asperity.cap_radius / asperity.composite_radius);
      yield_.push_back(pair.hardness * kPi * area);
      plasticity_.push_back(is_elastic ? 0.0 : asperity.plasticity_index);
      radius_sum_ += asperity.composite_radius;
    }
  }

  /// C for loads and plasticity indices times the given factors [N].
  double carriedLoad(double imposed_factor, double yield_factor, double plasticity_factor) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < imposed_.size(); ++i) {
      const double share = regimeFactor(plasticity_factor * plasticity_[i]);
      const double imposed = imposed_factor * imposed_[i];
      sum += share * imposed + (1.0 - share) * std::min(imposed, yield_factor * yield_[i]);
    }
    return sum;
  }

  double radiusSum() const { return radius_sum_; }

 private:
  std::vector<double> imposed_;
  std::vector<double> yield_;
  std::vector<double> plasticity_;
  double radius_sum_ = 0.0;
};

/// The sum of JKR's energies over the contacts, without the van der Waals attraction across the
/// open gap (which adds at most F_w (mean gap)/2 per nominal area).
double jkrEnergy(const std::vector<Asperity>& asperities, double work, double modulus) {
  double energy = 0.0;
  for (const Asperity& asperity : asperities) {
    const double radius = asperity.composite_radius;
    const double contact = jkr::equilibriumContactRadius(0.0, work, radius, modulus);
    energy -= jkr::energy(contact, work, radius, modulus);
  }
  return energy;
}

class ContactGrowth : public ContactResponse {
 public:
  explicit ContactGrowth(const SolvedContact& contact)
      : pair_(contact.settings.lower, contact.settings.upper),
        contacts_(contact.asperities, pair_, contact.settings.deformation == Deformation::kElastic),
        adhesion_(kPi * contact.settings.interface.work_of_adhesion * contacts_.radiusSum()),
        lasting_(contact.settings.load.lastingFieldShare() * contact.electrostatic_force),
        applied_(contact.mechanical_load + contact.electrostatic_force),
        other_(contact.pull_off_force - contact.pull_off_force_jkr - contact.van_der_waals_force -
               lasting_),
        demand_(applied_ + contact.van_der_waals_force + other_ + 2.0 * adhesion_),
        carried_(contacts_.carriedLoad(1.0, 1.0, 1.0)),
        pull_off_(1.5 * adhesion_ + contact.van_der_waals_force + other_ + lasting_),
        far_(farAttraction(contact)),
        near_(contact.van_der_waals_force - far_),
        parting_work_(jkrEnergy(contact.asperities, contact.settings.interface.work_of_adhesion,
                                pair_.contact_modulus) /
                      contact.nominal_area) {}

  FigureFactors under(const ConstantFactors& factors) const override {
    const double area = factors.pitch * factors.pitch;
    const double near_now =
        area * (factors.hamaker * near_ / (factors.cutoff * factors.cutoff) + other_);
    const double demand_now = applied_ + near_now + area * factors.hamaker * far_ +
                              2.0 * area * factors.adhesion * adhesion_;
    const double carried_now =
        contacts_.carriedLoad(factors.modulus * factors.pitch, factors.hardness * area,
                              factors.modulus / factors.hardness / factors.pitch);
    const double growth =
        demand_ > 0.0 && carried_ > 0.0 ? demand_now / carried_now * (carried_ / demand_) : 1.0;
    const double pull_off_now =
        factors.place * growth * (1.5 * area * factors.adhesion * adhesion_ + near_now) +
        area * factors.hamaker * far_ +
        area * factors.contact_potential * factors.contact_potential * lasting_;
    // JKR's energy at no load goes with Gamma^(5/3) R^(4/3) K^(-2/3)
    const double energy = std::pow(factors.adhesion, 5.0 / 3.0) * std::pow(area, 4.0 / 3.0) *
                          std::pow(factors.modulus, -2.0 / 3.0);
    return {pull_off_ > 0.0 ? pull_off_now / area / pull_off_ : 1.0,
            factors.place * growth * energy / area};
  }

  double placeDeviation(double deviation) const override {
    return pull_off_ > 0.0 ? deviation * (pull_off_ - far_ - lasting_) / pull_off_ : 0.0;
  }

  double partingWork() const override { return parting_work_; }

 private:
  /// What of the van der Waals force the cut-off does not touch [N].
  static double farAttraction(const SolvedContact& contact) {
    if (!(contact.mean_gap > 0.0)) return 0.0;
    const double open_area = contact.nominal_area - contact.contact_area;
    return std::min(contact.van_der_waals_force,
                    open_area * surface_forces::vanDerWaalsPressure(
                                    contact.mean_gap, contact.settings.interface.hamaker_constant));
  }

  ContactPair pair_;
  ContactList contacts_;
  double adhesion_;  ///< pi Gamma sum R_i [N]
  double lasting_;   ///< what of F_e stays on the way out [N]
  double applied_;   ///< F_m + F_e [N]
  double other_;     ///< what else attracts around the contacts, such as condensed water [N]
  double demand_;    ///< B [N]
  double carried_;   ///< C [N]
  double pull_off_;  ///< [N]
  double far_;       ///< [N]
  double near_;      ///< [N]
  double parting_work_;
};

}  // namespace

std::unique_ptr<ContactResponse> contactGrowth(const SolvedContact& contact) {
  return std::make_unique<ContactGrowth>(contact);
}

}  // namespace mems_stiction
