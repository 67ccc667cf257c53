/// import_scan: instrument makers' files, and every other scan that can be read, into TIFF + YAML
/// that need no Gwyddion any more.

#include <sys/stat.h>

#include <cstdio>
#include <exception>
#include <filesystem>
#include <iostream>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "busy_line.hpp"
#include "command_line.hpp"
#include "errors/one_line.hpp"
#include "errors/plain_format.hpp"
#include "height_map/scan_sanity.hpp"
#include "height_map/validity.hpp"
#include "import/scan_writer.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "scans_ahead.hpp"

namespace {

using namespace mems_stiction;
namespace fs = std::filesystem;

struct Arguments {
  std::string output = ".";
  std::string channel;
  std::string pitch;  ///< "M" or "MX,MY"
  bool list = false;
  bool ignore_mask = false;
  std::vector<std::string> scans;
};

void describe(CLI::App& app, Arguments& arguments) {
  app.description(
      "Turns scans into float TIFFs in metres with their pitch beside them (NAME.tiff, "
      "NAME.tiff.yaml), to the last\n"
      "bit. predict_scan and make_scan_bag read those without Gwyddion.");
  app.add_option("SCAN", arguments.scans,
                 "instrument makers' files (most are read by Gwyddion's libraries), .gwy, TIFF, "
                 "PNG or EXR images of "
                 "heights, .npy, text grids and lists of x, y, z")
      ->required()
      ->type_name("");
  app.add_option("-o,--output", arguments.output, "folder to write to; made if it does not exist")
      ->type_name("FOLDER")
      ->capture_default_str();
  app.add_flag("-l,--list", arguments.list,
               "write nothing; print the channels of each file with size, pitch and unit, the one "
               "that would be taken "
               "marked with *");
  addChannelOption(app, arguments.channel);
  addMaskOption(app, arguments.ignore_mask);
  app.add_option("-p,--pitch", arguments.pitch,
                 "distance of neighbouring pixels [m]; MX,MY where columns and rows differ. Goes "
                 "before what files say")
      ->type_name("M");
  app.footer(
      "Exit status: 0, or 2 if a file could not be imported (one line on stderr names it and the "
      "cause; the others of\n"
      "the call are still imported). Bags: make_scan_bag -o OUT.bag SCAN... takes the same "
      "files.\n\n"
      "Example: import_scan --output scans wafer3.di wafer4.x3p");
}

std::string unitText(const std::string& unit) { return unit.empty() ? "no unit" : unit; }

/// At least as wide.
std::string padded(std::string text, std::size_t width, bool to_right = false) {
  if (text.size() < width) text.insert(to_right ? 0 : text.size(), width - text.size(), ' ');
  return text;
}

void printChannels(const std::string& path, const ScanFileOptions& options) {
  const std::vector<ScanChannel> channels = listScanChannels(path, {}, options);
  std::cout << oneLine(path) << "\n";
  for (const ScanChannel& channel : channels) {
    std::string pitch = "pitch not stated";
    if (channel.pitch_x > 0.0 && channel.pitch_y > 0.0) {
      pitch = plainFormat("pitch %.6g x %.6g ", channel.pitch_x, channel.pitch_y) +
              unitText(oneLine(channel.unit_xy));
    }
    const std::string size = std::to_string(channel.cols) + " x " + std::to_string(channel.rows);
    std::cout << "  " << (channel.is_chosen ? '*' : ' ') << " "
              << padded(channel.name.empty() ? "(single channel)" : oneLine(channel.name), 28)
              << " " << padded(size, 13, true) << " pixels  " << padded(pitch, 34) << " heights in "
              << unitText(oneLine(channel.unit_z))
              << (channel.is_unit_assumed ? " (unit not stated)" : "") << "\n";
  }
  std::cout << std::flush;
}

using FileNumber = std::pair<dev_t, ino_t>;  ///< the same for all names and links of a file

/// @return none if there is no such file
std::optional<FileNumber> fileOf(const std::string& path) {
  struct stat status {};
  if (stat(path.c_str(), &status) != 0) return std::nullopt;
  return FileNumber{status.st_dev, status.st_ino};
}

std::set<FileNumber> filesOf(const std::vector<std::string>& paths) {
  std::set<FileNumber> files;
  for (const std::string& path : paths) {
    if (const auto file = fileOf(path)) files.insert(*file);
  }
  return files;
}

/// Keeps track of what was written, so that no two scans of a call end in one file and no input is
/// overwritten.
class Importer {
 public:
  Importer(const Arguments& arguments, const ScanFileOptions& options)
      : arguments_(arguments),
        ahead_({}, options, std::nullopt, 1),
        inputs_(filesOf(arguments.scans)) {
    ahead_.expect(arguments.scans);
  }

  /// @throw Error in one line, with the file's name
  void import(const std::string& path) {
    const ScanAhead ahead = whileSaying(path + ": reading", [&] { return ahead_.take(path); });
    if (ahead.failure) std::rethrow_exception(ahead.failure);
    const ScanFile& scan = ahead.scan;
    fs::path target = fs::path(arguments_.output) / fs::path(path).filename();
    target.replace_extension(".tiff");
    if (!written_.insert(target.string()).second) {
      throw FileError(path + ": " + target.string() +
                      " was written for another scan of this call; import it alone");
    }
    const auto there = fileOf(target.string());
    if (there && inputs_.count(*there) > 0) {
      throw FileError(path + ": " + target.string() +
                      " is a scan of this call; choose another --output");
    }
    if (!isAsWritten(target.string())) {
      throw FileError(path + ": " + target.string() +
                      " or its .yaml is there and is not as import_scan wrote it: remove both, or "
                      "choose another --output");
    }
    const std::string of_channel = scan.channel.empty() ? "" : ", channel " + scan.channel;
    ScanIdentity identity = scan.identity;
    const std::string target_name = oneLine(target.stem().string());
    if (identity.scan_name == target_name) identity.scan_name.clear();  // the target's, too
    writeScan(target.string(), scan.surface,
              fs::path(path).filename().string() + of_channel + ", " + scan.identity.checksum,
              identity);
    for (const std::string& note : scan.notes) warn(path, note);
    for (const std::string& warning : scanWarnings(scan.surface)) warn(path, warning);
    report(path, target.string(), scan);
  }

 private:
  static void report(const std::string& path, const std::string& target, const ScanFile& scan) {
    const HeightMap& surface = scan.surface;
    const std::string figures = plainFormat("%d x %d pixels of %.6g x %.6g m, %.3g %% missing",
                                            surface.cols(), surface.rows(), surface.pitchX(),
                                            surface.pitchY(), 100.0 * invalidFraction(surface));
    std::cout << oneLine(path) << (scan.channel.empty() ? "" : " [" + oneLine(scan.channel) + "]")
              << " -> " << oneLine(target) << ": " << figures;
    const ScanIdentity& identity = scan.identity;
    for (const std::string& text :
         {identity.acquisition_time, identity.instrument, identity.operator_name}) {
      if (!text.empty()) std::cout << ", " << oneLine(text);
    }
    std::cout << std::endl;
  }

  const Arguments& arguments_;
  std::set<std::string> written_;
  ScansAhead ahead_;  ///< while one is written others are read
  std::set<FileNumber> inputs_;
};

int run(const Arguments& arguments) {
  ScanFileOptions options;
  options.import.channel = arguments.channel;
  options.import.ignore_mask = arguments.ignore_mask;
  try {
    applyPitch(arguments.pitch, options);
    if (!arguments.list) {
      std::error_code error;
      fs::create_directories(arguments.output, error);
      if (error)
        throw FileError(arguments.output + ": the folder cannot be made: " + error.message());
    }
  } catch (const Error& error) {
    complain("import_scan", error.what());
    return kBadInput;
  }
  if (arguments.list) {
    return forEachScan("import_scan", arguments.scans,
                       [&](const std::string& path) { printChannels(path, options); });
  }
  Importer importer(arguments, options);
  return forEachScan("import_scan", arguments.scans,
                     [&](const std::string& path) { importer.import(path); });
}

}  // namespace

int main(int argc, char** argv) {
  return runProgram<Arguments>("import_scan", argc, argv, describe, [](Arguments arguments) {
    arguments.scans = scansOf(arguments.scans);
    return run(arguments);
  });
}
