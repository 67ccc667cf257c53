#include "verdict/regime_flags.hpp"

#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

constexpr double kLargeShare = 0.5;
/// Contacts of one pixel have no larger area, of pixels.
constexpr double kOneCell = 1.05;

struct Shares {
  double flowing = 0.0;  ///< of contacts that are not elastic [-]
  double small = 0.0;    ///< of contacts of few pixels [-]
  double border = 0.0;   ///< of contacts at the frame's border [-]
  double single = 0.0;   ///< of contacts of one pixel [-]
};

Shares sharesOf(const Prediction& prediction, double cell_area) {
  Shares shares;
  const double smallest_area = kFewestCellsPerContact * cell_area;
  const std::vector<Asperity>& contacts = prediction.holdingContacts();
  if (contacts.empty()) {
    const double mean_area = prediction.contact_area / prediction.asperity_count;
    shares.flowing = static_cast<double>(prediction.asperity_count - prediction.elastic_count) /
                     prediction.asperity_count;
    shares.small = mean_area < smallest_area ? 1.0 : 0.0;
    shares.single = mean_area < kOneCell * cell_area ? 1.0 : 0.0;
    return shares;
  }
  double sum = 0.0;
  for (const Asperity& asperity : contacts) {
    sum += asperity.composite_radius;
    if (asperity.regime != Regime::kElastic) shares.flowing += asperity.composite_radius;
    if (asperity.area < smallest_area) shares.small += asperity.composite_radius;
    if (asperity.area < kOneCell * cell_area) shares.single += asperity.composite_radius;
    if (asperity.is_at_border) shares.border += asperity.composite_radius;
  }
  shares.flowing /= sum;
  shares.small /= sum;
  shares.border /= sum;
  shares.single /= sum;
  return shares;
}

struct FlagWords {
  RegimeFlag flag;
  const char* name;
  const char* meaning;
};

constexpr FlagWords kFlagWords[] = {
    {kBondedFlag, "bonded", "the surfaces bond"},
    {kNoEquilibriumFlag, "no_equilibrium", "the search ended before the equilibrium"},
    {kTaborFlag, "tabor", "JKR is not the theory for these asperities"},
    {kPlasticityFlag, "plasticity", "most of the adhesion is of contacts that flow"},
    {kResolutionFlag, "resolution", "most of the adhesion is of contacts of few pixels"},
    {kFewContactsFlag, "few_contacts",
     "few contacts: another place of the surface may differ much"},
    {kNearBondingFlag, "near_bonding", "the pull-off force may be out by more than 1.3"},
    {kBorderFlag, "border",
     "most of the adhesion is of contacts at the frame's border: their summits may lie outside"},
    {kOnePixelFlag, "one_pixel", "most of the adhesion is of contacts of one pixel"},
    {kUnresolvedFlag, "unresolved",
     "the scan does not show what holds: its pixels or its tip are too coarse"}};

}  // namespace

std::uint32_t regimeFlags(const Prediction& prediction, double cell_area) {
  std::uint32_t flags = 0;
  if (prediction.status == Status::kBonded && !prediction.is_bonded_by_load) flags |= kBondedFlag;
  if (prediction.status == Status::kNoEquilibrium) flags |= kNoEquilibriumFlag;
  if (prediction.model.doubt != nullptr) flags |= kNearBondingFlag;
  if (prediction.short_waves.areUnresolved()) flags |= kUnresolvedFlag;
  if (!prediction.has_asperities) return flags;  // nothing is known of single contacts
  if (prediction.pull_off_contact_count == 0) return flags | kFewContactsFlag;
  if (prediction.model.assumes_jkr && prediction.contact_theory != ContactTheory::kJkr)
    flags |= kTaborFlag;
  const Shares shares = sharesOf(prediction, cell_area);
  if (shares.flowing > kLargeShare) flags |= kPlasticityFlag;
  if (shares.small > kLargeShare) flags |= kResolutionFlag;
  if (shares.border > kLargeShare) flags |= kBorderFlag;
  if (shares.single > kLargeShare) flags |= kOnePixelFlag;
  if (prediction.pull_off_contact_count < kFewestContacts) flags |= kFewContactsFlag;
  return flags;
}

std::string modelDoubt(const Prediction& prediction) {
  return prediction.model.doubt != nullptr ? prediction.model.doubt : "";
}

std::uint32_t flagsForHalfSpace(std::uint32_t flags) {
  return (flags & kUnresolvedFlag) != 0 ? 0 : flags & (kNoEquilibriumFlag | kNearBondingFlag);
}

std::vector<std::string> regimeFlagList(std::uint32_t flags) {
  std::vector<std::string> list;
  for (const FlagWords& words : kFlagWords) {
    if ((flags & words.flag) != 0) list.emplace_back(words.name);
  }
  return list;
}

std::vector<std::string> regimeFlagSentences(std::uint32_t flags, const std::string& doubt) {
  std::vector<std::string> list;
  for (const FlagWords& words : kFlagWords) {
    if ((flags & words.flag) == 0) continue;
    list.emplace_back(words.meaning);
    if (words.flag == kNearBondingFlag && !doubt.empty()) list.back() += " (" + doubt + ")";
  }
  return list;
}

std::string regimeFlagNames(std::uint32_t flags) { return listed(regimeFlagList(flags)); }

}  // namespace mems_stiction
