#include "verification/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace mems_stiction {
namespace verification {
namespace {

/// What test/property checks, and where a plausible property ends.
constexpr const char* kProperties =
    "\n## Properties of every prediction\n\n"
    "test/property checks these on random rough surfaces, materials and loads (RapidCheck; a fixed seed, others by\n"
    "`RC_PARAMS=\"seed=42 max_success=5000\"`):\n\n"
    "- If lengths are multiplied by c and stiffnesses by s, then areas grow by c^2, forces by s c^2, energies by s "
    "c^3.\n"
    "- Nothing changes if the frame is turned or flipped, gets a border of invalid pixels, or the bodies are "
    "exchanged\n"
    "  or moved along z.\n"
    "- Two tiles of a scan under twice the load have twice its force.\n"
    "- With more work of adhesion the contact is never smaller.\n"
    "- F_w and F_e are the sums over cells. The contacts share the load, the area and the pull-off force.\n"
    "- Only cells that touched are lower afterwards. The hardness determines how both bodies share the volume.\n"
    "- A second, slow algorithm, which labels the frame at each step, finds the same state.\n\n"
    "Two plausible properties have exceptions, which belong to the model:\n\n"
    "- *More work of adhesion gives more force.* The pull-off force is 3/2 pi w times the sum of radii. Where "
    "contacts\n"
    "  merge, or a contact of few pixels grows by one, that sum may fall faster than w rises: on 2 of 1000 small "
    "random\n"
    "  frames at 1.5 times the work of adhesion, never for six surfaces together.\n"
    "- *More load gives more area.* The generalised force of an asperity grows with its load P0 up to JKR's apparent\n"
    "  load P1 of its radius. An asperity that (6) loads beyond P1 resists more, and a larger load may then rest on\n"
    "  less area: on 3 of 10000 frames, all with such an asperity.\n";

/// Of the page's tables of rows, and what marks a row that is out.
constexpr const char* kHeader = "| quantity | computed | reference | source of the reference | error | allowed |\n";
constexpr const char* kOutMark = "| **out:** ";
constexpr int kNameWidth = 56;
constexpr int kValueWidth = 14;
constexpr int kErrorWidth = 9;
constexpr int kOrderWidth = 6;

std::string formatted(const char* format, double value) {
  char text[40];
  std::snprintf(text, sizeof text, format, value);
  return text;
}

std::string valueText(const Row& row, double value) {
  const bool is_round_off = row.reference == 0.0 && std::abs(value) < kRoundOff;
  return is_round_off ? "0" : formatted("%.7g", value);
}

/// Round-off differs from machine to machine: digits of it would say nothing.
std::string errorText(double error) {
  if (error == 0.0) return "0";
  return error < kRoundOff ? "<1e-12" : formatted("%.1e", error);
}

std::string toleranceText(const Row& row) { return row.tolerance == 0.0 ? "0" : formatted("%.1e", row.tolerance); }

std::string orderText(const Row& row) {
  if (!row.convergence) return {};
  const double order = row.convergence->order();
  return std::isinf(order) ? "exact" : formatted("%.2f", order);
}

std::string nameText(const Row& row) { return row.unit.empty() ? row.quantity : row.quantity + " [" + row.unit + "]"; }

/// Right- or left-aligned; letters beyond the width stay.
std::string right(const std::string& text, int width) {
  return std::string(static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))), ' ') + text;
}
std::string left(const std::string& text, int width) {
  return text + std::string(static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))), ' ');
}

/// Reasons of a section, each once: a letter stands for it in the table.
class Reasons {
 public:
  std::string letterOf(const std::string& reason) {
    auto found = std::find(reasons_.begin(), reasons_.end(), reason);
    if (found == reasons_.end()) found = reasons_.insert(reasons_.end(), reason);
    return std::string(1, static_cast<char>('a' + (found - reasons_.begin())));
  }
  std::string legend() const {
    std::string text;
    for (std::size_t i = 0; i < reasons_.size(); ++i) {
      text += "  " + std::string(1, static_cast<char>('a' + i)) + "  " + reasons_[i] + "\n";
    }
    return text;
  }

 private:
  std::vector<std::string> reasons_;
};

std::string countText(const Count& count) {
  return std::to_string(count.rows) + " rows, " + std::to_string(count.out) + " out";
}

std::string errorsByResolution(const Convergence& convergence, const char* between) {
  std::string text;
  for (std::size_t i = 0; i < convergence.errors.size(); ++i) {
    text +=
        (i == 0 ? "" : between) + formatted("%g", convergence.resolutions[i]) + ": " + errorText(convergence.errors[i]);
  }
  return text;
}

/// A pipe would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2)) text.insert(at, "\\");
  return text;
}

void writeConvergence(const Section& section, std::ostringstream& page) {
  const auto hasConvergence = [](const Row& row) { return row.convergence.has_value(); };
  if (!std::any_of(section.rows.begin(), section.rows.end(), hasConvergence)) return;
  page << "\nErrors by resolution:\n\n| quantity | counted in | errors | order | at least | why |\n"
       << "|---|---|---|---|---|---|\n";
  for (const Row& row : section.rows) {
    if (!row.convergence) continue;
    const Convergence& convergence = *row.convergence;
    page << "| *" << cell(row.quantity) << "* | " << convergence.resolution << " | "
         << errorsByResolution(convergence, "; ") << " | " << orderText(row) << " | "
         << formatted("%g", convergence.least_order) << " | " << cell(convergence.reason) << " |\n";
  }
}

}  // namespace

Count countRows(const std::vector<Section>& sections) {
  Count count;
  for (const Section& section : sections) {
    for (const Row& row : section.rows) {
      ++count.rows;
      if (!row.isWithin()) ++count.out;
    }
  }
  return count;
}

std::vector<std::string> rowNames(const std::vector<Section>& sections) {
  std::vector<std::string> names;
  for (const Section& section : sections) {
    for (const Row& row : section.rows) names.push_back(section.title + ": " + row.quantity);
  }
  return names;
}

std::vector<std::string> rowNamesOfPage(const std::string& page) {
  std::vector<std::string> names;
  std::istringstream lines(page);
  std::string title;
  bool is_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) title = line.substr(3);
    is_table = line + "\n" == kHeader || (is_table && line.rfind("|", 0) == 0);
    if (!is_table || line.rfind("| ", 0) != 0 || line + "\n" == kHeader) continue;
    const std::size_t begin = line.rfind(kOutMark, 0) == 0 ? std::string(kOutMark).size() : 2;
    std::string name = line.substr(begin, line.find(" | ", begin) - begin);
    for (std::size_t at = name.find("\\|"); at != std::string::npos; at = name.find("\\|")) name.erase(at, 1);
    names.push_back(title + ": " + name);
  }
  return names;
}

std::string terminalTable(const std::vector<Section>& sections) {
  std::ostringstream text;
  for (const Section& section : sections) {
    Reasons reasons;
    text << section.title << "\n"
         << left("", kNameWidth + 2) << right("computed", kValueWidth) << right("reference", kValueWidth)
         << right("error", kErrorWidth) << right("order", kOrderWidth) << right("tol.", kErrorWidth) << "\n";
    for (const Row& row : section.rows) {
      text << "  " << left(nameText(row), kNameWidth) << right(valueText(row, row.computed), kValueWidth)
           << right(valueText(row, row.reference), kValueWidth) << right(errorText(row.error()), kErrorWidth)
           << right(orderText(row), kOrderWidth) << right(toleranceText(row), kErrorWidth) << " "
           << reasons.letterOf(row.reason) << (row.isWithin() ? "" : "  <-- OUT") << "\n";
      if (!row.convergence) continue;
      text << "      " << row.convergence->resolution << " " << errorsByResolution(*row.convergence, ", ") << "\n";
      if (row.convergence->order() < row.convergence->least_order) {
        text << "      order must be at least " << row.convergence->least_order << ": " << row.convergence->reason
             << "\n";
      }
    }
    text << reasons.legend() << "\n";
  }
  text << countText(countRows(sections)) << "\n";
  return text.str();
}

std::string markdownPage(const std::vector<Section>& sections) {
  std::ostringstream page;
  page << "# Verification\n\n"
          "Every closed form of the model and every published number that it must give, beside what the code\n"
          "computes. `scripts/verify` writes this page and fails when a row is out. References are published\n"
          "numbers, or closed forms and quadratures written separately in test/verification. None comes from\n"
          "this package's code.\n\n"
          "- *error*: |computed/reference - 1|, or |computed| where the reference is 0.\n"
          "- *allowed*: largest error, with its reason. *round-off*: of a few operations. *N published digits*:\n"
          "  half a unit of the last one.\n"
          "- Rows that depend on the grid have the value of the finest grid, at its worst position. A table below\n"
          "  them has their errors by resolution and the *order* p in error ~ pitch^p.\n"
          "- A row is out, and marked so, if its error exceeds what is allowed or its order is too low.\n\n"
       << "**" << countText(countRows(sections)) << ".**\n";
  for (const Section& section : sections) {
    page << "\n## " << section.title << "\n\n" << kHeader << "|---|---|---|---|---|---|\n";
    for (const Row& row : section.rows) {
      page << (row.isWithin() ? "| " : kOutMark) << cell(row.quantity) << " | " << valueText(row, row.computed)
           << (row.unit.empty() ? "" : " ") << row.unit << " | " << valueText(row, row.reference) << " | "
           << cell(row.source) << " | " << errorText(row.error()) << " | " << toleranceText(row) << ": "
           << cell(row.reason) << " |\n";
    }
    writeConvergence(section, page);
  }
  page << kProperties;
  return page.str();
}

}  // namespace verification
}  // namespace mems_stiction
