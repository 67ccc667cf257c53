#include "half_space/contact_windows.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <initializer_list>
#include <utility>

#include "half_space/cell_influence.hpp"
#include "half_space/contact_minimiser.hpp"
#include "half_space/row_work.hpp"
#include "numeric/vectorized.hpp"

namespace mems_stiction {
namespace {

/// Cells along a block.
constexpr int kLabelBlock = 8;
/// A cell is out of equilibrium with this share of the largest residual.
constexpr double kMarkedShare = 0.02;
/// Windows are no wider than this share of the frame, and no larger in sum.
constexpr double kWidestWindow = 1.0 / 3.0;
constexpr double kLargestArea = 0.05;
/// Share of the frame's residual that stays in a window, and steps that it may take.
constexpr double kRelaxedShare = 0.02;
constexpr int kMostNewtonSteps = 30;
/// Minimisers that are kept for the next windows of their shape: plans and arrays take as long to
/// make as to use.
constexpr std::size_t kMostIdle = 16;
/// A change of traction beyond this, of 8 Gamma/(3 z0), is no answer: the law repels with 1300
/// times that at most.
constexpr double kLargestStressChange = 1e5;

/// i on a ring of n.
int onRing(int i, int n) { return (i % n + n) % n; }

/// Blocks of a side; the last one is up to twice as long.
int blockCount(int cells) { return std::max(1, cells / kLabelBlock); }

/// The first cell of a block, on a side that goes on beyond its ends.
int firstCell(int block, int cells) {
  const int count = blockCount(cells);
  const int inside = onRing(block, count);
  return (block - inside) / count * cells + inside * kLabelBlock;
}

/// Each value as large as that of |residual - mean| at least.
MEMS_STICTION_VECTORIZED void raiseResiduals(const float* residual, float mean,
                                             std::vector<float>& values) {
  float* const value = values.data();
  for (std::size_t i = 0; i < values.size(); ++i) {
    const float here = std::abs(residual[i] - mean);
    value[i] = here > value[i] ? here : value[i];
  }
}

}  // namespace

ContactWindows::ContactWindows(const HalfSpaceGrid& grid, const TractionLaw& law,
                               const ElasticResponse& response, const MinimiserSettings& settings)
    : grid_(grid), law_(law), settings_(settings), response_(response) {
  settings_.give_way = nullptr;
  settings_.max_newton_steps = kMostNewtonSteps;
}

ContactWindows::~ContactWindows() = default;

void ContactWindows::setLaw(const TractionLaw& law) {
  law_ = law;
  idle_.clear();  // they have the one before
}

cv::Mat1b ContactWindows::blocksOf(const Frame& frame) const {
  cv::Mat1b marked = cv::Mat1b::zeros(blockCount(grid_.frame_rows), blockCount(grid_.frame_cols));
  const auto limit = static_cast<float>(kMarkedShare * frame.largest_residual);
  const auto mean = static_cast<float>(frame.mean_residual);
  forEachRow(marked.rows, settings_.threads, [&](int block_row) {
    std::vector<float> largest(static_cast<std::size_t>(grid_.frame_cols),
                               0.0F);  // of each column in these rows
    for (int row = firstCell(block_row, grid_.frame_rows);
         row < firstCell(block_row + 1, grid_.frame_rows); ++row) {
      raiseResiduals(frame.residual + grid_.offset(row), mean, largest);
    }
    for (int block = 0; block < marked.cols; ++block) {
      const auto first = largest.begin() + firstCell(block, grid_.frame_cols);
      const auto end = largest.begin() + firstCell(block + 1, grid_.frame_cols);
      marked(block_row, block) = *std::max_element(first, end) > limit ? 1 : 0;
    }
  });
  return marked;
}

std::vector<ContactWindows::Window> ContactWindows::windowsAround(const cv::Mat1b& marked) {
  const bool is_periodic = grid_.boundary == HalfSpaceBoundary::kPeriodic;
  const auto isInside = [&](const cv::Point& block) {
    return is_periodic ||
           (block.y >= 0 && block.y < marked.rows && block.x >= 0 && block.x < marked.cols);
  };
  const auto inFrame = [&](const cv::Point& block) {
    return cv::Point(onRing(block.x, marked.cols), onRing(block.y, marked.rows));
  };
  cv::Mat1b grown = cv::Mat1b::zeros(marked.size());
  for (int row = 0; row < marked.rows; ++row) {
    for (int col = 0; col < marked.cols; ++col) {
      if (marked(row, col) == 0) continue;
      for (int i = -1; i <= 1; ++i) {
        for (int j = -1; j <= 1; ++j) {
          const cv::Point neighbour(col + j, row + i);
          if (isInside(neighbour)) grown(inFrame(neighbour)) = 1;
        }
      }
    }
  }
  labels_ = cv::Mat1i::zeros(marked.size());
  std::vector<Window> windows;
  std::vector<cv::Point> border;
  for (int row = 0; row < marked.rows; ++row) {
    for (int col = 0; col < marked.cols; ++col) {
      if (grown(row, col) == 0 || labels_(row, col) != 0) continue;
      Window window{cv::Rect(col, row, 1, 1), static_cast<int>(windows.size()) + 1};
      labels_(row, col) = window.label;
      border.assign(1, cv::Point(col, row));
      while (!border.empty()) {
        const cv::Point block = border.back();
        border.pop_back();
        window.blocks |= cv::Rect(block.x, block.y, 1, 1);
        for (const cv::Point step :
             {cv::Point(1, 0), cv::Point(-1, 0), cv::Point(0, 1), cv::Point(0, -1)}) {
          const cv::Point neighbour = block + step;
          if (!isInside(neighbour) || grown(inFrame(neighbour)) == 0) continue;
          int& label = labels_(inFrame(neighbour));
          if (label != 0) continue;
          label = window.label;
          border.push_back(neighbour);
        }
      }
      windows.push_back(window);
    }
  }
  return windows;
}

cv::Rect ContactWindows::cellsOf(const Window& window) const {
  const cv::Point first(firstCell(window.blocks.x, grid_.frame_cols),
                        firstCell(window.blocks.y, grid_.frame_rows));
  const cv::Point end(firstCell(window.blocks.x + window.blocks.width, grid_.frame_cols),
                      firstCell(window.blocks.y + window.blocks.height, grid_.frame_rows));
  return {first, end};
}

bool ContactWindows::areWorthIt(const std::vector<Window>& windows) const {
  double area = 0.0;
  for (const Window& window : windows) {
    const cv::Rect cells = cellsOf(window);
    if (cells.width > kWidestWindow * grid_.frame_cols ||
        cells.height > kWidestWindow * grid_.frame_rows)
      return false;
    area += static_cast<double>(cells.width) * cells.height;
  }
  return area <= kLargestArea * grid_.frame_rows * grid_.frame_cols;
}

template <typename Work>
void ContactWindows::forEachCell(const cv::Rect& cells, const Work& work) const {
  std::size_t place = 0;
  for (int i = 0; i < cells.height; ++i) {
    const int row = onRing(cells.y + i, grid_.frame_rows);
    for (int j = 0; j < cells.width; ++j, ++place) {
      const int col = onRing(cells.x + j, grid_.frame_cols);
      work(place, grid_.offset(row) + static_cast<std::size_t>(col), row, col);
    }
  }
}

bool ContactWindows::owns(const Window& window, int row, int col) const {
  return labels_(std::min(row / kLabelBlock, labels_.rows - 1),
                 std::min(col / kLabelBlock, labels_.cols - 1)) == window.label;
}

std::unique_ptr<ContactMinimiser> ContactWindows::takeMinimiser(const HalfSpaceGrid& window) {
  {
    const std::lock_guard<std::mutex> lock(idle_mutex_);
    const auto found = std::find_if(idle_.begin(), idle_.end(), [&](const auto& idle) {
      return idle->grid().frame_rows == window.frame_rows &&
             idle->grid().frame_cols == window.frame_cols;
    });
    if (found != idle_.end()) {
      std::unique_ptr<ContactMinimiser> minimiser = std::move(*found);
      idle_.erase(found);
      return minimiser;
    }
  }
  MinimiserSettings settings = settings_;
  settings.threads = 1;
  const auto cells =
      static_cast<std::size_t>(window.frame_rows) * static_cast<std::size_t>(window.frame_cols);
  return std::make_unique<ContactMinimiser>(window, law_, response_,
                                            LargePageVector<double>(cells, 0.0),
                                            LargePageVector<float>(), settings);
}

void ContactWindows::giveBack(std::unique_ptr<ContactMinimiser> minimiser) {
  const std::lock_guard<std::mutex> lock(idle_mutex_);
  if (idle_.size() == kMostIdle) idle_.erase(idle_.begin());
  idle_.push_back(std::move(minimiser));
}

ContactWindows::Relaxed ContactWindows::relaxOne(const Frame& frame, const Window& window) {
  const cv::Rect cells = cellsOf(window);
  const HalfSpaceGrid grid(cells.height, cells.width, grid_.pitch_x, grid_.pitch_y,
                           HalfSpaceBoundary::kFree);
  LargePageVector<double> relief(static_cast<std::size_t>(cells.area()));
  LargePageVector<float> fixed(relief.size());
  forEachCell(cells, [&](std::size_t place, std::size_t cell, int row, int col) {
    const std::size_t in_frame =
        static_cast<std::size_t>(row) * static_cast<std::size_t>(grid_.frame_cols) +
        static_cast<std::size_t>(col);
    relief[place] = frame.relief[in_frame] - frame.displacement[cell];
    fixed[place] = static_cast<float>(frame.elastic_traction[cell] + frame.mean_residual);
  });
  Relaxed relaxed;
  relaxed.change.resize(static_cast<std::size_t>(cells.area()));
  std::unique_ptr<ContactMinimiser> minimiser = takeMinimiser(grid);
  if (!minimiser->isSetUp()) return relaxed;
  minimiser->restart(std::move(relief), std::move(fixed),
                     kRelaxedShare * frame.largest_residual / law_.stress());
  minimiser->solve(frame.height);
  const double limit = kLargestStressChange * law_.stress();
  relaxed.is_sound = true;
  const double* const traction = minimiser->elasticTraction();
  forEachCell(cells, [&](std::size_t place, std::size_t cell, int row, int col) {
    const std::size_t in_window =
        grid.offset(static_cast<int>(place) / cells.width) + place % cells.width;
    relaxed.change[place] = static_cast<float>(traction[in_window]);
    relaxed.is_sound = relaxed.is_sound && std::abs(traction[in_window]) <= limit;  // nor is NaN
    if (!owns(window, row, col)) return;
    relaxed.gained +=
        traction[in_window] - (static_cast<double>(frame.residual[cell]) - frame.mean_residual);
  });
  if (relaxed.is_sound) giveBack(std::move(minimiser));
  return relaxed;
}

void ContactWindows::findResponse(StiffnessOperator<double>& stiffness) {
  const bool is_free = grid_.boundary == HalfSpaceBoundary::kFree;
  if (!influence_.empty() || (is_free && response_.layers == nullptr)) return;
  cv::Mat1d influence(static_cast<int>(kWidestWindow * grid_.frame_rows) + 1,
                      static_cast<int>(kWidestWindow * grid_.frame_cols) + 1);
  if (is_free) {
    const CellInfluence cell(response_.contact_modulus, response_.layers, grid_.pitch_x,
                             grid_.pitch_y);
    forEachRow(influence.rows, settings_.threads, [&](int row) {
      for (int col = 0; col < influence.cols; ++col) influence(row, col) = cell.at(row, col);
    });
  } else {
    LargePageVector<double> impulse(grid_.size(), 0.0);
    impulse[0] = 1.0;
    stiffness.displace(impulse.data(), impulse.data());
    for (int row = 0; row < influence.rows; ++row) {
      std::copy_n(impulse.data() + grid_.offset(row), influence.cols, influence[row]);
    }
  }
  influence_ = influence;
  response_.influence = &influence_;
}

bool ContactWindows::relax(const Frame& frame, StiffnessOperator<double>& stiffness,
                           float* change) {
  const std::vector<Window> windows = windowsAround(blocksOf(frame));
  if (!areWorthIt(windows)) return false;
  findResponse(stiffness);
  std::vector<Relaxed> relaxed(windows.size());
  forEachRow(static_cast<int>(windows.size()), settings_.threads, [&](int i) {
    const auto place = static_cast<std::size_t>(i);
    relaxed[place] = relaxOne(frame, windows[place]);
  });
  if (!std::all_of(relaxed.begin(), relaxed.end(), [](const Relaxed& one) { return one.is_sound; }))
    return false;
  double level = 0.0;  // of what K cannot resist
  for (const Relaxed& one : relaxed) level += one.gained;
  level = grid_.boundary == HalfSpaceBoundary::kPeriodic ? level / grid_.cellCount() : 0.0;
  const auto taken = static_cast<float>(frame.mean_residual + level);
  forEachRow(grid_.rows, settings_.threads, [&](int row) {
    const std::size_t end = grid_.offset(row) + static_cast<std::size_t>(grid_.cols);
    for (std::size_t i = grid_.offset(row); i < end; ++i) change[i] = frame.residual[i] - taken;
  });
  for (std::size_t i = 0; i < windows.size(); ++i) {
    forEachCell(cellsOf(windows[i]), [&](std::size_t place, std::size_t cell, int row, int col) {
      if (owns(windows[i], row, col))
        change[cell] = relaxed[i].change[place] - static_cast<float>(level);
    });
  }
  return true;
}

}  // namespace mems_stiction
