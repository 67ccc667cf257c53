#include "separation/spring_contact.hpp"

#include <algorithm>
#include <cmath>

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// Cells up to this start count as in contact, of z0: those without relief lie at z0 but for
/// round-off.
constexpr double kTouching = 1.0 + 1e-9;
/// By which steps grow where water alone pulls, and so many z0 beyond the reach of the law.
constexpr double kStepGrowth = 1.02;
constexpr double kPastLaw = 8.0;

/// What one spring does: traction and energy over the distance x = Z + r that it starts from, on
/// the branch that comes from contact, and on the one that comes from apart.
class Spring {
 public:
  struct Point {
    double start;
    double traction;
    double energy;
    double gap;
  };

  /// - @p nearest distance that is asked for [m]
  /// - @p span from the nearest cell to the farthest one [m]: where the nearest has let go, the
  /// farthest is that much beyond
  Spring(const ContactTraction& law, const FieldLaw& field, const WaterLaw& water, double stiffness,
         double nearest, double span) {
    constexpr double kGrowth = 1.0 + chosen::kAccuracy;
    // counted from the atoms' centres: the plane of contact is at z0
    const auto pointAt = [&](double gap) {
      double traction = law.traction(gap - law.range());
      double energy = law.energy(gap - law.range());
      const double apart = std::max(gap - law.range(), 0.0);
      if (field.isOn()) {
        traction += field.pressure(apart);
        energy += field.energy(apart) + field.pressure(0.0) * (apart - (gap - law.range()));
      }
      traction += water.pressure(apart);
      energy += water.energy(apart);
      return Point{gap + traction / stiffness, traction,
                   0.5 * traction * traction / stiffness - energy, gap};
    };
    const auto holds = [&](double gap) {
      const double apart = gap - law.range();
      return law.curvature(apart) < 0.0 || apart < water.gapLimit();
    };
    double gap = law.range();
    while (pointAt(gap).start > nearest && gap > chosen::kAccuracy * law.range()) gap /= kGrowth;
    do {
      points_.push_back(pointAt(gap));
      // the law falls ever more steeply up to where it bends back: beyond, no spring pulls harder,
      // and none lets go
      if (holds(gap)) end_ = std::max(end_, points_.back().start);
      gap *= kGrowth;
    } while (holds(points_.back().gap) || points_.back().start < end_ + span);
  }

  /// Distance beyond which it has let go, or pulls ever less [m].
  double end() const { return end_; }

  /// At a distance; @p place is where the last, smaller distance was found, 0 at first.
  Point at(double start, std::size_t& place) const {
    // where it lets go the next points start nearer, down to those that it comes to
    const std::size_t last = points_.size() - 1;
    while (place < last && points_[place + 1].start < start) ++place;
    const Point& from = points_[place];
    if (place == last || start <= from.start) return from;
    const Point& to = points_[place + 1];
    const double share = (start - from.start) / (to.start - from.start);
    return {start, from.traction + share * (to.traction - from.traction),
            from.energy + share * (to.energy - from.energy),
            from.gap + share * (to.gap - from.gap)};
  }

 private:
  std::vector<Point> points_;
  double end_ = 0.0;
};

SpringState meanAt(double height, const std::vector<ReliefClass>& relief, const Spring& spring) {
  SpringState mean;
  mean.height = height;
  std::size_t place = 0;
  for (const ReliefClass& one : relief) {
    const Spring::Point point = spring.at(height + one.depth, place);
    mean.traction += one.share * point.traction;
    mean.energy += one.share * point.energy;
  }
  return mean;
}

}  // namespace

ReliefClasses::ReliefClasses(double lowest, double highest)
    : lowest_(lowest),
      inverse_width_(chosen::kParts / std::max(highest - lowest, 1e-200)),
      sums_(chosen::kParts, 0.0),
      counts_(chosen::kParts, 0) {}

void ReliefClasses::add(double depth) {
  const double above = depth - lowest_;
  const auto place =
      static_cast<std::size_t>(std::clamp(above * inverse_width_, 0.0, chosen::kParts - 1.0));
  sums_[place] += above;
  ++counts_[place];
}

std::vector<ReliefClass> ReliefClasses::classes() const {
  double count = 0.0;
  for (const int in_class : counts_) count += in_class;
  std::vector<ReliefClass> classes;
  for (std::size_t i = 0; i < sums_.size(); ++i) {
    if (counts_[i] > 0) classes.push_back({sums_[i] / counts_[i], counts_[i] / count});
  }
  return classes;
}

std::vector<SpringState> springBranch(const std::vector<ReliefClass>& relief,
                                      const ContactTraction& law, const FieldLaw& field,
                                      const WaterLaw& water, double stiffness) {
  const double range = law.range();
  const double deepest = range - relief.back().depth;
  const double span = relief.back().depth - relief.front().depth;
  const Spring spring(law, field, water, stiffness, range - span, span);
  const double highest = spring.end() - relief.front().depth;
  // water reaches many times further than the law
  const double by_field = field.isOn() ? field.pressure(0.0) : 0.0;
  const double pull = (law.strength() + by_field + water.pressure(0.0)) / stiffness;
  const double by_law = deepest + span + pull + kPastLaw * range;
  const bool is_far = water.energy(0.0) > 0.0 && by_law < highest;
  const double even = is_far ? by_law : highest;
  std::vector<SpringState> branch;
  for (int i = 0; i <= chosen::kParts; ++i)
    branch.push_back(meanAt(deepest + (even - deepest) * i / chosen::kParts, relief, spring));
  double step = (even - deepest) / chosen::kParts;
  while (branch.back().height < highest) {
    step *= kStepGrowth;
    branch.push_back(meanAt(std::min(branch.back().height + step, highest), relief, spring));
  }
  return branch;
}

double repellingShare(std::vector<SpringState>::const_iterator rest,
                      const std::vector<SpringState>& branch, double pressure,
                      const std::vector<ReliefClass>& relief, double range) {
  // the mean traction bears the pressure
  const auto zeroBetween = [&](const SpringState& from, const SpringState& to) {
    const double before = from.traction + pressure;
    const double behind = to.traction + pressure;
    return before < 0.0 && behind > 0.0
               ? from.height + (to.height - from.height) * before / (before - behind)
               : rest->height;
  };
  double height = rest->height;
  if (rest->traction + pressure > 0.0 && rest != branch.begin()) {
    height = zeroBetween(*(rest - 1), *rest);
  } else if (rest + 1 != branch.end()) {
    height = zeroBetween(*rest, *(rest + 1));
  }
  double share = 0.0;
  for (const ReliefClass& one : relief) {
    if (height + one.depth <= kTouching * range) share += one.share;
  }
  return share;
}

std::vector<SpringState>::const_iterator restOf(const std::vector<SpringState>& branch,
                                                double pressure) {
  return std::min_element(branch.begin(), branch.end(),
                          [&](const SpringState& a, const SpringState& b) {
                            return a.energy + pressure * a.height < b.energy + pressure * b.height;
                          });
}

double strengthFrom(std::vector<SpringState>::const_iterator rest,
                    const std::vector<SpringState>& branch) {
  const auto is_weaker = [](const SpringState& a, const SpringState& b) {
    return a.traction < b.traction;
  };
  return std::max_element(rest, branch.end(), is_weaker)->traction;
}

}  // namespace mems_stiction
