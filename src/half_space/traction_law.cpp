#include "half_space/traction_law.hpp"

#include <algorithm>
#include <cmath>

#include "numeric/packet.hpp"

namespace mems_stiction {
namespace {

/// Closest gap of a law without a hardness, of z0: there it repels with 1300 times 8 Gamma/(3 z0).
constexpr double kClosestGap = 0.45;
/// Width over which the water's pressure sets in, of z0.
constexpr double kWaterFront = 0.25;

}  // namespace

std::vector<std::string> TractionLawOptions::validate() const {
  std::vector<std::string> violations;
  const auto require = [&](bool is_met, const std::string& name, double value,
                           const std::string& allowed) {
    if (!is_met)
      violations.push_back(name + ": " + numberText(value) + " is not allowed, must be " + allowed);
  };
  const Range positive = Range::positive();
  require(positive.contains(work_of_adhesion), "interface/work_of_adhesion", work_of_adhesion,
          "> 0 J/m^2 for a traction between the surfaces");
  require(Range::nonNegative().contains(range), "half_space/range", range, ">= 0 m");
  if (range == 0.0) {
    require(positive.contains(hamaker_constant), "interface/hamaker_constant", hamaker_constant,
            "> 0 J where half_space/range is 0");
  }
  require(hardness > 0.0, "hardness", hardness, "> 0 Pa");
  require(Range::any().contains(voltage), "load/voltage", voltage, "finite");
  if (voltage != 0.0) {
    require(positive.contains(insulator_thickness), "interface/insulator_thickness",
            insulator_thickness, "> 0 m when voltage or contact potential is not 0");
    require(insulator_relative_permittivity >= 1.0, "interface/insulator_relative_permittivity",
            insulator_relative_permittivity, ">= 1");
  }
  const std::vector<std::string> of_water = rangeViolations(water);
  violations.insert(violations.end(), of_water.begin(), of_water.end());
  return violations;
}

AdhesionLaw TractionLawOptions::adhesion() const {
  // where the range is stated, it tells the constant
  const LayeredAttraction attraction(hamaker_constant > 0.0 ? hamaker_constant : 1.0, lower, upper,
                                     retardation_length);
  return {work_of_adhesion,
          range > 0.0 ? range : AdhesionLaw::rangeOf(work_of_adhesion, attraction), attraction};
}

TractionLaw::TractionLaw(const TractionLawOptions& options)
    : law_(options.adhesion()),
      attracts_(options.attracts),
      closest_gap_(kClosestGap * range()),
      contact_gap_(range()),
      field_(options.voltage, options.insulator_thickness, options.insulator_relative_permittivity),
      water_(options.water.law()) {
  const Point closest = at(closest_gap_);
  const double narrowest = closest_gap_;
  slope_of_line_ = closest.slope;
  closest_traction_ = closest.traction;
  contact_gap_ = gapOfPressure(0.0, narrowest);
  if (-closest.traction <= options.hardness) return;
  flows_ = true;
  slope_of_line_ = 0.0;
  closest_gap_ = gapOfPressure(options.hardness, narrowest);
  closest_traction_ = at(closest_gap_).traction;
}

TractionLaw TractionLaw::steepUpTo(double pressure) const {
  TractionLaw law(*this);
  if (flows_ || -closest_traction_ <= pressure) return law;
  law.closest_gap_ = gapOfPressure(pressure, closest_gap_);
  const Point closest = at(law.closest_gap_);
  law.closest_traction_ = closest.traction;
  law.slope_of_line_ = closest.slope;
  return law;
}

double TractionLaw::gapOfPressure(double pressure, double narrow) const {
  // t rises without a turn as far as z0: bisection to the last bit
  double wide = range();
  while (true) {
    const double middle = 0.5 * (narrow + wide);
    if (middle <= narrow || middle >= wide) return wide;
    (-at(middle).traction > pressure ? narrow : wide) = middle;
  }
}

double TractionLaw::narrowestGap() const { return kClosestGap * range(); }

double TractionLaw::reach() const {
  return range() * (water_.isOn() ? 1.0 + kWaterFront : 1.0) + water_.gapLimit();
}

TractionLaw::Point TractionLaw::at(double gap) const {
  Point point{};
  atRow(1, &gap, &point.traction, &point.slope, &point.energy);
  return point;
}

void TractionLaw::atRow(int count, const double* gaps, double* traction, double* slope,
                        double* energy) const {
  const double smallest = nineThree(count, gaps, traction, slope, energy);
  if (law_.hasTail() && attracts_) addTail(count, gaps, traction, slope, energy);
  if (field_.isOn() || water_.isOn()) addField(count, gaps, traction, slope, energy);
  if (smallest >= closest_gap_) return;
  for (int i = 0; i < count; ++i) {
    const double excess = closest_gap_ - gaps[i];
    if (excess <= 0.0) continue;
    energy[i] += excess * (0.5 * slope_of_line_ * excess - traction[i]);
    traction[i] -= slope_of_line_ * excess;
    slope[i] = slope_of_line_;
  }
}

MEMS_STICTION_VECTORIZED double TractionLaw::nineThree(int count, const double* gaps,
                                                       double* traction, double* slope,
                                                       double* energy) const {
  const Packet closest(closest_gap_);
  const AdhesionLaw law = law_;
  const double energy_at_range = law.energy(1.0);
  Packet smallest = closest;
  Packet t, dt, e;
  const auto evaluate = [&](const Packet& gap) __attribute__((always_inline)) {
    smallest = select(gap < smallest, gap, smallest);
    Packet x = law.range() / select(gap > closest, gap, closest);
    const PacketMask repels = x > 1.0;
    if (!attracts_) x = select(repels, x, 1.0);
    t = law.traction(x);
    dt = law.slope(x);
    e = 0.0 - law.energy(x);
    if (attracts_) return;
    dt = select(repels, dt, 0.0);
    e += energy_at_range;
  };
  const auto size = static_cast<std::size_t>(count);
  std::size_t i = 0;
  for (; i + Packet::kCount <= size; i += Packet::kCount) {
    evaluate(Packet::load(gaps + i));
    t.store(traction + i);
    dt.store(slope + i);
    e.store(energy + i);
  }
  if (i < size) {
    const std::size_t rest = size - i;
    evaluate(Packet::loadFirst(gaps + i, rest, range()));
    t.storeFirst(rest, traction + i);
    dt.storeFirst(rest, slope + i);
    e.storeFirst(rest, energy + i);
  }
  return smallest.smallest();
}

MEMS_STICTION_VECTORIZED void TractionLaw::addTail(int count, const double* gaps, double* traction,
                                                   double* slope, double* energy) const {
  const LayeredAttraction tail = law_.tail();
  const Packet closest(closest_gap_);
  const Packet infinity(std::numeric_limits<double>::infinity());
  const auto size = static_cast<std::size_t>(count);
  for (std::size_t i = 0; i < size; i += Packet::kCount) {
    const std::size_t left = std::min(size - i, Packet::kCount);
    const auto load = [&](const double* from) __attribute__((always_inline)) {
      return left == Packet::kCount ? Packet::load(from + i)
                                    : Packet::loadFirst(from + i, left, range());
    };
    const auto add = [&](const Packet& more, double* to) __attribute__((always_inline)) {
      const Packet sum = load(to) + more;
      left == Packet::kCount ? sum.store(to + i) : sum.storeFirst(left, to + i);
    };
    const Packet gap = load(gaps);
    const PacketMask is_finite = gap < infinity;
    const auto here =
        tail.at(select(is_finite, select(gap > closest, gap, closest), Packet(range())));
    add(select(is_finite, here.traction, 0.0), traction);
    add(select(is_finite, here.slope, 0.0), slope);
    add(select(is_finite, 0.0 - here.energy, 0.0), energy);
  }
}

void TractionLaw::addField(int count, const double* gaps, double* traction, double* slope,
                           double* energy) const {
  const double front = kWaterFront * range();
  for (int i = 0; i < count; ++i) {
    if (!std::isfinite(gaps[i])) continue;
    const double gap = std::max(gaps[i], closest_gap_);
    if (field_.isOn()) {
      traction[i] += field_.pressure(gap);
      slope[i] += field_.slope(gap);
      energy[i] -= field_.energy(gap);
    }
    if (water_.isOn()) {
      const WaterLaw::Smeared water = water_.smeared(gap, range(), front);
      traction[i] += water.pressure;
      slope[i] += water.slope;
      energy[i] -= water.energy;
    }
  }
}

}  // namespace mems_stiction
