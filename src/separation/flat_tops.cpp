#include "separation/flat_tops.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {

void FlatTops::start(FrameSums& frame, double approach) {
  frame_ = &frame;
  const OverlapSweep& contacts = frame.contactsAt(approach);
  const std::vector<OverlapPatch>& patches = contacts.patches();
  const ContactTraction& law = frame.law();
  flat_cells_.assign(patches.size(), 0);
  for (int i = 0; i < contacts.cellCount(); ++i) {
    const OrderedCell& cell = frame.orderedCells()[static_cast<std::size_t>(i)];
    const auto place = static_cast<std::size_t>(contacts.livePlace(contacts.patchOf(cell)));
    if (cell.gap < patches[place].first_gap + law.range()) ++flat_cells_[place];
  }
  const double modulus = frame.patchForces().contactModulus();
  tops_.clear();
  for (std::size_t i = 0; i < patches.size(); ++i) {
    const double radius = std::sqrt(flat_cells_[i] * frame.field().cellArea() / kPi);
    const double reach = std::min(kPi * radius * law.strength() / (2.0 * modulus),
                                  std::sqrt(2.0 * kPi * radius * law.workOfAdhesion() / modulus));
    tops_.push_back({patches[i].first_gap, radius, reach});
  }
  std::sort(tops_.begin(), tops_.end(),
            [](const Top& a, const Top& b) { return a.end() < b.end(); });
}

double FlatTops::pullTogether() const {
  // largest where one of them lets go, as those do that would do so later
  double radii = 0.0;
  double gaps = 0.0;  // times radii
  double largest = 0.0;
  for (const Top& top : tops_) {
    radii += top.radius;
    gaps += top.radius * top.gap;
    largest = std::max(largest, gaps - radii * top.end());
  }
  return 2.0 * frame_->patchForces().contactModulus() * largest;
}

double FlatTops::pullOneByOne() const {
  const ContactTraction& law = frame_->law();
  double largest = 0.0;
  const std::size_t step = 1 + tops_.size() / chosen::kParts;
  for (std::size_t i = 0; i < tops_.size(); i += step) {
    const double approach = tops_[i].gap - law.strongestGap();
    double sum = 0.0;
    for (const Top& top : tops_) {
      const double distance = top.gap - approach;
      sum += top.radius *
             (distance < 0.0 ? distance : top.reach * law.traction(distance) / law.strength());
    }
    largest = std::max(largest, sum);
  }
  return 2.0 * frame_->patchForces().contactModulus() * largest;
}

}  // namespace mems_stiction
