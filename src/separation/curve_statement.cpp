#include "separation/curve_statement.hpp"

#include <cmath>

#include "mems_stiction/contact/contact_settings.hpp"
#include "separation/chosen_constants.hpp"

namespace mems_stiction {

std::vector<UnusedSetting> CurveStatement::unusedSettings(const ContactSettings& settings) {
  std::vector<UnusedSetting> unused = {
      {"output/energy_curve"}, {"uncertainty/hardness"}, {"uncertainty/cutoff_distance"}};
  if (settings.interface.work_of_adhesion > 0.0 && settings.interface.hamaker_constant > 0.0) {
    unused.push_back({"interface/equilibrium_distance",
                      "work of adhesion and Hamaker constant tell the range of forces"});
  }
  return unused;
}

ModelStatement CurveStatement::of(const ContactSolution& solution, double gained, bool are_thin) {
  ModelStatement statement;
  statement.is_bound_where_bonded = false;
  statement.knows_every_load = true;
  statement.assumes_jkr = false;
  if (are_thin) {  // how far plates bend from contact to contact does not go by the flattening
                   // ratio
    statement.doubt = "the bodies are thin, and the curve takes them as thick";
    statement.error = chosen::kDoubtError;
    statement.error_without_doubt = chosen::kSureError;
    return statement;
  }
  statement.doubt = solution.model.doubt;
  const double flattening_ratio = solution.flattening_energy / gained;
  if (statement.doubt == nullptr && !solution.is_conforming && flattening_ratio < 1.0) {
    statement.doubt =
        "bonded surfaces have less energy than the contacts that were found on the way to them";
  }
  const ModelError& of_doubt = solution.is_conforming ? chosen::kBondedError : chosen::kDoubtError;
  statement.error_without_doubt = chosen::kSureError;
  statement.error = statement.doubt == nullptr ? chosen::kSureError : of_doubt;
  if (flattening_ratio > 1.0 && std::isfinite(flattening_ratio)) {
    const double share = std::pow(flattening_ratio, -chosen::kErrorPower);
    for (ModelError* error : {&statement.error, &statement.error_without_doubt}) {
      *error = {share * error->pull_off, share * error->work};
    }
  }
  return statement;
}

}  // namespace mems_stiction
