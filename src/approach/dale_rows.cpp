#include "approach/dale_rows.hpp"

namespace mems_stiction {

MEMS_STICTION_VECTORIZED void RowsAround::tagsOf(const std::int32_t* columns, int count,
                                                 DaleTag* tags) const {
  for (int i = 0; i < count; ++i) tags[i] = tagOf(columns[i]);
}

void DaleRows::start(const GapField& field, DaleMap& dales, double from, double limit) {
  field_ = &field;
  dales_ = &dales;
  from_ = from;
  limit_ = limit;
  row_ = -1;
  for (std::vector<double>* gaps : {gaps_, gaps_ + 1, gaps_ + 2, &no_row_}) {
    gaps->assign(static_cast<std::size_t>(field.cols()) + 2, GapField::kInvalidGap);
  }
  for (std::vector<std::int32_t>& columns : columns_)
    columns.resize(static_cast<std::size_t>(field.cols()));
  read(0);
}

bool DaleRows::next() {
  ++row_;
  if (row_ >= field_->rows()) return false;
  if (row_ + 1 < field_->rows()) read(row_ + 1);
  const int cols = field_->cols();
  const std::int32_t* dales = dales_->data() + static_cast<std::ptrdiff_t>(row_) * cols;
  around_ = {gapsOf(row_),
             gapsOf(row_ - 1),
             gapsOf(row_ + 1),
             dales,
             row_ > 0 ? dales - cols : dales,
             row_ + 1 < field_->rows() ? dales + cols : dales,
             cols - 1};
  return true;
}

const double* DaleRows::gapsOf(int row) const {
  const bool is_in_frame = row >= 0 && row < field_->rows();
  return (is_in_frame ? gaps_[row % kRows] : no_row_).data() + 1;
}

void DaleRows::read(int row) {
  double* gaps = gaps_[row % kRows].data() + 1;
  field_->gapsOfRow(row, gaps);
  std::int32_t* columns = columns_[row % 2].data();
  counts_[row % 2] = columnsBetween(from_, limit_, gaps, field_->cols(), columns);
  dales_->findInRow(row, columns, counts_[row % 2], gaps, gapsOf(row - 1));
}

}  // namespace mems_stiction
