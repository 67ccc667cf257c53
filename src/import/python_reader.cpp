#include "import/python_reader.hpp"

#include <filesystem>
#include <fstream>

#include "files/child_process.hpp"
#include "files/interruption.hpp"
#include "import/file_bytes.hpp"
#include "import/format_readers.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "mems_stiction/settings/option_visitor.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

ChildResult runScript(const std::string& python, const std::string& script, const std::string& path,
                      const std::string& folder, double timeout) {
  return runChild({python, "-c", script, path, folder},
                  environmentWithout({}, {"PYTHONIOENCODING=utf-8"}), folder + "/log", timeout);
}

FileChannel channelOf(const std::string& line, const std::string& npy, int id) {
  std::vector<std::string> words(1);
  for (const char c : line) {
    if (c == '\t') {
      words.emplace_back();
    } else {
      words.back() += c;
    }
  }
  if (words.size() != 5) throw FileError("damaged");
  FileChannel channel = parseNpy(npy);
  channel.takes_settings = false;
  channel.id = id;
  channel.title = words[0];
  channel.width = plainNumber(words[1]);
  channel.height = plainNumber(words[2]);
  if (channel.width > 0.0 && channel.height > 0.0) channel.unit_xy = "m";
  channel.unit_z = words[3];
  if (!words[4].empty()) channel.notes.push_back(words[4]);
  return channel;
}

}  // namespace

PythonReading channelsByPython(const std::string& script, const std::string& library,
                               const std::string& path, double timeout) {
  const PrivateFolder folder;
  const std::string target = folder.path().string();
  const std::string file = fs::absolute(path).string();
  ChildResult result = runScript("python3", script, file, target, timeout);
  if (!result.started || result.exit_code == kPythonHasNoLibrary) {
    const ChildResult other = runScript("/usr/bin/python3", script, file, target, timeout);
    if (other.started) result = other;
  }
  if (result.timed_out) {
    throw FileError(library + " did not finish within " + numberText(timeout) +
                    " s and was stopped");
  }
  if (result.signal != 0) throw FileError(library + " crashed on this file: it is damaged");
  PythonReading read;
  read.is_library_missing = !result.started || result.exit_code == kPythonHasNoLibrary;
  if (result.exit_code == kPythonReadsNoChannel || result.exit_code == kPythonRefuses) {
    std::ifstream remark(target + "/remark");
    for (std::string line; std::getline(remark, line);)
      read.remark += (read.remark.empty() ? "" : ", ") + line;
  }
  if (result.exit_code == kPythonRefuses) throw FileError(read.remark);
  if (read.is_library_missing || result.exit_code == kPythonReadsNoChannel) return read;
  std::ifstream list(target + "/channels");
  if (result.exit_code != 0 || !list)
    throw FileError("its layout is known, but what it should have is not there");
  int id = 0;
  for (std::string line; std::getline(list, line); ++id) {
    read.channels.push_back(
        channelOf(line, readFileBytes(target + "/" + std::to_string(id) + ".npy"), id));
  }
  return read;
}

}  // namespace mems_stiction
