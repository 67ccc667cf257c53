#include "scan_sweep.hpp"

#include <cmath>
#include <sstream>

#include "errors/plain_format.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kMostRows = 10000;  // of the record of one scan: each is a prediction and a line

[[noreturn]] void refuseNumbers(const std::string& option, const std::string& text,
                                const std::string& why) {
  throw OptionsError({option + ": '" + text + "' is not allowed" + why});
}

std::vector<std::string> piecesOf(const std::string& text, char mark) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, mark);) parts.push_back(part);
  if (!text.empty() && text.back() == mark) parts.emplace_back();
  return parts;
}

/// "05": what a decimal comma leaves of 0,05.
bool looksLikeDecimals(const std::string& part) {
  const std::size_t at = part.find_first_not_of(" +-");
  return at != std::string::npos && at + 1 < part.size() && part[at] == '0' &&
         part[at + 1] >= '0' && part[at + 1] <= '9';
}

double rowsOf(std::size_t voltages, std::size_t loads) {
  return (2.0 * static_cast<double>(voltages) - 1.0) * static_cast<double>(loads);
}

}  // namespace

void addSweepOptions(CLI::App& app, SweepArguments& arguments) {
  app.add_option(
         "--sweep-voltage", arguments.voltages,
         "sweep the voltage [V] up through these and down again: lands, sticks after it, opens; "
         "rows in the "
         "record (sweep: points) and a table at its end, as sweep_load has them of a running node")
      ->type_name("FIRST:LAST:STEP|V,V,...");
  app.add_option("--sweep-load", arguments.loads,
                 "with a loop of the voltage for each of these forces on the scanned area [N]; "
                 "without it at the load "
                 "that is set")
      ->type_name("FIRST:LAST:STEP|N,N,...");
}

std::vector<double> numbersOf(const std::string& option, const std::string& text) {
  const bool is_range = text.find(':') != std::string::npos;
  const std::vector<std::string> parts = piecesOf(text, is_range ? ':' : ',');
  std::vector<double> values;
  for (const std::string& part : parts) {
    if (looksLikeDecimals(part))
      refuseNumbers(option, text, ": commas stand between numbers, the decimal sign is a point");
    char* end = nullptr;
    const double value = plainStrtod(part.c_str(), &end);
    const bool is_number =
        end != part.c_str() && part.find_first_not_of(' ', end - part.c_str()) == std::string::npos;
    if (is_number && isLostInReading(part, value))
      refuseNumbers(option, text, ": " + part + " is too near to 0 for a number");
    if (!is_number || !std::isfinite(value)) break;
    values.push_back(value);
  }
  if (values.empty() || values.size() != parts.size() || (is_range && values.size() != 3)) {
    refuseNumbers(option, text, ", must be numbers with commas between, or FIRST:LAST:STEP");
  }
  if (!is_range) return values;
  const double first = values[0], last = values[1], step = values[2];
  if (!(step > 0.0)) refuseNumbers(option, text, ", the step must be > 0");
  if (first > last) {
    refuseNumbers(option, text,
                  ": nothing lies from " + numberText(first) + " up to " + numberText(last) +
                      "; the way down follows by itself");
  }
  if ((last - first) / step > kMostRows) {
    refuseNumbers(option, text,
                  ": more than " + numberText(kMostRows) + " numbers, a larger step has fewer");
  }
  const auto count = static_cast<std::size_t>((last - first) / step * (1.0 + 1e-12) + 1e-9) + 1;
  values.clear();
  for (std::size_t i = 0; i < count; ++i) values.push_back(first + static_cast<double>(i) * step);
  return values;
}

std::optional<LoadSweepRequest> sweepRequest(const SweepArguments& arguments,
                                             const Options& model) {
  if (!arguments.voltages && !arguments.loads) return std::nullopt;
  LoadSweepRequest request;
  request.voltages = arguments.voltages ? numbersOf("--sweep-voltage", *arguments.voltages)
                                        : std::vector<double>{model.load.voltage};
  if (arguments.loads) request.mechanical_loads = numbersOf("--sweep-load", *arguments.loads);
  LoadSweepRequest tested = request;
  if (tested.mechanical_loads.empty()) tested.mechanical_loads = {model.load.mechanical_load};
  std::vector<std::string> violations = tested.validate(model);
  for (std::string& violation : violations) {
    for (const auto& [name, option] : {std::pair("voltages: ", "--sweep-voltage: "),
                                       std::pair("load/voltage: ", "--sweep-voltage: "),
                                       std::pair("mechanical_loads: ", "--sweep-load: "),
                                       std::pair("load/mechanical_load: ", "--sweep-load: ")}) {
      if (violation.rfind(name, 0) == 0)
        violation = option + violation.substr(std::string(name).size());
    }
  }
  const double rows = rowsOf(tested.voltages.size(), tested.mechanical_loads.size());
  if (violations.empty() && rows > kMostRows) {
    violations.push_back(
        "--sweep-voltage and --sweep-load: " + numberText(rows) +
        " rows, up and down, are not allowed, must be <= " + numberText(kMostRows));
  }
  if (!violations.empty()) throw OptionsError(std::move(violations));
  return request;
}

}  // namespace mems_stiction
