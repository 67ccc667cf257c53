#include "separation/closing_places.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "numeric/constants.hpp"
#include "numeric/packet.hpp"
#include "numeric/vectorized.hpp"

#include "chosen_constants.hpp"

namespace mems_stiction {
namespace {

/// First of the cells that are the part `index` of `parts`.
int firstOf(int index, int parts, int cells) {
  return static_cast<int>(static_cast<std::int64_t>(index) * cells / parts);
}

/// Into how many a side is divided that is to be divided into `divisions`, a power of two: blocks
/// have kPlaceCells cells or more.
int partsOf(int cells, int divisions) {
  int parts = 1;
  while (2 * parts <= divisions && 2 * parts * chosen::kPlaceCells <= cells) parts *= 2;
  return parts;
}

/// Lines that tell the flattening energy: the same as of the whole frame.
void chooseLines(int count, std::vector<int>& lines) {
  const int step = std::max(1, count / chosen::kLines);
  lines.clear();
  for (int line = step / 2; line < count; line += step) lines.push_back(line);
}

/// How many gaps are known, no larger than this, and their sum.
MEMS_STICTION_VECTORIZED void addKnown(const double* gaps, std::size_t count, double largest,
                                       double& known, double& sum) {
  Packet knowns = 0.0;
  Packet sums = 0.0;
  std::size_t i = 0;
  for (; i + Packet::kCount <= count; i += Packet::kCount) {
    const Packet gap = Packet::load(gaps + i);
    const PacketMask is_unknown = gap > largest;
    knowns += select(is_unknown, Packet(0.0), Packet(1.0));
    sums += select(is_unknown, Packet(0.0), gap);
  }
  for (; i < count; ++i) {
    if (gaps[i] > largest) continue;
    known += 1.0;
    sum += gaps[i];
  }
  known += knowns.sum();
  sum += sums.sum();
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
  sumBlocks();
}

void ClosingPlaces::sumBlocks() {
  const int rows = field_->rows();
  const int cols = field_->cols();
  down_ = partsOf(rows, chosen::kPlacesPerSide);
  along_ = partsOf(cols, chosen::kPlacesPerSide);
  blocks_.assign(static_cast<std::size_t>(down_) * static_cast<std::size_t>(along_), {});
  int i = 0;
  for (std::size_t line = 0; line < row_of_line_.size(); ++line) {
    while (row_of_line_[line] >= firstOf(i + 1, down_, rows)) ++i;
    const double* gaps = rows_.data() + line * static_cast<std::size_t>(cols);
    for (int j = 0; j < along_; ++j) {
      GapSum& block = blocks_[blockAt(i, j)];
      const int from = firstOf(j, along_, cols);
      const auto count = static_cast<std::size_t>(firstOf(j + 1, along_, cols) - from);
      block.cells += static_cast<double>(count);
      addKnown(gaps + from, count, field_->largestGap(), block.known, block.gaps);
    }
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
      GapSum sum;
      for (int k = i * down_ / down; k < (i + 1) * down_ / down; ++k) {
        for (int l = j * along_ / along; l < (j + 1) * along_ / along; ++l) {
          const GapSum& block = blocks_[blockAt(k, l)];
          sum.cells += block.cells;
          sum.known += block.known;
          sum.gaps += block.gaps;
        }
      }
      if (!(sum.known > 0.0)) continue;
      place.mean_gap = sum.gaps / sum.known;
      place.area =
          sum.known / sum.cells * place.rows.length() * place.cols.length() * field_->cellArea();
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
  structure_.start(place.rows.length(), place.cols.length());
  for (std::size_t line = 0; line < row_of_line_.size(); ++line) {
    if (row_of_line_[line] < place.rows.from || row_of_line_[line] >= place.rows.to) continue;
    structure_.along_rows.add(rows_.data() + line * static_cast<std::size_t>(field_->cols()) +
                              place.cols.from);
  }
  for (std::size_t line = 0; line < col_of_line_.size(); ++line) {
    if (col_of_line_[line] < place.cols.from || col_of_line_[line] >= place.cols.to) continue;
    structure_.along_columns.add(columns_.data() + line * static_cast<std::size_t>(field_->rows()) +
                                 place.rows.from);
  }
  place.energy = structure_.energy(contact_modulus_, field_->pitchX(), field_->pitchY());
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
