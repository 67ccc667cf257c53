#include "separation/plate_bending.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

#include <opencv2/imgproc.hpp>

#include "numeric/constants.hpp"
#include "separation/chosen_constants.hpp"

namespace mems_stiction {
namespace {

double thinner(const WaveStiffness& stiffness) {
  double thickness = std::numeric_limits<double>::infinity();
  for (const LayerCompliance* body : {&stiffness.lower(), &stiffness.upper()}) {
    if (!body->isThick()) thickness = std::min(thickness, body->thickness());
  }
  return thickness;
}

double meanSquare(const cv::Mat1d& heights) { return heights.dot(heights) / static_cast<double>(heights.total()); }

/// The plane through the relief of least squares, at every cell.
void meanPlane(const GapField& field, std::vector<double>& line, cv::Mat1d& plane) {
  cv::Matx33d products = cv::Matx33d::zeros();
  cv::Vec3d sums = cv::Vec3d::all(0.0);
  const auto placeOf = [&](int row, int col) {
    return cv::Vec3d(1.0, (col + 0.5) / field.cols() - 0.5, (row + 0.5) / field.rows() - 0.5);
  };
  line.resize(static_cast<std::size_t>(field.cols()));
  for (int row = 0; row < field.rows(); ++row) {
    field.gapsOfRow(row, line.data());
    for (int col = 0; col < field.cols(); ++col) {
      const double gap = line[static_cast<std::size_t>(col)];
      if (!(gap <= field.largestGap())) continue;
      const cv::Vec3d place = placeOf(row, col);
      products += place * place.t();
      sums += (field.meanGap() - gap) * place;
    }
  }
  // a frame of one row or column, or with few cells, has no slope there
  for (int i = 0; i < 3; ++i) products(i, i) += 1e-9 * products(0, 0);
  const cv::Vec3d fit = products.solve(sums, cv::DECOMP_LU);
  plane.create(field.rows(), field.cols());
  for (int row = 0; row < field.rows(); ++row) {
    for (int col = 0; col < field.cols(); ++col) plane(row, col) = fit.dot(placeOf(row, col));
  }
}

}  // namespace

void PlateBending::start(const GapField& field, const WaveStiffness& stiffness) {
  field_ = &field;
  const double width = field.cols() * field.pitchX();
  const double height = field.rows() * field.pitchY();
  const double shortest = kPi * std::hypot(1.0 / field.pitchX(), 1.0 / field.pitchY());
  compliance_ = ExtraCompliance(stiffness, 0.5 * kPi / std::max(width, height), 2.0 * shortest);
  const double longest_block = thinner(stiffness) / chosen::kBlocksPerThickness;
  relief_.take(field, longest_block, true);
  if (!relief_.repeats()) {
    std::vector<double> line;
    meanPlane(field, line, bending_);
    level_.lower(field, bending_);
    relief_.take(level_, longest_block, true);
  }
  roots_ = relief_.filterOf([this](double q) { return std::sqrt(compliance_.at(q)); });
}

const GapField& PlateBending::lowerBy(const GapField& field, const cv::Mat1d& blocks, GapField& gap) {
  cv::resize(blocks, bending_, {field.cols(), field.rows()}, 0.0, 0.0, cv::INTER_LINEAR);
  gap.lower(field, bending_);
  return gap;
}

const GapField& PlateBending::bentBy(const GapField& field, const cv::Mat1d& blocks) {
  return lowerBy(field, blocks, bent_);
}

const GapField& PlateBending::closed() {
  const auto yield = [this](double q) { return 0.5 * compliance_.contactModulus() * q * compliance_.at(q); };
  energy_ = 0.5 * meanSquare(relief_.weighed([&](double q) {
              return 0.5 * compliance_.contactModulus() * q * std::sqrt(compliance_.at(q)) / (1.0 + yield(q));
            }));
  const cv::Mat1d& conforming = relief_.weighed([&](double q) { return yield(q) / (1.0 + yield(q)); });
  return lowerBy(*field_, conforming(cv::Rect({0, 0}, relief_.blocks())), closed_);
}

}  // namespace mems_stiction
