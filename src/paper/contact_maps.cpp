#include "paper/contact_maps.hpp"

#include <cmath>

#include "contact/prepared_maps.hpp"
#include "paper/formulation_share.hpp"

namespace mems_stiction {
void ContactMaps::fill(const ContactProblem& problem, const EquilibriumState& state, ApproachSearch& search,
                       const AsperityLaw& law, ContactSolution& solution) {
  const GapField& field = problem.gap;
  const ContactSettings& settings = problem.settings;
  const bool wants_map = settings.output.contact_map;
  const bool wants_surfaces = settings.output.deformed_surfaces;
  prepareMaps(problem, solution);
  if (!wants_map && !wants_surfaces) return;

  const FormulationShare share(settings.lower, settings.upper, settings.interface.hardness_ratio_limit, law.formulation,
                               law.deformation);
  changes_.clear();
  for (const AsperityResponse& asperity : search.responses()) {
    const double plasticity_index = law.plasticityIndexOf(asperity.radius);
    changes_.push_back({share.lower(plasticity_index), share.upper(plasticity_index),
                        static_cast<std::uint8_t>(regimeOf(plasticity_index))});
  }

  PatchSweep& sweep = search.sweep();
  columns_.resize(static_cast<std::size_t>(field.cols()));
  gaps_.resize(columns_.size());
  const double past_contact = std::nextafter(state.approach, GapField::kInvalidGap);
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, gaps_.data());
    const int count = columnsBetween(0.0, past_contact, gaps_.data(), field.cols(), columns_.data());
    std::uint8_t* map = wants_map ? solution.contact_map.ptr<std::uint8_t>(row) : nullptr;
    double* lower_line = wants_surfaces ? solution.displaced_lower.ptr<double>(row) : nullptr;
    double* upper_line = wants_surfaces ? solution.displaced_upper.ptr<double>(row) : nullptr;
    for (int i = 0; i < count; ++i) {
      const std::int32_t col = columns_[static_cast<std::size_t>(i)];
      const std::int32_t patch = sweep.patchOf(field.cellAt(row, col));
      if (patch < 0) continue;
      const Change& change = changes_[static_cast<std::size_t>(sweep.livePlace(patch))];
      if (wants_map) map[col] = change.regime;
      if (wants_surfaces) {
        const double interference = state.approach - gaps_[static_cast<std::size_t>(col)];
        lower_line[col] -= change.lower_share * interference;
        upper_line[col] += change.upper_share * interference;
      }
    }
  }
}

}  // namespace mems_stiction
