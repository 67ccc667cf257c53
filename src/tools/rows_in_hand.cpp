#include "rows_in_hand.hpp"

#include <cstring>
#include <filesystem>
#include <sstream>
#include <vector>

#include "files/child_process.hpp"
#include "files/input_file.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

constexpr InputKind kInHand = {"the number of rows in hand", 100};
constexpr double kLongestProbe = 3600.0;  // [s]

std::vector<std::string> probeCommand(const BatchArguments& arguments, const std::string& input,
                                      const std::string& shard, const std::string& output) {
  std::vector<std::string> command = {fs::read_symlink("/proc/self/exe").string(),
                                      "--output=" + output, "--shard=" + shard,
                                      "--topic=" + arguments.topic};
  if (!arguments.configuration.empty()) command.push_back("--config=" + arguments.configuration);
  if (arguments.voltage) command.push_back("--voltage=" + numberText(*arguments.voltage));
  if (arguments.load) command.push_back("--load=" + numberText(*arguments.load));
  if (arguments.half_space) command.emplace_back("--half-space");
  command.emplace_back(arguments.rowsHaveDeviceForce() ? "--device-force" : "--no-device-force");
  if (arguments.accept_implausible) command.emplace_back("--accept-implausible");
  if (arguments.ignore_mask) command.emplace_back("--ignore-mask");
  command.insert(command.end(), {"--", input});
  return command;
}

}  // namespace

RowsInHand::RowsInHand(const std::string& rows_path, std::size_t count) {
  std::error_code none;
  if (!fs::is_regular_file(rows_path, none)) return;
  std::string path = rows_path + ".in_hand";
  if (fs::exists(path, none)) {
    std::istringstream text(readInput(path, kInHand));
    if (!(text >> left_)) left_ = count;
  }
  path_.emplace([&] { return path; });
  writeFile(path, std::to_string(count) + "\n", OutputSafety::kWhole);
}

RowsInHand::~RowsInHand() {
  std::error_code ignored;
  if (path_) fs::remove(path_->path(), ignored);
}

std::string causeOfDeath(const BatchArguments& arguments, const std::string& input,
                         const std::string& shard) {
  const PrivateFolder folder;
  const ChildResult result =
      runChild(probeCommand(arguments, input, shard, (folder.path() / "row.jsonl").string()),
               environmentWithout({}, {}), (folder.path() / "log").string(), kLongestProbe);
  if (result.timed_out) return "ended an earlier call, and takes more than an hour: passed over";
  if (result.signal == 0) return "";
  return "ended an earlier call, and ends the program by signal " + std::to_string(result.signal) +
         " (" + strsignal(result.signal) + "): passed over";
}

}  // namespace mems_stiction
