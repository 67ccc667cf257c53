#include "separation/closing_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "numeric/constants.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// First of the cells that are the part `index` of `parts`.
int firstOf(int index, int parts, int cells) {
  return static_cast<int>(static_cast<std::int64_t>(index) * cells / parts);
}

/// Into how many a side is divided that is to be divided into `divisions`: blocks have kPlaceCells
/// cells or more.
int partsOf(int cells, int divisions) {
  return std::clamp(cells / chosen::kPlaceCells, 1, divisions);
}

/// Lines that tell the flattening energy: the same as of the whole frame.
void chooseLines(int count, std::vector<int>& lines) {
  const int step = std::max(1, count / chosen::kLines);
  lines.clear();
  for (int line = step / 2; line < count; line += step) lines.push_back(line);
}

}  // namespace

double ClosingPlaces::force(const GapField& field, const ContactTraction& law,
                            double contact_modulus, const SeparationCurve& curve, double least) {
  if (!law.attracts()) return 0.0;
  start(field, contact_modulus);
  law_ = &law;
  way_.clear();
  auto first = curve.firstPushing();
  if (first != curve.states.begin()) --first;
  for (; first != curve.states.end(); ++first) way_.push_back(&*first);
  double largest = 0.0;
  for (int divisions = 2; divisions <= chosen::kPlacesPerSide; divisions *= 2) {
    takePlaces(divisions);
    onlyNear(curve.rest().approach);
    if (!(largestForce() > std::max(largest, least))) continue;
    for (Place& place : places_) measureEnergy(place);
    largest = std::max(largest, largestForce());
  }
  return largest > least ? largest : 0.0;
}

double ClosingPlaces::largestEnergy(const GapField& field, double contact_modulus) {
  start(field, contact_modulus);
  takePlaces(2);
  double largest = 0.0;
  for (Place& place : places_) {
    measureEnergy(place);
    largest = std::max(largest, place.energy);
  }
  return largest;
}

void ClosingPlaces::start(const GapField& field, double contact_modulus) {
  field_ = &field;
  contact_modulus_ = contact_modulus;
  columns_.clear();
  readRows();
}

void ClosingPlaces::readRows() {
  const auto cols = static_cast<std::size_t>(field_->cols());
  chooseLines(field_->rows(), row_of_line_);
  rows_.resize(row_of_line_.size() * cols);
  for (std::size_t i = 0; i < row_of_line_.size(); ++i)
    field_->gapsOfRow(row_of_line_[i], rows_.data() + i * cols);
  sumRows();
}

void ClosingPlaces::sumRows() {
  const auto cols = static_cast<std::size_t>(field_->cols());
  sums_before_.resize(row_of_line_.size() * (cols + 1));
  for (std::size_t line = 0; line < row_of_line_.size(); ++line) {
    const double* gaps = rows_.data() + line * cols;
    GapSum* before = sums_before_.data() + line * (cols + 1);
    GapSum sum;
    for (std::size_t col = 0; col < cols; ++col) {
      before[col] = sum;
      const bool is_known = gaps[col] <= field_->largestGap();
      sum.cells += is_known ? 1.0 : 0.0;
      sum.gaps += is_known ? gaps[col] : 0.0;
    }
    before[cols] = sum;
  }
}

void ClosingPlaces::readColumns() {
  const int rows = field_->rows();
  const int cols = field_->cols();
  chooseLines(cols, col_of_line_);
  columns_.resize(col_of_line_.size() * static_cast<std::size_t>(rows));
  field_->readGaps([&](const auto& gaps) {
    for (int row = 0; row < rows; ++row) {
      const std::ptrdiff_t first = static_cast<std::ptrdiff_t>(row) * cols;
      for (std::size_t i = 0; i < col_of_line_.size(); ++i) {
        columns_[i * static_cast<std::size_t>(rows) + static_cast<std::size_t>(row)] =
            gaps[first + col_of_line_[i]];
      }
    }
  });
}

void ClosingPlaces::takePlaces(int divisions) {
  const int down = partsOf(field_->rows(), divisions);
  const int along = partsOf(field_->cols(), divisions);
  places_.clear();
  if (std::max(down, along) < divisions) return;  // they have been looked at
  for (int i = 0; i < down; ++i) {
    for (int j = 0; j < along; ++j) {
      Place place;
      place.rows = {firstOf(i, down, field_->rows()), firstOf(i + 1, down, field_->rows())};
      place.cols = {firstOf(j, along, field_->cols()), firstOf(j + 1, along, field_->cols())};
      int lines = 0;
      GapSum sum;
      for (std::size_t line = 0; line < row_of_line_.size(); ++line) {
        if (row_of_line_[line] < place.rows.from || row_of_line_[line] >= place.rows.to) continue;
        ++lines;
        const GapSum* before =
            sums_before_.data() + line * (static_cast<std::size_t>(field_->cols()) + 1);
        sum.cells += before[place.cols.to].cells - before[place.cols.from].cells;
        sum.gaps += before[place.cols.to].gaps - before[place.cols.from].gaps;
      }
      if (!(sum.cells > 0.0)) continue;
      place.mean_gap = sum.gaps / sum.cells;
      place.area = sum.cells / lines * place.rows.length() * field_->cellArea();
      places_.push_back(place);
    }
  }
}

void ClosingPlaces::onlyNear(double nearest) {
  const auto isFar = [&](const Place& place) {
    return !(drawingEnergy(place, std::max(0.0, place.mean_gap - nearest)) <
             law_->workOfAdhesion());
  };
  places_.erase(std::remove_if(places_.begin(), places_.end(), isFar), places_.end());
}

double ClosingPlaces::drawingEnergy(const Place& place, double distance) const {
  return contact_modulus_ * distance * distance / std::sqrt(kPi * place.area);
}

// (S9), the same sums
void ClosingPlaces::measureEnergy(Place& place) {
  if (columns_.empty()) readColumns();
  along_rows_.start(place.cols.length());
  along_columns_.start(place.rows.length());
  for (std::size_t line = 0; line < row_of_line_.size(); ++line) {
    if (row_of_line_[line] < place.rows.from || row_of_line_[line] >= place.rows.to) continue;
    along_rows_.add(rows_.data() + line * static_cast<std::size_t>(field_->cols()) +
                    place.cols.from);
  }
  for (std::size_t line = 0; line < col_of_line_.size(); ++line) {
    if (col_of_line_[line] < place.cols.from || col_of_line_[line] >= place.cols.to) continue;
    along_columns_.add(columns_.data() + line * static_cast<std::size_t>(field_->rows()) +
                       place.rows.from);
  }
  const int directions = (place.cols.length() > 1 ? 1 : 0) + (place.rows.length() > 1 ? 1 : 0);
  const double both =
      along_rows_.integral(field_->pitchX()) + along_columns_.integral(field_->pitchY());
  place.energy = directions > 0 ? 0.25 * contact_modulus_ * both / directions : 0.0;
}

double ClosingPlaces::largestForce() const {
  double largest = 0.0;
  for (const SeparationState* state : way_) {
    largest = std::max(largest, forceAt(state->approach) + std::min(0.0, state->givenForce()));
  }
  return largest;
}

// (S9a), (S9b)
double ClosingPlaces::forceAt(double approach) const {
  double sum = 0.0;
  for (const Place& place : places_) {
    const double distance = place.mean_gap - approach;
    if (!(distance > 0.0)) continue;
    if (!(place.energy + drawingEnergy(place, distance) < law_->workOfAdhesion())) continue;
    const double pull = 2.0 * contact_modulus_ * distance * std::sqrt(place.area / kPi);
    sum += std::min(pull, law_->strength() * place.area);
  }
  return sum;
}

}  // namespace mems_stiction
