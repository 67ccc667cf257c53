#include "verdict/bent_beam.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace mems_stiction {
namespace {

constexpr int kPolynomials = 12;
constexpr int kPlaces = 200;            // along a beam, for where it lands
constexpr int kCellsOfElectrode = 250;  // the gap is linear within each
constexpr int kCellsOfShape = 100;      // of three points each, for integrals of the shapes

/// A function of xi with its first two derivatives.
struct Jet {
  double value = 0.0;
  double slope = 0.0;
  double curvature = 0.0;
};

Jet operator*(const Jet& a, const Jet& b) {
  return {a.value * b.value, a.slope * b.value + a.value * b.slope,
          a.curvature * b.value + 2.0 * a.slope * b.slope + a.value * b.curvature};
}

Jet combined(double of_a, const Jet& a, double of_b, const Jet& b) {
  return {of_a * a.value + of_b * b.value, of_a * a.slope + of_b * b.slope,
          of_a * a.curvature + of_b * b.curvature};
}

bool endsOnSubstrate(BeamEnd end) { return end == BeamEnd::kResting || end == BeamEnd::kGuided; }

int shapeCount(BeamEnd end) { return kPolynomials + (endsOnSubstrate(end) ? 1 : 0); }

/// Legendre's polynomials times what meets the conditions at the ends.
std::array<Jet, kPolynomials + 1> shapesOf(BeamEnd end, double place) {
  const Jet xi{place, 1.0, 0.0};
  const Jet rest{1.0 - place, -1.0, 0.0};
  const Jet square = xi * xi;
  Jet factor = square;
  if (end != BeamEnd::kFree) factor = factor * rest;
  if (end == BeamEnd::kClamped || end == BeamEnd::kGuided) factor = factor * rest;
  std::array<Jet, kPolynomials + 1> shapes;
  std::size_t next = 0;
  if (end == BeamEnd::kResting) shapes[next++] = square * combined(-0.5, xi, 1.5, {1.0, 0.0, 0.0});
  if (end == BeamEnd::kGuided) shapes[next++] = square * combined(-2.0, xi, 3.0, {1.0, 0.0, 0.0});
  const Jet t = combined(1.0, xi, -1.0, rest);
  Jet before;
  Jet legendre{1.0, 0.0, 0.0};
  for (int i = 0; i < kPolynomials; ++i) {
    shapes[next++] = factor * legendre;
    const Jet after = combined((2.0 * i + 1.0) / (i + 1.0), t * legendre, -i / (i + 1.0), before);
    before = legendre;
    legendre = after;
  }
  return shapes;
}

/// What does not depend on sizes: integrals over xi, and values at the places.
struct Reference {
  Eigen::MatrixXd curvatures;
  Eigen::MatrixXd slopes;
  Eigen::MatrixXd places;
};

Reference referenceOf(BeamEnd end) {
  const int count = shapeCount(end);
  Reference reference{Eigen::MatrixXd::Zero(count, count), Eigen::MatrixXd::Zero(count, count),
                      Eigen::MatrixXd(kPlaces + 1, count)};
  const double off = std::sqrt(0.15);  // Gauss's three points and their weights
  const std::array<std::array<double, 2>, 3> points{
      {{0.5 - off, 5.0 / 18.0}, {0.5, 8.0 / 18.0}, {0.5 + off, 5.0 / 18.0}}};
  Eigen::VectorXd slope(count);
  Eigen::VectorXd curvature(count);
  for (int cell = 0; cell < kCellsOfShape; ++cell) {
    for (const auto& [place, weight] : points) {
      const auto shapes = shapesOf(end, (cell + place) / kCellsOfShape);
      for (int i = 0; i < count; ++i) {
        slope(i) = shapes[static_cast<std::size_t>(i)].slope;
        curvature(i) = shapes[static_cast<std::size_t>(i)].curvature;
      }
      reference.slopes += weight / kCellsOfShape * slope * slope.transpose();
      reference.curvatures += weight / kCellsOfShape * curvature * curvature.transpose();
    }
  }
  for (int place = 0; place <= kPlaces; ++place) {
    const auto shapes = shapesOf(end, static_cast<double>(place) / kPlaces);
    for (int i = 0; i < count; ++i)
      reference.places(place, i) = shapes[static_cast<std::size_t>(i)].value;
  }
  return reference;
}

const Reference& referenceFor(BeamEnd end) {
  static const std::array<Reference, 4> references{
      referenceOf(BeamEnd::kFree), referenceOf(BeamEnd::kClamped), referenceOf(BeamEnd::kResting),
      referenceOf(BeamEnd::kGuided)};
  return references[static_cast<std::size_t>(end)];
}

}  // namespace

BentBeam::BentBeam(const Beam& beam, double length, BeamEnd end, double from, double to,
                   double rest_gap, bool is_stretched)
    : length_(length),
      rest_gap_(rest_gap),
      section_(is_stretched ? beam.width * beam.thickness : 0.0),
      stress_(beam.residual_stress),
      modulus_(beam.modulus),
      bending_(beam.modulus * beam.width * std::pow(beam.thickness / length, 3) / 12.0 *
               referenceFor(end).curvatures),
      slopes_(referenceFor(end).slopes / length),
      end_(end) {
  const double first = std::clamp(from, 0.0, length);
  const double last = std::clamp(to, 0.0, length);
  if (!(last > first)) return;
  cell_ = (last - first) / kCellsOfElectrode;
  const int count = shapeCount(end);
  edges_.resize(kCellsOfElectrode + 1, count);
  middles_.resize(kCellsOfElectrode, count);
  spread_.resize(kCellsOfElectrode, count);
  for (int edge = 0; edge <= kCellsOfElectrode; ++edge) {
    const auto at_edge = shapesOf(end, (first + edge * cell_) / length);
    for (int i = 0; i < count; ++i) edges_(edge, i) = at_edge[static_cast<std::size_t>(i)].value;
    if (edge == kCellsOfElectrode) break;
    const double xi = (first + (edge + 0.5) * cell_) / length;
    const auto in_middle = shapesOf(end, xi);
    for (int i = 0; i < count; ++i) {
      middles_(edge, i) = in_middle[static_cast<std::size_t>(i)].value;
      spread_(edge, i) = xi * in_middle[static_cast<std::size_t>(i)].slope;
    }
  }
}

double BentBeam::tension(const Vector& bent) const {
  return section_ * (stress_ + 0.5 * modulus_ / length_ * bent.dot(slopes_ * bent));
}

BentBeam::Vector BentBeam::resistance(const Vector& bent) const {
  return bending_ * bent + tension(bent) * (slopes_ * bent);
}

BentBeam::Matrix BentBeam::stiffness(const Vector& bent) const {
  const Vector slant = slopes_ * bent;
  return bending_ + tension(bent) * slopes_ +
         modulus_ * section_ / length_ * slant * slant.transpose();
}

double BentBeam::release(const Vector& bent) const {
  const double strain = 0.5 / length_ * bent.dot(slopes_ * bent);
  return 1.5 / length_ * bent.dot(bending_ * bent) +
         section_ * strain * (stress_ + 1.5 * modulus_ * strain);
}

bool BentBeam::fieldOf(const Vector& bent, Field& field) const {
  const Eigen::ArrayXd gap = rest_gap_ - (edges_ * bent).array();
  if (!(gap.minCoeff() > 0.0)) return false;
  const auto here = gap.head(kCellsOfElectrode);
  const auto next = gap.tail(kCellsOfElectrode);
  const Eigen::ArrayXd square = cell_ / (here * next);                 // integral of 1/d^2
  const Eigen::ArrayXd cube = square * (here + next) / (here * next);  // twice that of 1/d^3
  field.pull = middles_.transpose() * square.matrix();
  field.slope = middles_.transpose() * cube.matrix().asDiagonal() * middles_;
  field.growth = (spread_ * bent).dot(square.matrix()) / length_;
  return true;
}

BentBeam::Vector BentBeam::deflections(const Vector& bent) const {
  return referenceFor(end_).places * bent;
}

BentBeam::Vector BentBeam::shapesAt(int place) const {
  return referenceFor(end_).places.row(place).transpose();
}

}  // namespace mems_stiction
