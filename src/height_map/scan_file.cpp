#include "mems_stiction/height_map/scan_file.hpp"

#include <fcntl.h>
#include <stdlib.h>
#include <unistd.h>
#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <limits>
#include <mutex>

#include <opencv2/imgcodecs.hpp>

#include "mems_stiction/base/errors.hpp"
#include "mems_stiction/base/option_yaml.hpp"
#include "mems_stiction/height_map/text_grid.hpp"
#include "mems_stiction/height_map/tiff_tags.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

enum class Content { kTiff, kPng, kExr, kGwy, kText, kOther };

std::string extension(const std::string& path) {
  std::string text = fs::path(path).extension().string();
  std::transform(text.begin(), text.end(), text.begin(), [](unsigned char c) { return std::tolower(c); });
  return text;
}

/// By the first bytes where the format has a signature, else by the name.
Content contentOf(const std::string& path) {
  std::error_code error;
  if (!fs::exists(path, error)) throw FileError(path + ": there is no such file");
  if (fs::is_directory(path, error)) throw FileError(path + ": is a folder, not a scan");
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw FileError(path + ": cannot be opened");
  char start[8] = {};
  stream.read(start, sizeof start);
  if (stream.gcount() == 0) throw FileError(path + ": is empty");
  const std::string magic(start, sizeof start);
  const auto begins = [&magic](const std::string& with) { return magic.compare(0, with.size(), with) == 0; };
  if (begins(std::string("II*\0", 4)) || begins(std::string("MM\0*", 4)) || begins(std::string("II+\0", 4)) ||
      begins(std::string("MM\0+", 4))) {
    return Content::kTiff;
  }
  if (begins("\x89PNG")) return Content::kPng;
  if (begins("\x76\x2f\x31\x01")) return Content::kExr;
  if (begins("GWYP")) return Content::kGwy;
  const std::string name_end = extension(path);
  if (name_end == ".txt" || name_end == ".asc" || name_end == ".csv") return Content::kText;
  if (name_end == ".tif" || name_end == ".tiff" || name_end == ".png" || name_end == ".exr") {
    throw FileError(path + ": is not a " + name_end.substr(1) + " image: damaged, or misnamed");
  }
  return Content::kOther;
}

/// OpenCV's readers and the libraries below them complain about damaged files on standard error by themselves. For the
/// life of this object the process's standard error is silent: the caller says what is wrong, in one line.
class SilentStandardError {
 public:
  SilentStandardError() : saved_(fcntl(STDERR_FILENO, F_DUPFD_CLOEXEC, 3)) {
    const int nothing = open("/dev/null", O_WRONLY | O_CLOEXEC);
    if (saved_ >= 0 && nothing >= 0) dup2(nothing, STDERR_FILENO);
    if (nothing >= 0) close(nothing);
  }
  ~SilentStandardError() {
    if (saved_ < 0) return;
    dup2(saved_, STDERR_FILENO);
    close(saved_);
  }
  SilentStandardError(const SilentStandardError&) = delete;
  SilentStandardError& operator=(const SilentStandardError&) = delete;

 private:
  int saved_;
};

/// @throw FileError
cv::Mat readPixels(const std::string& path, Content content) {
  if (content == Content::kExr) {
    // OpenCV has its OpenEXR reader switched off unless this says otherwise.
    static std::once_flag once;
    std::call_once(once, [] { setenv("OPENCV_IO_ENABLE_OPENEXR", "1", 0); });
  }
  cv::Mat pixels;
  try {
    const SilentStandardError silent;
    pixels = cv::imread(path, cv::IMREAD_UNCHANGED);
  } catch (const cv::Exception& error) {
    throw FileError(path + ": OpenCV cannot read it: " + error.err);
  }
  if (pixels.empty()) throw FileError(path + ": the image cannot be read: cut off, damaged, or of a kind OpenCV lacks");
  if (pixels.type() == CV_32SC1) pixels.convertTo(pixels, CV_64F);  // counts, all of them exact
  return pixels;
}

/// The sidecar's settings over those given. Both spellings, "pitch_x" and "scan/pitch_x", are the same key.
ScanOptions withSidecar(const std::string& path, const ScanOptions& given) {
  for (const std::string& sidecar : {path + ".yaml", fs::path(path).replace_extension(".yaml").string()}) {
    std::error_code error;
    if (sidecar == path || !fs::is_regular_file(sidecar, error)) continue;
    ScanOptions options = given;
    std::vector<std::string> lines;
    try {
      const YAML::Node tree = YAML::LoadFile(sidecar);
      YAML::Node scan(YAML::NodeType::Map);
      if (tree.IsMap()) {
        for (const auto& entry : tree) {
          const std::string key = entry.first.Scalar();
          const bool is_bare = key != "scan" && key.find('/') == std::string::npos;
          scan.force_insert(is_bare ? "scan/" + key : key, entry.second);
        }
      } else if (!tree.IsNull()) {
        scan = tree;
      }
      lines = readYaml(scan, [&options](OptionVisitor& visitor) { options.describe(visitor); });
    } catch (const YAML::Exception& yaml_error) {
      throw FileError(sidecar + ": not valid YAML: " + yaml_error.what());
    }
    if (options.height_scale == 0.0) lines.emplace_back("scan/height_scale: 0 is not allowed, must not be 0");
    for (std::string& line : lines) line.insert(0, sidecar + ": ");
    if (!lines.empty()) throw OptionsError(std::move(lines));
    return options;
  }
  return given;
}

HeightMap calibrated(const std::string& path, const cv::Mat& pixels, const ScanOptions& given,
                     const ScanFileOptions& options) {
  ScanOptions scan = withSidecar(path, given);
  if (options.pitch_x > 0.0) scan.pitch_x = options.pitch_x;
  if (options.pitch_y > 0.0) scan.pitch_y = options.pitch_y;
  if (scan.pitch_x == 0.0 || scan.pitch_y == 0.0) {
    throw FileError(path +
                    ": its pixel pitch is not stated: give --pitch, or scan/pitch_x and scan/pitch_y in the "
                    "configuration or in " +
                    fs::path(path).filename().string() + ".yaml");
  }
  try {
    return heightMapFromPixels(pixels, scan);
  } catch (const SurfaceError& error) {
    throw FileError(path + ": " + error.what());
  }
}

ScanFile withPitch(const ImportedScan& scan, const ScanFileOptions& options) {
  const double pitch_x = options.pitch_x > 0.0 ? options.pitch_x : scan.surface.pitchX();
  const double pitch_y = options.pitch_y > 0.0 ? options.pitch_y : scan.surface.pitchY();
  return {HeightMap(scan.surface.heights(), pitch_x, pitch_y), scan.channel};
}

ScanFile openImage(const std::string& path, Content content, const ScanOptions& scan, const ScanFileOptions& options) {
  if (content == Content::kTiff && hasParkTags(path)) return withPitch(importByGwyddion(path, options.import), options);
  const cv::Mat pixels = readPixels(path, content);
  if (pixels.channels() == 1 || pixels.type() == CV_32FC2) return {calibrated(path, pixels, scan, options), ""};
  const std::string refusal =
      path + ": " + std::to_string(pixels.channels()) + " channels per pixel are a picture, a height map has 1";
  if (content != Content::kTiff) throw FileError(refusal);
  try {  // some instruments write a picture of the scan, with the heights in tags of their own
    return withPitch(importByGwyddion(path, options.import), options);
  } catch (const FileError&) {
    throw FileError(refusal);
  }
}

/// Distance of float32 numbers near the largest height [m].
double singleSpacing(const HeightStatistics& statistics) {
  const auto largest = static_cast<float>(std::max(std::abs(statistics.min), std::abs(statistics.max)));
  return static_cast<double>(std::nextafter(largest, std::numeric_limits<float>::infinity())) - largest;
}

void writePixels(const std::string& path, const cv::Mat& pixels) {
  std::string cause = "cannot be written";
  bool written = false;
  try {
    // Uncompressed: every reader takes it, and nothing is lost.
    const std::vector<int> parameters = {cv::IMWRITE_TIFF_COMPRESSION, 1};
    // OpenCV chooses the format by the name; the caller's name may have any ending.
    std::vector<unsigned char> bytes;
    if (cv::imencode(".tiff", pixels, bytes, parameters)) {
      std::ofstream stream(path, std::ios::binary | std::ios::trunc);
      stream.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
      stream.close();
      written = stream.good();
    }
  } catch (const cv::Exception& error) {
    cause += ": " + error.err;
  }
  if (!written) throw FileError(path + ": " + cause);
}

/// True if the float32 pixels hold every height, or its absence.
bool isSame(const cv::Mat& heights, const cv::Mat& narrow) {
  for (int row = 0; row < heights.rows; ++row) {
    const double* wide_line = heights.ptr<double>(row);
    const float* narrow_line = narrow.ptr<float>(row);
    for (int col = 0; col < heights.cols; ++col) {
      if (wide_line[col] != static_cast<double>(narrow_line[col]) && !std::isnan(wide_line[col])) return false;
    }
  }
  return true;
}

std::vector<ScanChannel> channelList(const std::string& path, const std::vector<GwyChannel>& channels,
                                     const std::string& wanted) {
  std::vector<ScanChannel> list;
  for (const GwyChannel& channel : channels) {
    ScanChannel entry;
    entry.name = std::to_string(channel.id) + ": " + (channel.title.empty() ? "(no title)" : channel.title);
    entry.rows = channel.values.rows;
    entry.cols = channel.values.cols;
    entry.pitch_x = entry.cols > 0 ? channel.width / entry.cols : 0.0;
    entry.pitch_y = entry.rows > 0 ? channel.height / entry.rows : 0.0;
    entry.unit_xy = channel.unit_xy;
    entry.unit_z = channel.unit_z;
    list.push_back(entry);
  }
  if (list.empty()) throw FileError(path + ": the file has no image channel");
  try {
    list[chooseHeightChannel(channels, wanted)].is_chosen = true;
  } catch (const FileError&) {
    // None can be taken: the list shows why.
  }
  return list;
}

}  // namespace

ScanFile openScanFile(const std::string& path, const ScanOptions& scan, const ScanFileOptions& options) {
  const Content content = contentOf(path);
  switch (content) {
    case Content::kTiff:
    case Content::kPng:
    case Content::kExr:
      return openImage(path, content, scan, options);
    case Content::kText:
      return {calibrated(path, readTextGrid(path), scan, options), ""};
    case Content::kGwy:
      return withPitch(importChannel(path, readGwyFile(path), options.import.channel), options);
    case Content::kOther:
      break;
  }
  return withPitch(importByGwyddion(path, options.import), options);
}

std::vector<ScanChannel> listScanChannels(const std::string& path, const ScanOptions& scan,
                                          const ScanFileOptions& options) {
  const Content content = contentOf(path);
  const std::string& wanted = options.import.channel;
  if (content == Content::kGwy) return channelList(path, readGwyFile(path), wanted);
  if (content == Content::kOther || (content == Content::kTiff && hasParkTags(path))) {
    return channelList(path, channelsByGwyddion(path, options.import), wanted);
  }
  const cv::Mat pixels = content == Content::kText ? readTextGrid(path) : readPixels(path, content);
  if (content == Content::kTiff && pixels.channels() != 1 && pixels.type() != CV_32FC2) {
    return channelList(path, channelsByGwyddion(path, options.import), wanted);
  }
  const ScanOptions stated = withSidecar(path, scan);
  ScanChannel entry;
  entry.rows = pixels.rows;
  entry.cols = pixels.cols;
  entry.pitch_x = options.pitch_x > 0.0 ? options.pitch_x : stated.pitch_x;
  entry.pitch_y = options.pitch_y > 0.0 ? options.pitch_y : stated.pitch_y;
  entry.unit_xy = "m";
  entry.unit_z = stated.height_scale == 1.0 ? "m" : numberText(stated.height_scale) + " m";
  entry.is_chosen = pixels.channels() == 1 || pixels.type() == CV_32FC2;
  return {entry};
}

HeightMap readScanFile(const std::string& path, const ScanOptions& scan, const ScanFileOptions& options) {
  return openScanFile(path, scan, options).surface;
}

void writeHeightTiff(const std::string& path, const cv::Mat& heights) {
  cv::Mat pixels = heights;
  if (heights.depth() == CV_64F) {
    bool narrow = true;
    try {
      const HeightStatistics statistics = heightStatistics(HeightMap(heights, 1.0, 1.0));
      narrow = singleSpacing(statistics) <= 1e-3 * statistics.rms_height;
    } catch (const SurfaceError&) {
      // No valid pixel: NaN fits both.
    }
    if (narrow) heights.convertTo(pixels, CV_32F);
  }
  writePixels(path, pixels);
}

void writeScan(const std::string& path, const HeightMap& surface, const std::string& note) {
  cv::Mat pixels;
  surface.heights().convertTo(pixels, CV_32F);
  if (surface.heights().depth() == CV_64F && !isSame(surface.heights(), pixels)) pixels = surface.heights();
  writePixels(path, pixels);
  std::ofstream sidecar(path + ".yaml", std::ios::trunc);
  sidecar << "# " << note << "\n# Heights in metres: height = pixel x height_scale + height_offset.\n"
          << "pitch_x: " << yamlNumber(surface.pitchX()) << "\npitch_y: " << yamlNumber(surface.pitchY())
          << "\nheight_scale: 1.0\nheight_offset: 0.0\n";
  sidecar.close();
  if (!sidecar.good()) throw FileError(path + ".yaml: cannot be written");
}

}  // namespace mems_stiction
