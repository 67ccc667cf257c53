#include "command_line.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>

#include "files/output_file.hpp"
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

}  // namespace

std::string parseFailure(const CLI::App& app, const CLI::Error& error) {
  constexpr const char* kHelp = "; --help shows all options";
  const std::string what = error.what();
  if (dynamic_cast<const CLI::ConversionError*>(&error) != nullptr) {  // "Could not convert: --voltage = 20V"
    const std::string pair = after(what, ": ");
    const std::string value = after(pair, " = ");
    if (!value.empty()) {
      return pair.substr(0, pair.find(" = ")) + ": '" + value +
             "' is not allowed, must be a number: without its unit, and with a point as the decimal sign";
    }
  }
  if (dynamic_cast<const CLI::ExtrasError*>(&error) != nullptr) {  // "The following argument was not expected: --piych"
    const std::string first = after(what, ": ");
    const std::size_t start = first.rfind("--", 0) == 0 ? 0 : first.find(" --") + 1;  // CLI11 names its value before it
    const std::string option = first.substr(start, first.find_first_of(" =", start) - start);
    if (option.rfind("--", 0) == 0) {
      return option + ": there is no such option" + suggestion(option, namesOf(app)) + kHelp;
    }
    return first + ": is not expected here" + kHelp;
  }
  return what + kHelp;
}

void requireOutput(const std::string& option, const std::string& path, const std::vector<std::string>& inputs) {
  if (path.empty()) return;
  const auto refuse = [&](const std::string& why) { throw OptionsError({option + ": '" + path + "' " + why}); };
  std::error_code ignored;
  for (const std::string& input : inputs) {
    if (fs::equivalent(path, input, ignored)) refuse("is what is read, which would be lost; give another name");
  }
  if (fs::is_directory(path, ignored)) refuse("is a folder, must be a file");
  if (isLonelyPipe(path)) refuse(kLonelyPipe);
  const fs::path parent = fs::path(path).has_parent_path() ? fs::path(path).parent_path() : fs::path(".");
  if (!fs::is_directory(parent, ignored)) refuse("cannot be written: there is no folder '" + parent.string() + "'");
  const bool exists = fs::exists(path, ignored);
  if (access(exists ? path.c_str() : parent.c_str(), W_OK) != 0)
    refuse(std::string("cannot be written: ") + std::strerror(errno));
}

std::string positive(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  const bool is_number = !text.empty() && *end == '\0';  // else the conversion says so
  return is_number && !Range::positive().contains(value) ? "'" + text + "' is not allowed, must be > 0" : "";
}

void addChannelOption(CLI::App& app, std::string& channel) {
  app.add_option("--channel", channel, "title or number of the channel to take from an instrument maker's file")
      ->type_name("NAME");
}

void addMaskOption(CLI::App& app, bool& ignore_mask) {
  app.add_flag("--ignore-mask", ignore_mask,
               "pixels under the mask of a .gwy file are heights as the others, not missing");
}

}  // namespace mems_stiction
