#include "mems_stiction/separation/conforming_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

/// Gaps that the law is tabulated at, of z0: the closest, the farthest, and how many.
constexpr double kClosest = 0.45;
constexpr double kFarthest = 400.0;
constexpr int kLawPoints = 4000;
/// The relief in so many classes of equal height.
constexpr int kReliefClasses = 1024;
/// Height at which surfaces without relief are past their strength, of z0.
constexpr double kFarEnough = 2.5;
/// Cells with a gap up to this count as in contact, of z0: those without relief lie at z0 but for round-off.
constexpr double kTouching = 1.0 + 1e-9;
/// Heights of the branch: this many from the deepest to where the last cell lets go.
constexpr int kHeights = 240;

/// What one spring does: traction and energy over the distance x = Z + r that it starts from, on the branch that comes
/// from contact, and on the one that comes from apart.
class Spring {
 public:
  Spring(const ContactTraction& law, double stiffness) : range_(law.range()) {
    gaps_.reserve(kLawPoints);
    const double ratio = std::pow(kFarthest / kClosest, 1.0 / (kLawPoints - 1));
    double gap = kClosest * range_;
    for (int i = 0; i < kLawPoints; ++i, gap *= ratio) {
      // counted from the atoms' centres: the plane of contact is at z0
      const double traction = law.traction(gap - range_);
      gaps_.push_back(gap);
      tractions_.push_back(traction);
      starts_.push_back(gap + traction / stiffness);
      energies_.push_back(0.5 * traction * traction / stiffness - law.energy(gap - range_));
    }
    last_inner_ = 0;
    while (last_inner_ + 1 < starts_.size() && starts_[last_inner_ + 1] > starts_[last_inner_]) ++last_inner_;
    first_outer_ = last_inner_;
    for (std::size_t i = last_inner_ + 1; i < starts_.size(); ++i) {
      if (starts_[i] < starts_[first_outer_]) first_outer_ = i;
    }
  }

  /// Whether it lets go at once when it is drawn far enough.
  bool snaps() const { return first_outer_ != last_inner_; }
  /// Distance beyond which it has let go [m].
  double end() const { return starts_[last_inner_]; }

  struct Point {
    double traction;
    double energy;
    double gap;
  };
  Point at(double start) const {
    const bool is_inner = !snaps() || start <= end();
    const auto begin = starts_.begin() + static_cast<std::ptrdiff_t>(is_inner ? 0 : first_outer_);
    const auto stop = is_inner ? starts_.begin() + static_cast<std::ptrdiff_t>(last_inner_ + 1) : starts_.end();
    const auto above = std::lower_bound(begin, stop, start);
    if (above == begin) return pointAt(static_cast<std::size_t>(begin - starts_.begin()));
    if (above == stop) return pointAt(static_cast<std::size_t>(stop - starts_.begin()) - 1);
    const auto i = static_cast<std::size_t>(above - starts_.begin());
    const double share = (start - starts_[i - 1]) / (starts_[i] - starts_[i - 1]);
    const Point from = pointAt(i - 1);
    const Point to = pointAt(i);
    return {from.traction + share * (to.traction - from.traction), from.energy + share * (to.energy - from.energy),
            from.gap + share * (to.gap - from.gap)};
  }

 private:
  Point pointAt(std::size_t i) const { return {tractions_[i], energies_[i], gaps_[i]}; }

  double range_;
  std::vector<double> gaps_;
  std::vector<double> tractions_;
  std::vector<double> starts_;
  std::vector<double> energies_;
  std::size_t last_inner_ = 0;
  std::size_t first_outer_ = 0;
};

struct ReliefClass {
  double height;  ///< mean of its cells [m]
  double share;   ///< of the valid cells [-]
};

std::vector<ReliefClass> reliefClasses(const GapField& field) {
  std::vector<double> sums(kReliefClasses, 0.0);
  std::vector<int> counts(kReliefClasses, 0);
  const double width = std::max(field.largestGap(), 1e-200) / kReliefClasses;
  std::vector<double> line(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line.data());
    for (const double gap : line) {
      if (!(gap <= field.largestGap())) continue;
      const auto place = static_cast<std::size_t>(std::min(gap / width, kReliefClasses - 1.0));
      sums[place] += gap;
      ++counts[place];
    }
  }
  std::vector<ReliefClass> classes;
  for (std::size_t i = 0; i < sums.size(); ++i) {
    if (counts[i] > 0) classes.push_back({sums[i] / counts[i], static_cast<double>(counts[i]) / field.validCount()});
  }
  return classes;
}

struct MeanPoint {
  double height;  ///< Z of the upper body, from the plane of contact at z0 [m]
  double traction;
  double energy;
  double contact_fraction;
};

MeanPoint meanAt(double height, const std::vector<ReliefClass>& relief, const Spring& spring, double range) {
  MeanPoint mean{height, 0.0, 0.0, 0.0};
  for (const ReliefClass& one : relief) {
    const Spring::Point point = spring.at(height + one.height);
    mean.traction += one.share * point.traction;
    mean.energy += one.share * point.energy;
    if (point.gap <= kTouching * range) mean.contact_fraction += one.share;
  }
  return mean;
}

}  // namespace

ConformingContact conformingContact(const GapField& field, const ContactTraction& law, double flattening_energy,
                                    double pressure) {
  ConformingContact contact;
  const double range = law.range();
  const double variance = field.rmsGap() * field.rmsGap();
  if (!law.attracts()) return contact;
  // surfaces without relief have nothing to give way: springs without end
  const double soft = variance > 0.0 ? 2.0 * flattening_energy / variance : std::numeric_limits<double>::infinity();
  if (!(soft > 0.0)) return contact;
  const double brittleness = soft * range * range / law.workOfAdhesion();
  const Spring spring(law, soft * (1.0 + 0.5 / (1.0 + brittleness * brittleness)));
  const std::vector<ReliefClass> relief = reliefClasses(field);

  // from the deepest, where the mean of the relief lies against the plane of contact, to where no cell holds
  const double deepest = range - relief.back().height;
  const double highest = std::max(spring.snaps() ? spring.end() : 0.0, kFarEnough * range);
  std::vector<MeanPoint> points;
  for (int i = 0; i <= kHeights; ++i) {
    points.push_back(meanAt(deepest + (highest - deepest) * i / kHeights, relief, spring, range));
  }
  std::size_t rest = 0;  // the least energy under the pressure: from there, the branch is followed outwards
  for (std::size_t i = 1; i < points.size(); ++i) {
    if (points[i].energy + pressure * points[i].height < points[rest].energy + pressure * points[rest].height) rest = i;
  }
  contact.work = std::max(0.0, -points[rest].energy);
  for (std::size_t i = rest; i < points.size(); ++i) {
    contact.states.push_back({range - points[i].height, points[i].traction, points[i].contact_fraction});
    if (points[i].traction > contact.strength) {
      contact.strength = points[i].traction;
      contact.strength_approach = range - points[i].height;
    }
  }
  return contact;
}

}  // namespace mems_stiction
