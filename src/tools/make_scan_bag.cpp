/// make_scan_bag: a bag of scans as the node takes them, from generated rough surfaces or from scan
/// files.

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cmath>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <iostream>
#include <memory>
#include <optional>
#include <random>
#include <stdexcept>
#include <string>
#include <vector>

#include <rosbag/bag.h>
#include <opencv2/core/utils/logger.hpp>

#include "busy_line.hpp"
#include "command_line.hpp"
#include "files/interruption.hpp"
#include "height_map/scan_sanity.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "numeric/words.hpp"
#include "ros/image_conversion.hpp"
#include "ros/topic_names.hpp"
#include "surface/gaussian_surface.hpp"

namespace {

using namespace mems_stiction;
namespace fs = std::filesystem;

struct Arguments {
  std::string bag;
  std::vector<std::string> scans;
  int count = 0;
  ScanIdentity identity;  ///< of all scans, before what their files say
  double rate = 10.0;
  double first_stamp = 1e9;  ///< [s]; fixed, so that the same call gives the same bag
  double pitch = 0.0;
  double correlation_length = 80e-9;
  std::vector<double> rms_heights{1e-9, 20e-9};
  GaussianSurfaceOptions surface;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Writes scans to a bag: topics /height (metres; 32FC1, or 64FC1 where that would round) and "
      "/scan_info, with\n"
      "the same stamps. A scan of the bag is predicted to the bits of its file.\n"
      "Without files, generates Gaussian rough surfaces from smooth to rough.");
  app.add_option("-o,--output", arguments.bag, "the bag; replaced if it exists")
      ->required()
      ->type_name("OUT.bag");
  app.add_option("scans", arguments.scans, "scan files, of every kind that predict_scan reads")
      ->type_name("SCAN");
  app.add_option("-n,--count", arguments.count,
                 "generated surfaces; 1 if there are no files, else 0")
      ->check(CLI::Range(1, 1000000));
  app.add_option("--rows", arguments.surface.rows, "of generated surfaces")->capture_default_str();
  app.add_option("--cols", arguments.surface.cols, "of generated surfaces")->capture_default_str();
  app.add_option("--pitch", arguments.pitch,
                 "distance of neighbouring pixels [m]; 10e-9 for generated surfaces; for files, "
                 "instead of what they say")
      ->check(positive)
      ->type_name("M");
  app.add_option("--rms-height", arguments.rms_heights,
                 "rms height [m]; two values: of the first and the last surface, the others "
                 "between in equal ratios")
      ->expected(1, 2)
      ->type_name("M")
      ->capture_default_str();
  app.add_option("--correlation-length", arguments.correlation_length, "of generated surfaces [m]")
      ->type_name("M")
      ->capture_default_str();
  app.add_option("--seed", arguments.surface.seed,
                 "of the first surface; each further one takes the next")
      ->capture_default_str();
  app.add_option("--part-id", arguments.identity.part_id,
                 "of scan_info: the part that all these scans are places of");
  app.add_option("--serial-id", arguments.identity.serial_id, "of scan_info: its serial number");
  app.add_option("--lot-id", arguments.identity.lot_id,
                 "of scan_info: the lot that its wafer is of");
  app.add_option("--wafer-id", arguments.identity.wafer_id,
                 "of scan_info: the wafer that it is of");
  app.add_option("--rate", arguments.rate, "scans per second [Hz]")
      ->check(positive)
      ->capture_default_str();
  app.add_option("--first-stamp", arguments.first_stamp,
                 "of the first scan [s]: one node takes scans of one stamp for the same, so bags "
                 "that it is to hear need stamps of their own")
      ->check(CLI::Range(1.0, 4e9))
      ->type_name("S")
      ->capture_default_str();
  app.footer(
      "Exit status: 0, or 2 for bad input (one line on stderr for each; the other scans are still "
      "written).");
}

/// A new, empty file, by a name that nobody can guess: what lies there already, as a link, is never
/// written to.
/// @throw std::runtime_error naming the file
std::string newFileBeside(const std::string& path) {
  std::random_device random;
  for (;;) {
    const std::string name = path + "." + std::to_string(random()) + ".part";
    const int descriptor = open(name.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor >= 0) {
      close(descriptor);
      return name;
    }
    if (errno != EEXIST)
      throw std::runtime_error(path + ": cannot be written: " + std::strerror(errno));
  }
}

/// A bag that has its name when it is whole: what was there before stays if it cannot be written.
class ScanBag {
 public:
  explicit ScanBag(const Arguments& arguments)
      : path_(arguments.bag),
        first_stamp_(arguments.first_stamp),
        period_(1.0 / arguments.rate),
        given_(arguments.identity) {
    const std::string& path = path_;
    std::error_code error;
    if (fs::exists(path, error) && !fs::is_regular_file(path, error)) {
      throw FileError(path + ": is a folder, a pipe or a device; a bag is written to a file");
    }
    if (fs::path(path).extension() != ".bag") {
      throw OptionsError({"--output: '" + path + "' is not allowed, must end in .bag"});
    }
    const fs::path folder = fs::path(path).parent_path();
    if (!folder.empty() && !fs::is_directory(folder, error)) {
      throw FileError(path + ": cannot be written: there is no folder '" + folder.string() + "'");
    }
    // It is made while no interruption is handled: one that came before would remove nothing, and
    // the file would stay.
    partial_.emplace([&] {
      std::string partial = newFileBeside(path);
      guarded(partial, [&] { bag_->open(partial, rosbag::bagmode::Write); });
      return partial;
    });
  }
  ~ScanBag() {
    if (!is_whole_ && partial_) giveUp(partial_->path());
  }
  ScanBag(const ScanBag&) = delete;
  ScanBag& operator=(const ScanBag&) = delete;

  /// - @p stated of the scan by its file
  void write(const HeightMap& surface, const std::string& frame, const ScanIdentity& stated = {}) {
    std_msgs::Header header;
    header.seq = count_;
    header.stamp = ros::Time(first_stamp_) + ros::Duration(count_ * period_);
    header.frame_id = frame;
    ++count_;
    for (const std::string& warning : scanWarnings(surface)) warn(frame, warning);
    ScanOptions calibration;
    calibration.pitch_x = surface.pitchX();
    calibration.pitch_y = surface.pitchY();
    ScanInfo info = scanInfoMessage(calibration, header);
    fillIdentity(withGiven(stated, frame), info);
    guarded(partial_->path(), [&] {
      bag_->write(absolute(kHeightTopic), header.stamp,
                  *exactHeightImage(surface.heights(), header));
      bag_->write(absolute(kScanInfoTopic), header.stamp, info);
    });
  }

  void finish() {
    guarded(partial_->path(), [&] { bag_->close(); });
    is_whole_ = std::rename(partial_->path().c_str(), path_.c_str()) == 0;
    if (!is_whole_)
      throw std::runtime_error(path_ + ": cannot be written: " + std::strerror(errno));
  }

  std::uint32_t count() const { return count_; }

 private:
  ScanIdentity withGiven(ScanIdentity identity, const std::string& frame) const {
    if (identity.scan_name == frame) identity.scan_name.clear();  // the image says it
    for (std::string ScanIdentity::*name : {&ScanIdentity::part_id, &ScanIdentity::serial_id,
                                            &ScanIdentity::lot_id, &ScanIdentity::wafer_id}) {
      if (!(given_.*name).empty()) identity.*name = given_.*name;
    }
    return identity;
  }

  /// As `rosbag record` names topics, so that filters and prefixes find them.
  static std::string absolute(const std::string& topic) { return "/" + topic; }

  /// Nothing of it stays. The bag lives to the end of the process: closing writes, and would fail
  /// in its destructor.
  void giveUp(const std::string& partial) {
    [[maybe_unused]] const auto* const left_open = bag_.release();
    std::error_code ignored;
    fs::remove(partial, ignored);
  }

  /// @throw std::runtime_error, which ends the program: no scan can be written after it
  template <typename Function>
  void guarded(const std::string& partial, Function&& function) {
    errno = 0;
    try {
      function();
    } catch (const rosbag::BagException& error) {
      const std::string reason = errno != 0 ? std::strerror(errno) : error.what();
      giveUp(partial);
      throw std::runtime_error(path_ + ": cannot be written: " + reason);
    }
  }

  std::string path_;
  std::unique_ptr<rosbag::Bag> bag_ = std::make_unique<rosbag::Bag>();
  std::optional<ScratchPath> partial_;
  bool is_whole_ = false;
  double first_stamp_;
  double period_;
  ScanIdentity given_;
  std::uint32_t count_ = 0;
};

std::string stemOf(const std::string& path) {
  const std::string name = path.substr(path.find_last_of('/') + 1);
  return name.substr(0, name.find_last_of('.'));
}

/// Rms height of surface `index` of `count` [m].
double rmsHeight(const std::vector<double>& ends, int index, int count) {
  if (ends.size() == 1 || count == 1) return ends.front();
  return ends.front() *
         std::pow(ends.back() / ends.front(), static_cast<double>(index) / (count - 1));
}

void writeGenerated(const Arguments& arguments, int count, ScanBag& bag) {
  GaussianSurfaceOptions options = arguments.surface;
  if (arguments.pitch > 0.0) options.pitch_x = options.pitch_y = arguments.pitch;
  options.correlation_length_x = options.correlation_length_y = arguments.correlation_length;
  for (int index = 0; index < count; ++index, ++options.seed) {
    options.rms_height = rmsHeight(arguments.rms_heights, index, count);
    const std::string doing =
        "surface " + std::to_string(index + 1) + " of " + std::to_string(count);
    bag.write(whileSaying(doing, [&] { return gaussianSurface(options); }), "scan");
  }
}

int run(const Arguments& arguments) {
  cv::utils::logging::setLogLevel(
      cv::utils::logging::LOG_LEVEL_SILENT);  // we name what is wrong ourselves
  int status = 0;
  ScanFileOptions file_options;
  file_options.pitch_x = file_options.pitch_y = arguments.pitch;
  file_options.pitch_option = "--pitch";
  ScanBag bag(arguments);
  for (const std::string& path : scansOf(arguments.scans)) {
    std::optional<ScanFile> scan;
    try {
      if (fs::path(path).extension() == ".bag")
        throw FileError(path + ": is a bag already; rosbag filter joins bags");
      scan = whileSaying(path + ": reading", [&] { return openScanFile(path, {}, file_options); });
      for (const std::string& note : scan->notes) warn(path, note);
    } catch (const Error& error) {
      complain("make_scan_bag", error.what());
      status = kBadInput;
    }
    if (scan) bag.write(scan->surface, stemOf(path), scan->identity);
  }
  const int default_count = arguments.scans.empty() ? 1 : 0;
  writeGenerated(arguments, arguments.count > 0 ? arguments.count : default_count, bag);
  if (bag.count() == 0) {
    complain("make_scan_bag", arguments.bag + ": not written: there is no scan for it");
    return kBadInput;
  }
  bag.finish();
  std::cout << oneLine(arguments.bag) << ": " << countText(bag.count(), "scan") << "\n";
  return status;
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram<Arguments>("make_scan_bag", argc, argv, describe, run);
}
