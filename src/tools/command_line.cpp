#include "command_line.hpp"

#include <unistd.h>

#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <iterator>

#include "errors/plain_format.hpp"
#include "files/output_file.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "numeric/words.hpp"

namespace mems_stiction {
namespace {

namespace fs = std::filesystem;

/// What follows the first `mark`; empty without it.
std::string after(const std::string& text, const std::string& mark) {
  const std::size_t place = text.find(mark);
  return place == std::string::npos ? "" : text.substr(place + mark.size());
}

std::vector<std::string> namesOf(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::Option* option : app.get_options()) {
    for (const std::string& name : option->get_lnames()) names.push_back("--" + name);
  }
  return names;
}

/// Not hidden, and not of an ending that no scan has.
bool mayHoldScan(const fs::path& file) {
  constexpr const char* kOthers[] = {".yaml", ".yml", ".md",   ".rst",   ".html", ".pdf",
                                     ".py",   ".sh",  ".json", ".jsonl", ".log",  ".zip"};
  const std::string name = file.filename().string();
  return name.front() != '.' && std::find(std::begin(kOthers), std::end(kOthers),
                                          file.extension().string()) == std::end(kOthers);
}

}  // namespace

std::vector<std::string> scansOf(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    if (!fs::is_directory(path, error) ||
        fs::path(path).extension() == ".bag") {  // a bag that is a folder is a slip
      files.push_back(path);
      continue;
    }
    std::vector<std::string> inside;
    for (fs::directory_iterator entry(path, error), end; !error && entry != end;
         entry.increment(error)) {
      std::error_code ignored;
      if (entry->is_regular_file(ignored) && mayHoldScan(entry->path()))
        inside.push_back(entry->path().string());
    }
    if (error) throw FileError(path + ": cannot be read: " + error.message());
    if (inside.empty()) throw FileError(path + ": holds no scan file");
    std::sort(inside.begin(), inside.end());
    files.insert(files.end(), inside.begin(), inside.end());
  }
  return withoutSidecars(files);
}

bool asksVersion(int argc, char** argv) {
  for (int i = 1; i < argc && std::strcmp(argv[i], "--") != 0; ++i) {
    if (std::strcmp(argv[i], "--version") == 0) return true;
  }
  return false;
}

void addVersion(CLI::App& app) { app.add_flag("--version", "print the version and end"); }

void printVersion(const std::string& program) {
  std::cout << program << " of mems_stiction " << packageVersion() << std::endl;
}

std::string parseFailure(const CLI::App& app, const CLI::Error& error) {
  constexpr const char* kHelp = "; --help shows all options";
  const std::string what = error.what();
  if (dynamic_cast<const CLI::ConversionError*>(&error) !=
      nullptr) {  // "Could not convert: --voltage = 20V"
    const std::string pair = after(what, ": ");
    const std::string value = after(pair, " = ");
    if (!value.empty()) {
      return pair.substr(0, pair.find(" = ")) + ": '" + value +
             "' is not allowed, must be a number: without its unit, and with a point as the "
             "decimal sign";
    }
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) !=
      nullptr) {  // "The following argument was not expected: --piych"
    const std::string first = after(what, ": ");
    const std::size_t start =
        startsWith(first, "--") ? 0 : first.find(" --") + 1;  // CLI11 names its value before it
    const std::string option = first.substr(start, first.find_first_of(" =", start) - start);
    if (startsWith(option, "--")) {
      return option + ": there is no such option" + suggestion(option, namesOf(app)) + kHelp;
    }
    return first + ": is not expected here" + kHelp;
  }
  return what + kHelp;
}

void requireOutput(const std::string& option, const std::string& path,
                   const std::vector<std::string>& inputs) {
  if (path.empty()) return;
  const auto refuse = [&](const std::string& why) {
    throw OptionsError({option + ": '" + path + "' " + why});
  };
  std::error_code ignored;
  for (const std::string& input : inputs) {
    if (fs::equivalent(path, input, ignored))
      refuse("is what is read, which would be lost; give another name");
  }
  if (fs::is_directory(path, ignored)) refuse("is a folder, must be a file");
  if (isLonelyPipe(path)) refuse(kLonelyPipe);
  const fs::path parent =
      fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored))
    refuse("cannot be written: there is no folder '" + parent.string() + "'");
  const bool exists = fs::exists(path, ignored);
  if (access(exists ? path.c_str() : parent.c_str(), W_OK) != 0)
    refuse(std::string("cannot be written: ") + std::strerror(errno));
}

std::string positive(const std::string& text) {
  char* end = nullptr;
  const double value = plainStrtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0';  // else the conversion says so
  return is_number && !Range::positive().contains(value)
             ? "'" + text + "' is not allowed, must be > 0"
             : "";
}

std::string notLost(const std::string& text) {
  char* end = nullptr;
  const double value = plainStrtod(text.c_str(), &end);
  return *end == '\0' && isLostInReading(text, value)
             ? "'" + text + "' is not allowed: too near to 0 for a number; write 0 for none"
             : "";
}

Configuration configurationFile(const std::string& path, bool accept_implausible) {
  Configuration configuration;
  configuration.limits.accept_implausible = accept_implausible;
  return path.empty() ? configuration : loadConfiguration(path, configuration);
}

int strictStatus(const std::string& program, bool is_strict, int status) {
  if (!is_strict || status != 0 || warningCount() == 0) return status;
  complain(program, std::to_string(warningCount()) +
                        (warningCount() == 1 ? " warning" : " warnings") +
                        ", and --strict takes none");
  return kStrict;
}

void addChannelOption(CLI::App& app, std::string& channel) {
  app.add_option("--channel", channel,
                 "title or number of the channel to take from an instrument maker's file")
      ->type_name("NAME");
}

void addMaskOption(CLI::App& app, bool& ignore_mask) {
  app.add_flag("--ignore-mask", ignore_mask,
               "pixels under the mask of a .gwy file are heights as the others, not missing");
}

}  // namespace mems_stiction
