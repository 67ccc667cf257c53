#include "device_picture.hpp"

#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <vector>

#include "files/child_process.hpp"
#include "files/interruption.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"
#include "npy_file.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr const char* kScript = "plot_device";
/// Of the script [s]; it takes two.
constexpr double kTimeout = 300.0;

/// The script beside this program; its plain name, to be looked up in PATH, where there is none.
std::string scriptBeside() {
  std::error_code ignored;
  const fs::path beside = fs::read_symlink("/proc/self/exe", ignored).parent_path() / kScript;
  return access(beside.c_str(), X_OK) == 0 ? beside.string() : kScript;
}

/// What the script said last.
std::string complaint(const fs::path& log) {
  std::ifstream stream(log);
  std::string last;
  for (std::string line; std::getline(stream, line);) {
    if (!line.empty()) last = line;
  }
  const std::string own = std::string(kScript) + ": ";
  return startsWith(last, own) ? last.substr(own.size()) : last;
}

}  // namespace

void drawDevice(const std::string& record, const HeightMap& made_surface, const std::string& path) {
  const PrivateFolder folder;
  const fs::path file = folder.path() / "record.json";
  writeFile(file.string(), record + "\n", OutputSafety::kWhole);
  const fs::path log = folder.path() / "log";
  std::vector<std::string> command = {scriptBeside(), "-o", path};
  if (!made_surface.empty()) {
    const std::string heights = folder.path() / "heights.npy";
    writeNpy(heights, made_surface.heights());
    for (const std::string& word : {std::string("--heights"), heights, std::string("--pitch"),
                                    numberText(made_surface.pitchX())}) {
      command.push_back(word);
    }
  }
  command.push_back(file.string());
  const ChildResult result = runChild(command, environmentWithout({}, {}), log.string(), kTimeout);
  if (!result.started) {
    throw FileError(
        "--picture: needs the program plot_device of the Python package, which was not found");
  }
  if (result.exit_code == 0) return;
  const std::string said = complaint(log);
  throw FileError("--picture: '" + path +
                  "' was not drawn: " + (said.empty() ? "plot_device was stopped" : said));
}

}  // namespace mems_stiction
