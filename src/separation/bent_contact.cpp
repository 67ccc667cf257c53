#include "separation/bent_contact.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace mems_stiction {
namespace {

/// Bending below this share of the law's range changes nothing.
constexpr double kLeastBending = 0.02;
/// From one k to the next, and how many there may be.
constexpr double kNextBed = 2.0;
constexpr int kMostBeds = 60;
/// From one number of summits to the next, and how many there may be.
constexpr double kNextSummits = 1.42;
constexpr int kMostSummits = 64;
/// Steps of the way out, as a share of the law's range.
constexpr double kStep = 0.05;

/// - @p share of the way from one point to the next, in [0, 1]
double between(const std::vector<double>& values, std::size_t from, double share) {
  return values[from] + share * (values[from + 1] - values[from]);
}

struct Place {
  std::size_t from;
  double share;
};
/// Where a height lies among ascending ones; it is within them.
Place placeOf(const std::vector<double>& heights, double height) {
  const auto above = std::upper_bound(heights.begin() + 1, heights.end() - 1, height);
  const auto from = static_cast<std::size_t>(above - heights.begin() - 1);
  return {from, (height - heights[from]) / (heights[from + 1] - heights[from])};
}

}  // namespace

double BentContact::Bed::forceAt(double height) const {
  if (heights.size() < 2 || height >= heights.back()) return 0.0;
  const Place place = placeOf(heights, height);
  return between(forces, place.from, place.share);
}

double BentContact::Bed::energyAt(double height, double area) const {
  if (heights.size() < 2 || height < heights.front()) return std::numeric_limits<double>::infinity();
  if (height >= heights.back()) return area * energy - work_apart;
  const Place place = placeOf(heights, height);
  return area * energy - between(works, place.from, place.share);
}

void BentContact::follow(Bed bed) {
  const GapField& gap = bent(bed);
  curve_.comeToRest(gap, *settings_);
  curve_.part();
  area_ = curve_.frame().area();
  const SeparationCurve& way = curve_.wayOut();
  bed.work_apart = way.work_apart;
  for (auto state = way.states.rbegin(); state != way.states.rend(); ++state) {
    bed.heights.push_back(gap.meanGap() - state->approach);
    bed.forces.push_back(state->partingForce());
  }
  bed.works.assign(bed.heights.size(), way.work_apart);
  for (std::size_t i = bed.works.size(); i-- > 1;) {
    bed.works[i - 1] = bed.works[i] + 0.5 * (bed.forces[i - 1] + bed.forces[i]) * (bed.heights[i] - bed.heights[i - 1]);
  }
  beds_.push_back(std::move(bed));
}

void BentContact::takeRest() {
  at_rest_ = 0;
  double least = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < beds_.size(); ++i) {
    const double height = beds_[i].heights.front();
    const double energy = beds_[i].energyAt(height, area_) + settings_->load.mechanical_load * height;
    if (!(energy < least)) continue;
    least = energy;
    at_rest_ = i;
  }
}

void BentContact::part() {
  parting_ = {};
  const double step = kStep * curve_.frame().law().range();
  const double end = beds_.front().heights.back();
  const double level = field_->meanGap();
  double work = beds_.front().work_apart;
  double last = 0.0;
  std::size_t here = at_rest_;
  for (double height = beds_[here].heights.front(); height < end; height += step) {
    for (bool falls = true; falls;) {
      falls = false;
      const double energy = beds_[here].energyAt(height, area_);
      for (const std::size_t other : nextTo(here)) {
        if (!(beds_[other].energyAt(height, area_) < energy)) continue;
        here = other;
        falls = true;
        break;
      }
    }
    const double force = beds_[here].forceAt(height);
    if (force > parting_.force) {
      parting_.force = force;
      parting_.strongest = here;
    }
    work += 0.5 * step * std::max(0.0, last + force);
    last = force;
    parting_.curve.push_back({level - height, force, true});
  }
  parting_.work = std::min(work / area_, curve_.frame().law().workOfAdhesion());
}

std::vector<std::size_t> BentContact::nextTo(std::size_t bed) const {
  std::vector<std::size_t> next;
  if (bed == first_summits_) {
    next.push_back(0);
  } else if (bed > 0) {
    next.push_back(bed - 1);
  }
  if (bed + 1 < beds_.size() && bed + 1 != first_summits_) next.push_back(bed + 1);
  if (bed == 0 && first_summits_ > 1 && first_summits_ < beds_.size()) next.push_back(first_summits_);
  return next;
}

void BentContact::followBeds() {
  const ContactTraction& law = curve_.frame().law();
  // no contact is stiffer than the law of all places at once, and none gives more than its work
  double stiffness = law.strength() / law.range();
  for (int i = 0; i < kMostBeds; ++i, stiffness /= kNextBed) {
    bending_.bent(stiffness);
    if (bending_.rmsBending() < kLeastBending * law.range()) break;
    if (bending_.energy() < law.workOfAdhesion()) {
      Bed bed;
      bed.stiffness = stiffness;
      bed.energy = bending_.energy();
      bed.bending = bending_.blocks().clone();
      follow(std::move(bed));
    }
  }
  std::reverse(beds_.begin() + 1, beds_.end());
  first_summits_ = beds_.size();
}

void BentContact::followSummits() {
  SummitBending summits = bending_.onSummits();
  int next = 2;
  while (summits.count() < kMostSummits && summits.addSummit()) {
    if (summits.count() < next) continue;
    if (summits.energy() > curve_.frame().law().workOfAdhesion()) break;
    next = std::max(next + 1, static_cast<int>(next * kNextSummits));
    Bed bed;
    bed.energy = summits.energy();
    bed.bending = summits.bending().clone();
    follow(std::move(bed));
  }
}

const GapField& BentContact::solve(const GapField& field, const ContactSettings& settings) {
  field_ = &field;
  settings_ = &settings;
  beds_.clear();
  bending_.start(field, WaveStiffness(settings.lower, settings.upper));
  follow({});
  followBeds();
  if (first_summits_ > 1) followSummits();
  takeRest();
  if (!isStiff()) part();
  return bent(beds_[at_rest_]);
}

}  // namespace mems_stiction
