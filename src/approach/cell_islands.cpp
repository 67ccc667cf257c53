#include "approach/cell_islands.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace mems_stiction {
namespace {

/// Cells of a row side by side.
struct Run {
  std::size_t first = 0;  ///< of the cells
  std::size_t end = 0;
  std::size_t joined = 0;  ///< a run of the same island, itself if there is none before
};

/// What an island covers, and where it comes to lie.
struct Island {
  std::int64_t top = 0;
  std::int64_t left = 0;
  std::int64_t bottom = 0;
  std::int64_t right = 0;
  std::int64_t row = 0;
  std::int64_t col = 0;

  /// With what keeps it from the next one.
  std::int64_t height() const { return bottom - top + 2; }
  std::int64_t width() const { return right - left + 2; }
};

class Islands {
 public:
  explicit Islands(const std::vector<AreaCell>& cells) : cells_(cells) {
    findRuns();
    joinRuns();
    measure();
  }

  /// Finds a place for each, in a frame rows() x cols().
  void pack();
  std::int64_t rows() const { return rows_; }
  std::int64_t cols() const { return cols_; }

  template <typename Scalar>
  cv::Mat frame() const;

 private:
  void findRuns();
  void joinRuns();
  void measure();
  std::size_t rootOf(std::size_t run);

  const std::vector<AreaCell>& cells_;
  std::vector<Run> runs_;
  std::vector<std::size_t> island_of_;  ///< per run
  std::vector<Island> islands_;
  std::int64_t rows_ = 0;
  std::int64_t cols_ = 0;
};

void Islands::findRuns() {
  for (std::size_t i = 0; i < cells_.size(); ++i) {
    const bool goes_on =
        i > 0 && cells_[i - 1].row == cells_[i].row && cells_[i - 1].col + 1 == cells_[i].col;
    if (!goes_on) runs_.push_back({i, i, runs_.size()});
    runs_.back().end = i + 1;
  }
}

std::size_t Islands::rootOf(std::size_t run) {
  while (runs_[run].joined != run) {
    runs_[run].joined = runs_[runs_[run].joined].joined;
    run = runs_[run].joined;
  }
  return run;
}

void Islands::joinRuns() {
  std::size_t above = 0;  // the first run that the next one may touch
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const AreaCell& first = cells_[runs_[run].first];
    const AreaCell& last = cells_[runs_[run].end - 1];
    const auto ends_before = [&](const Run& other) {
      const AreaCell& other_last = cells_[other.end - 1];
      return other_last.row < first.row - 1 ||
             (other_last.row == first.row - 1 && other_last.col < first.col - 1);
    };
    while (ends_before(runs_[above])) ++above;
    for (std::size_t other = above; other < run; ++other) {
      const AreaCell& other_first = cells_[runs_[other].first];
      if (other_first.row != first.row - 1 || other_first.col > last.col + 1) break;
      const std::size_t roots[] = {rootOf(other), rootOf(run)};
      runs_[std::max(roots[0], roots[1])].joined = std::min(roots[0], roots[1]);
    }
  }
}

void Islands::measure() {
  island_of_.resize(runs_.size());
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const AreaCell& first = cells_[runs_[run].first];
    const AreaCell& last = cells_[runs_[run].end - 1];
    const std::size_t root = rootOf(run);
    if (root == run) {  // comes before the others of its island
      island_of_[run] = islands_.size();
      islands_.push_back({first.row, first.col, first.row, last.col, 0, 0});
      continue;
    }
    island_of_[run] = island_of_[root];
    Island& island = islands_[island_of_[run]];
    island.left = std::min<std::int64_t>(island.left, first.col);
    island.right = std::max<std::int64_t>(island.right, last.col);
    island.bottom = first.row;
  }
}

void Islands::pack() {
  // on shelves, the highest first
  std::vector<std::size_t> order(islands_.size());
  for (std::size_t i = 0; i < order.size(); ++i) order[i] = i;
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return islands_[a].height() > islands_[b].height();
  });
  double places = 0.0;
  for (const Island& island : islands_) {
    places += static_cast<double>(island.height()) * static_cast<double>(island.width());
    cols_ = std::max(cols_, island.width());
  }
  cols_ = std::max(cols_, static_cast<std::int64_t>(std::ceil(std::sqrt(places))));
  std::int64_t col = 0;
  std::int64_t row = 0;
  std::int64_t shelf = 0;
  for (const std::size_t i : order) {
    Island& island = islands_[i];
    if (col + island.width() > cols_) {
      row += shelf;
      col = 0;
      shelf = 0;
    }
    shelf = std::max(shelf, island.height());
    island.row = row;
    island.col = col;
    col += island.width();
  }
  rows_ = row + shelf;
}

template <typename Scalar>
cv::Mat Islands::frame() const {
  cv::Mat_<Scalar> relief(static_cast<int>(rows_), static_cast<int>(cols_),
                          std::numeric_limits<Scalar>::quiet_NaN());
  for (std::size_t run = 0; run < runs_.size(); ++run) {
    const Island& island = islands_[island_of_[run]];
    const AreaCell& first = cells_[runs_[run].first];
    Scalar* place = relief[static_cast<int>(first.row - island.top + island.row)] +
                    (first.col - island.left + island.col);
    for (std::size_t i = runs_[run].first; i < runs_[run].end; ++i)
      *place++ = static_cast<Scalar>(cells_[i].relief);
  }
  return relief;
}

}  // namespace

std::optional<HeightMap> frameOfIslands(const std::vector<AreaCell>& cells, double pitch_x,
                                        double pitch_y, std::int64_t most_places) {
  Islands islands(cells);
  islands.pack();
  if (islands.rows() > most_places / islands.cols()) return std::nullopt;
  const bool is_single = std::all_of(cells.begin(), cells.end(), [](const AreaCell& cell) {
    return static_cast<double>(static_cast<float>(cell.relief)) == cell.relief;
  });
  return HeightMap(is_single ? islands.frame<float>() : islands.frame<double>(), pitch_x, pitch_y);
}

}  // namespace mems_stiction
