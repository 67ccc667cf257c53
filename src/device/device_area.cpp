#include "device/device_area.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "approach/area_cells.hpp"
#include "device/area_load.hpp"
#include "device/scan_list.hpp"
#include "errors/short_number.hpp"
#include "height_map/validity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/prediction/adhesion_model.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "numeric/median.hpp"
#include "numeric/words.hpp"
#include "prediction/area_adhesion.hpp"

namespace mems_stiction {
namespace {

/// Rows between pieces, so that no contact reaches from one to the next.
constexpr std::int64_t kRowsBetween = 2;
/// Parts whose forces tell how the force of a larger area goes on.
constexpr int kQuarters = 4;
/// A larger ratio of areas is no rounding to whole pixels.
constexpr double kGoesOn = 1.05;
constexpr double kRounding = 0.05;
/// Pixels along the side of a frame where cells in reach are too many to be kept one by one.
constexpr std::int64_t kFrameSide = 4096;
/// The same of a plate that tilts, which comes to rest again and again.
constexpr std::int64_t kTiltedSide = 2048;
/// So many contacts of a frame tell how those of a larger area flow.
constexpr double kManyContacts = 100.0;
/// So many of the highest cells tell nearly always. Where they do not, the surface is made once
/// more, and so many times as many cells of it and of those after it count.
constexpr std::int64_t kFewCells = 1 << 16;
constexpr std::int64_t kMoreCells = 8;
/// Pixels along the side of what is shown of a surface, at most.
constexpr std::int64_t kShownSide = 512;

constexpr char kFlowOfFew[] =
    "contacts may flow, and of the device's own, which are few, they flow as whole contacts: a "
    "scan's prediction, by places, tells better what that does";

/// Of a contact that is cut from a scan, so much must have been measured; so many places are tried.
constexpr double kLeastMeasuredShare = 0.5;
constexpr int kMostDraws = 100;

/// Every so many pixels of a surface, to look at.
class ShownSurface {
 public:
  explicit ShownSurface(const MadeSize& size)
      : size_(size),
        step_((size.rows + kShownSide - 1) / kShownSide),
        shown_(countOf(size.rows), countOf(size.cols), CV_32FC1) {}

  void add(std::int64_t row, std::int64_t col, const cv::Mat& relief) {
    for (std::int64_t i = after(row); i < row + relief.rows; i += step_) {
      for (std::int64_t j = after(col); j < col + relief.cols; j += step_) {
        shown_.at<float>(static_cast<int>(i / step_), static_cast<int>(j / step_)) =
            relief.at<float>(static_cast<int>(i - row), static_cast<int>(j - col));
      }
    }
  }

  HeightMap surface() const {
    const auto step = static_cast<double>(step_);
    return {shown_, step * size_.pitch_x, step * size_.pitch_y};
  }

 private:
  int countOf(std::int64_t pixels) const { return static_cast<int>((pixels + step_ - 1) / step_); }
  std::int64_t after(std::int64_t place) const { return (place + step_ - 1) / step_ * step_; }

  MadeSize size_;
  std::int64_t step_;
  cv::Mat shown_;
};

/// To two digits.
double roundedUp(double value) {
  const double digit = std::pow(10.0, std::floor(std::log10(value)) - 1.0);
  return std::ceil(value / digit) * digit;
}

/// The top left of the last piece.
cv::Mat frameOf(DeviceSurface& surface) {
  const MadeSize& size = surface.pieces().size;
  const int side = static_cast<int>(std::min(size.rows, kFrameSide));
  cv::Mat frame(side, side, CV_32FC1);
  surface.heights(surface.rows() - size.rows, 0, frame);
  return frame;
}

/// Of a frame whose contacts flow, from piece to piece.
cv::Size flowingSize(const DevicePieces& pieces) {
  const std::int64_t cols = std::min(pieces.size.cols, kTiltedSide);
  const std::int64_t rows =
      std::min(pieces.count * pieces.size.rows, kTiltedSide * kTiltedSide / cols);
  return {static_cast<int>(cols), static_cast<int>(rows)};
}

/// The last pieces, one after another.
cv::Mat flowingFrameOf(DeviceSurface& surface) {
  cv::Mat frame(flowingSize(surface.pieces()), CV_32FC1);
  surface.heights(surface.rows() - frame.rows, 0, frame);
  return frame;
}

/// What was found is that of all cells, as if every one had been kept.
/// @throw SurfaceError if it needs cells that lie deeper than those that were
void checkDepth(const AreaCells& cells, const AreaAdhesion& found) {
  const std::int64_t all = cells.counts().lowestWithin(cells.limits().most_cells);
  if (cells.levelBucket() <= all || (found.is_enough && !found.took_all_cells)) return;
  const double least = cells.highest() - cells.counts().lowerEnd(all);
  throw SurfaceError(
      "the cells of the surface were collected down to " +
      shortNumber((cells.highest() - cells.level()) * 1e9, 3) +
      " nm below its highest place, and contacts may reach further: collect them with a depth of " +
      numberText(roundedUp(least)) + " m");
}

}  // namespace

std::string whyLevel(const DevicePieces& pieces) {
  if (pieces.count > 1 || pieces.area_ratio > 1.5) {
    return "device/guidance: free: the plate of a device of several contacts, or of more pixels "
           "than are made, stays "
           "level "
           "here: where its contacts lie is not known";
  }
  if (pieces.size.rows <= kTiltedSide) return "";
  return "device/guidance: free: a plate of " + std::to_string(pieces.size.cols) + " x " +
         std::to_string(pieces.size.rows) + " pixels stays level here, " +
         std::to_string(kTiltedSide) + " x " + std::to_string(kTiltedSide) + " can be tilted";
}

std::int64_t rowInArea(const DevicePieces& pieces, int piece, std::int64_t row) {
  return piece * (pieces.size.rows + kRowsBetween) + row;
}

bool haveRoom(const std::vector<HeightMap>& scans, const DevicePieces& pieces) {
  double area = 0.0;
  for (const HeightMap& scan : scans) {
    if (scan.cols() < pieces.size.cols || scan.rows() < pieces.size.rows) return false;
    area += areaOf(scan);
  }
  return pieces.area_ratio <= 1.0 + kRounding && pieces.area() <= area;
}

ScanDeck::ScanDeck(const std::vector<HeightMap>& scans, std::uint64_t seed)
    : scans_(&scans), engine_(seed), order_(scans.size()) {
  std::iota(order_.begin(), order_.end(), std::size_t{0});
}

const HeightMap& ScanDeck::next() {
  if (next_ == 0) std::shuffle(order_.begin(), order_.end(), engine_);
  const HeightMap& scan = (*scans_)[order_[next_]];
  next_ = (next_ + 1) % order_.size();
  return scan;
}

/// The cells of the device, and those of its quarters where it goes on beyond them.
class DeviceAreaSolver::Gatherer {
 public:
  explicit Gatherer(const DevicePieces& pieces, const AreaCellLimits& limits = {})
      : pieces_(pieces),
        cells_(pieces.size.pitch_x, pieces.size.pitch_y, limits),
        goes_on_(pieces.is_part && pieces.area_ratio > kGoesOn) {
    if (goes_on_) quarters_.assign(kQuarters, cells_);
  }

  void add(int piece, std::int64_t row, std::int64_t col, const cv::Mat& relief) {
    const std::int64_t at = rowInArea(pieces_, piece, row);
    if (!goes_on_) {
      cells_.add(at, col, relief);
      return;
    }
    // tiles are small against the surface: their first pixel says in which quarter they lie
    const int quarter = pieces_.count >= kQuarters ? piece % kQuarters
                                                   : (2 * row >= pieces_.size.rows ? 2 : 0) +
                                                         (2 * col >= pieces_.size.cols ? 1 : 0);
    quarters_[static_cast<std::size_t>(quarter)].add(at, col, relief);
  }

  /// Nothing more comes.
  void finish() {
    for (const AreaCells& quarter : quarters_) cells_.add(quarter);
  }

  /// Whether every cell is kept.
  bool keepsAll() const { return cells_.validCount() <= cells_.limits().most_cells; }
  const AreaCells& cells() const { return cells_; }
  const std::vector<AreaCells>& quarters() const { return quarters_; }

 private:
  const DevicePieces& pieces_;
  AreaCells cells_;
  bool goes_on_;
  std::vector<AreaCells> quarters_;
};

DeviceAreaSolver::DeviceAreaSolver(const Options& model, double loaded_area,
                                   const DevicePieces& pieces)
    : model_(model), loaded_area_(loaded_area), pieces_(pieces), cell_limit_(kFewCells) {}

void DeviceAreaSolver::warnOnce(const std::string& warning) { addMissing({warning}, warnings_); }

Realisation DeviceAreaSolver::realise(DeviceSurface& surface) {
  return realise({this}, surface).front();
}

std::vector<Realisation> DeviceAreaSolver::realise(const std::vector<DeviceAreaSolver*>& solvers,
                                                   DeviceSurface& surface) {
  const DevicePieces& pieces = solvers.front()->pieces_;
  std::optional<ShownSurface> shown;
  if (solvers.front()->made_surface_.empty()) shown.emplace(pieces.size);
  std::vector<Realisation> found;
  cv::Mat whole;
  cv::Mat flowing;
  const auto frame = [&](const DeviceAreaSolver& solver) {
    cv::Mat& made = solver.may_flow_ ? flowing : whole;
    if (made.empty()) made = solver.frameFrom(surface);
    return made;
  };
  if (std::all_of(solvers.begin(), solvers.end(),
                  [](const auto* solver) { return solver->tilts(); })) {
    if (shown) shown->add(0, 0, frame(*solvers.front()));
    for (DeviceAreaSolver* solver : solvers)
      found.push_back(solver->taken(solver->followFrame(frame(*solver))));
  } else {
    found = followCells(solvers, surface, frame,
                        [&](int piece, std::int64_t row, std::int64_t col, const cv::Mat& tile) {
                          if (shown && piece == 0) shown->add(row, col, tile);
                        });
  }
  if (shown) {
    for (DeviceAreaSolver* solver : solvers) solver->made_surface_ = shown->surface();
  }
  return found;
}

std::vector<Realisation> DeviceAreaSolver::followCells(
    const std::vector<DeviceAreaSolver*>& solvers, DeviceSurface& surface,
    const std::function<cv::Mat(const DeviceAreaSolver&)>& frame,
    const DeviceSurface::Visit& visit_once) {
  const AreaCellLimits all_cells;
  AreaCellLimits limits;
  std::int64_t& cell_limit = solvers.front()->cell_limit_;
  std::vector<std::optional<Realisation>> found(solvers.size());
  const auto areAllFound = [&] {
    return std::all_of(found.begin(), found.end(), [](const auto& one) { return one.has_value(); });
  };
  for (bool is_first = true; !areAllFound(); is_first = false) {
    if (!is_first) cell_limit = std::min(kMoreCells * cell_limit, all_cells.most_cells);
    limits.most_cells = cell_limit;
    Gatherer gatherer(solvers.front()->pieces_, limits);
    surface.visitTiles(0, surface.rows(),
                       [&](int piece, std::int64_t row, std::int64_t col, const cv::Mat& tile) {
                         gatherer.add(piece, row, col, tile);
                         if (is_first) visit_once(piece, row, col, tile);
                       });
    gatherer.finish();
    const bool are_all = gatherer.keepsAll() || cell_limit == all_cells.most_cells;
    for (std::size_t i = 0; i < solvers.size(); ++i) {
      if (found[i]) continue;
      found[i] = solvers[i]->follow(gatherer.cells(), gatherer.quarters(), are_all,
                                    [&] { return frame(*solvers[i]); });
    }
  }
  std::vector<Realisation> all;
  for (const std::optional<Realisation>& one : found) all.push_back(*one);
  return all;
}

Realisation DeviceAreaSolver::realise(const AreaCells& cells, DeviceSurface& surface) {
  return *follow(cells, {}, true, [&] { return frameFrom(surface); });
}

std::vector<Realisation> DeviceAreaSolver::realise(const std::vector<DeviceAreaSolver*>& solvers,
                                                   ScanDeck& lower, ScanDeck* upper,
                                                   std::uint64_t seed) {
  const DevicePieces& pieces = solvers.front()->pieces_;
  std::mt19937_64 engine(seed);
  const auto drawnPart = [&](ScanDeck& scans) {
    const HeightMap& scan = scans.next();
    const int rows = static_cast<int>(pieces.size.rows);
    const int cols = static_cast<int>(pieces.size.cols);
    const cv::Rect part(std::uniform_int_distribution<int>(0, scan.cols() - cols)(engine),
                        std::uniform_int_distribution<int>(0, scan.rows() - rows)(engine), cols,
                        rows);
    cv::Mat heights;
    scan.heights()(part).convertTo(heights, CV_64F);
    return heights;
  };
  const auto partOf = [&](ScanDeck& scans) {
    for (int draw = 0; draw < kMostDraws; ++draw) {
      cv::Mat heights = drawnPart(scans);
      if (cv::countNonZero(validMask(heights)) >=
          kLeastMeasuredShare * static_cast<double>(heights.total()))
        return heights;
    }
    throw SurfaceError("the scans have no place of the size of a contact, " +
                       shortNumber(pieces.size.sideX() * 1e6, 2) +
                       " um, of which half was measured: scans with fewer missing pixels, or "
                       "preprocessing/fill, help");
  };
  Gatherer gatherer(pieces);
  const cv::Size flowing_size = flowingSize(pieces);
  cv::Mat relief;
  cv::Mat flowing;
  for (int piece = 0; piece < pieces.count; ++piece) {
    relief = partOf(lower);
    if (upper != nullptr) relief -= partOf(*upper);
    gatherer.add(piece, 0, 0, relief);
    const int room = flowing_size.height - flowing.rows;
    if (room > 0)
      flowing.push_back(relief(cv::Rect(0, 0, flowing_size.width, std::min(relief.rows, room))));
  }
  gatherer.finish();
  std::vector<Realisation> found;
  found.reserve(solvers.size());
  for (DeviceAreaSolver* solver : solvers) {
    found.push_back(*solver->follow(gatherer.cells(), gatherer.quarters(), true,
                                    [&] { return solver->may_flow_ ? flowing : relief; }));
  }
  return found;
}

std::optional<Realisation> DeviceAreaSolver::follow(const AreaCells& cells,
                                                    const std::vector<AreaCells>& quarters,
                                                    bool are_all,
                                                    const std::function<cv::Mat()>& frame) {
  if (!tilts()) {
    const auto elastically = [&] {
      Options elastic = model_;
      elastic.deformation = Deformation::kElastic;
      return followCells(cells, quarters, are_all, elastic);
    };
    if (const auto found = followCells(cells, quarters, are_all, model_))
      return taken(withFlow(*found, frame, elastically));
    if (!are_all) return std::nullopt;
  }
  return taken(followFrame(frame()));
}

Realisation DeviceAreaSolver::taken(const Followed& followed) {
  force_exponents_ = followed.force_exponents;
  work_exponents_ = followed.work_exponents;
  stiffness_ = followed.stiffness;
  if (followed.growth) {
    force_growths_.push_back(followed.growth->force);
    work_growths_.push_back(followed.growth->work);
  }
  return followed.realisation;
}

std::optional<DeviceAreaSolver::Followed> DeviceAreaSolver::followCells(
    const AreaCells& cells, const std::vector<AreaCells>& quarters, bool are_all,
    const Options& model) {
  const auto isEnough = [&](const AreaAdhesion& found) {
    return found.is_enough && (are_all || !found.took_all_cells);
  };
  may_flow_ = false;
  const AreaAdhesion found = areaAdhesion(cells, loadedOn(model, loaded_area_, cells.area()));
  checkDepth(cells, found);
  if (!isEnough(found)) return std::nullopt;
  Followed followed;
  followed.force_exponents = found.pull_off_exponents;
  followed.work_exponents = found.work_exponents;
  followed.stiffness = found.contact_stiffness / found.area;
  Realisation& realisation = followed.realisation;
  realisation.pull_off_force = found.pull_off_force;
  realisation.apparent_work_of_adhesion = found.apparent_work_of_adhesion;
  realisation.contacts = found.pull_off_contact_count;
  realisation.separation_at_rest = found.separation_at_rest;
  double force = 0.0;
  double work = 0.0;
  for (const AreaCells& quarter : quarters) {
    if (quarter.validCount() == 0) continue;
    const AreaAdhesion part = areaAdhesion(quarter, loadedOn(model, loaded_area_, quarter.area()));
    if (!isEnough(part)) return std::nullopt;
    force += part.pull_off_force / kQuarters;
    work += part.apparent_work_of_adhesion / kQuarters;
  }
  if (!quarters.empty()) {
    followed.growth = {
        std::log(realisation.pull_off_force / force) / std::log(1.0 * kQuarters),
        std::log(realisation.apparent_work_of_adhesion / work) / std::log(1.0 * kQuarters)};
  }
  may_flow_ = found.flows && framesTell(found.contact_count);
  if (found.flows && !may_flow_) warnOnce(kFlowOfFew);
  return followed;
}

DeviceAreaSolver::Followed DeviceAreaSolver::withFlow(
    const Followed& by_cells, const std::function<cv::Mat()>& frame,
    const std::function<std::optional<Followed>()>& elastically) {
  if (!may_flow_) return by_cells;
  const Prediction found = predictFrame(frame());
  if (found.plastic_count + found.elasto_plastic_count == 0)
    return elastically().value_or(by_cells);
  // what a few contacts hold does not go with area
  if (scaleOf(found) <= kGoesOn || found.pull_off_contact_count >= kManyContacts)
    return ofFrame(found);
  warnOnce(kFlowOfFew);
  return by_cells;
}

cv::Mat DeviceAreaSolver::frameFrom(DeviceSurface& surface) const {
  return may_flow_ ? flowingFrameOf(surface) : frameOf(surface);
}

bool DeviceAreaSolver::framesTell(int contacts) const {
  const double share = static_cast<double>(flowingSize(pieces_).area()) /
                       (static_cast<double>(pieces_.count * pieces_.size.rows) *
                        static_cast<double>(pieces_.size.cols));
  return share >= 1.0 || contacts * share >= kManyContacts;
}

Prediction DeviceAreaSolver::predictFrame(const cv::Mat& heights) const {
  const HeightMap frame(heights, pieces_.size.pitch_x, pieces_.size.pitch_y);
  AdhesionModel model(loadedOn(model_, loaded_area_, areaOf(frame)));
  return model.predict(frame);
}

double DeviceAreaSolver::scaleOf(const Prediction& of_frame) const {
  return pieces_.area() / of_frame.nominal_area;
}

DeviceAreaSolver::Followed DeviceAreaSolver::followFrame(const cv::Mat& heights) {
  return ofFrame(predictFrame(heights));
}

DeviceAreaSolver::Followed DeviceAreaSolver::ofFrame(const Prediction& found) {
  Followed followed;
  followed.force_exponents = found.pull_off_exponents;
  followed.work_exponents = found.work_exponents;
  followed.stiffness = found.contact_stiffness / found.nominal_area;
  Realisation& realisation = followed.realisation;
  const double scale = scaleOf(found);
  realisation.pull_off_force = found.pull_off_force * scale;
  realisation.apparent_work_of_adhesion = found.apparent_work_of_adhesion;
  realisation.contacts = static_cast<int>(std::min(found.pull_off_contact_count * scale, 2e9));
  realisation.separation_at_rest = found.mean_gap;
  if (pieces_.is_part && pieces_.area_ratio > kGoesOn) followed.growth = {1.0, 0.0};
  if (scale > kGoesOn) {
    warnOnce("contacts are so many that their force was found on " + shortNumber(100.0 / scale, 2) +
             " % of the device's area, and goes with area from there");
  }
  return followed;
}

AreaGrowth DeviceAreaSolver::growth() {
  AreaGrowth growth;
  if (force_growths_.empty()) return growth;
  // single ones scatter by more than they are worth
  growth.force = std::pow(pieces_.area_ratio, std::clamp(medianOf(force_growths_), 0.0, 1.0));
  growth.work = std::pow(pieces_.area_ratio, std::clamp(medianOf(work_growths_), -1.0, 0.0));
  warnOnce("the device has " + shortNumber(pieces_.area_ratio, 2) +
           " times the area that device_force/max_cells makes: its force is continued from how it "
           "grows up to there");
  return growth;
}

}  // namespace mems_stiction
