#include "half_space/cell_influence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <initializer_list>

#include "numeric/constants.hpp"

namespace mems_stiction {
namespace {

/// X - 1 is 0 from here on.
constexpr double kLargestWave = 22.0;
/// Panels of waves, each with the nodes below: at most 2.5 rad of J0 a panel.
constexpr int kPanels = 440;
/// Distances at which h is worked out, even in asinh of them, up to the farthest one; beyond it the
/// series in 1/y holds.
constexpr int kDistances = 256;
constexpr double kFarthest = 50.0;

struct Node {
  double place;
  double weight;
};
/// Gauss and Legendre's on [-1, 1].
constexpr std::array<Node, 5> kFive = {{{0.0, 0.5688888888888889},
                                        {0.5384693101056831, 0.47862867049936647},
                                        {-0.5384693101056831, 0.47862867049936647},
                                        {0.9061798459386640, 0.23692688505618908},
                                        {-0.9061798459386640, 0.23692688505618908}}};
constexpr std::array<Node, 3> kThree = {{{0.0, 0.8888888888888889},
                                         {0.7745966692414834, 0.5555555555555556},
                                         {-0.7745966692414834, 0.5555555555555556}}};

/// Integral of 1/r over the quarter between the axes and (x, y), seen from the origin, signed [m].
double cornerIntegral(double x, double y) {
  const double r = std::hypot(x, y);
  // asinh keeps its digits where r and the other coordinate nearly cancel
  const double along_x = y != 0.0 ? y * std::asinh(x / std::abs(y)) : 0.0;
  const double along_y = x != 0.0 ? x * std::asinh(y / std::abs(x)) : 0.0;
  return r > 0.0 ? along_x + along_y : 0.0;
}

/// Displacement [m] at a distance (x, y) from the middle of a cell under 1 Pa.
double loveInfluence(double x, double y, double pitch_x, double pitch_y, double contact_modulus) {
  const double left = x - 0.5 * pitch_x;
  const double right = x + 0.5 * pitch_x;
  const double below = y - 0.5 * pitch_y;
  const double above = y + 0.5 * pitch_y;
  const double integral = cornerIntegral(right, above) - cornerIntegral(left, above) -
                          cornerIntegral(right, below) + cornerIntegral(left, below);
  return integral / (kPi * contact_modulus);
}

}  // namespace

CellInfluence::CellInfluence(double contact_modulus, const WaveStiffness* layers, double pitch_x,
                             double pitch_y)
    : contact_modulus_(contact_modulus), pitch_x_(pitch_x), pitch_y_(pitch_y) {
  if (layers == nullptr) return;
  addFilm(layers->lower(), films_);
  addFilm(layers->upper(), films_);
}

void CellInfluence::addFilm(const LayerCompliance& layer, std::vector<Film>& films) {
  if (layer.isThick()) return;
  const double t = layer.thickness();
  Film film{layer.planeCompliance() / (kPi * t), t, layer.ratio(0.0) - 1.0, 0.0, {}};
  std::vector<Node> waves;
  const double half_width = 0.5 * kLargestWave / kPanels;
  for (int panel = 0; panel < kPanels; ++panel) {
    for (const Node& node : kFive) {
      const double s = (2.0 * panel + 1.0 + node.place) * half_width;
      waves.push_back({s, node.weight * half_width * (layer.ratio(s / t) - 1.0)});
    }
  }
  // two more than kFarthest needs, for the interpolation
  for (int i = 0; i < kDistances + 2; ++i) {
    const double distance = std::sinh(i * std::asinh(kFarthest) / (kDistances - 1));
    double sum = 0.0;
    for (const Node& wave : waves) sum += wave.weight * ::j0(wave.place * distance);
    film.values.push_back(sum);
  }
  film.next =
      (film.values[kDistances - 1] - film.far / kFarthest) * kFarthest * kFarthest * kFarthest;
  films.push_back(std::move(film));
}

double CellInfluence::Film::at(double distance) const {
  const double y = distance / thickness;
  if (y >= kFarthest) return factor * (far + next / (y * y)) / y;
  static const double kSteps = (kDistances - 1) / std::asinh(kFarthest);
  const double place = std::asinh(y) * kSteps;
  const int first = static_cast<int>(place);
  const double x = place - first;
  const auto value = [&](int i) {
    return values[static_cast<std::size_t>(std::abs(first + i))];
  };  // h is even
  // the cubic through four values
  return factor * (x * (x - 1.0) * ((x + 1.0) * value(2) - (x - 2.0) * value(-1)) / 6.0 +
                   (x + 1.0) * (x - 2.0) * ((x - 1.0) * value(0) - x * value(1)) / 2.0);
}

double CellInfluence::ofFilm(const Film& film, double x, double y) const {
  // as many parts of the cell as it takes for h to be a polynomial of the fifth degree in each
  const double pitch = std::max(pitch_x_, pitch_y_);
  const double distance = std::max(0.0, std::hypot(x, y) - pitch);
  const int parts =
      static_cast<int>(std::ceil(2.0 * pitch / std::hypot(distance, 2.0 * film.thickness)));
  const double width = pitch_x_ / parts;
  const double height = pitch_y_ / parts;
  double sum = 0.0;
  for (int i = 0; i < parts; ++i) {
    for (int j = 0; j < parts; ++j) {
      const double x_here = x + (j + 0.5) * width - 0.5 * pitch_x_;
      const double y_here = y + (i + 0.5) * height - 0.5 * pitch_y_;
      for (const Node& of_x : kThree) {
        for (const Node& of_y : kThree) {
          sum += of_x.weight * of_y.weight *
                 film.at(std::hypot(x_here + 0.5 * width * of_x.place,
                                    y_here + 0.5 * height * of_y.place));
        }
      }
    }
  }
  return 0.25 * width * height * sum;
}

double CellInfluence::at(int row, int col) const {
  const double x = col * pitch_x_;
  const double y = row * pitch_y_;
  double sum = loveInfluence(x, y, pitch_x_, pitch_y_, contact_modulus_);
  for (const Film& film : films_) sum += ofFilm(film, x, y);
  return sum;
}

}  // namespace mems_stiction
