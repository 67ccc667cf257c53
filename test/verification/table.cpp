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
    "test/property checks these on random rough surfaces, materials and loads (RapidCheck; a fixed "
    "seed, others by\n"
    "`RC_PARAMS=\"seed=42 max_success=5000\"`):\n\n"
    "- If lengths are multiplied by c and stiffnesses by s, then areas grow by c^2, forces by s "
    "c^2, energies by s "
    "c^3.\n"
    "- Nothing changes if the frame is turned or flipped, gets a border of invalid pixels, or the "
    "bodies are "
    "exchanged\n"
    "  or moved along z.\n"
    "- Two tiles of a scan under twice the load have twice its force.\n"
    "- With more work of adhesion the contact is never smaller.\n"
    "- F_w and F_e are the sums over cells. The contacts share the load, the area and the pull-off "
    "force.\n"
    "- Only cells that touched are lower afterwards. The hardness determines how both bodies share "
    "the volume.\n"
    "- A second, slow algorithm, which labels the frame at each step, finds the same state.\n\n"
    "Two plausible properties have exceptions, which belong to the model:\n\n"
    "- *More work of adhesion gives more force.* The pull-off force is 3/2 pi w times the sum of "
    "radii. Where "
    "contacts\n"
    "  merge, or a contact of few pixels grows by one, that sum may fall faster than w rises: on 2 "
    "of 1000 small "
    "random\n"
    "  frames at 1.5 times the work of adhesion, never for six surfaces together.\n"
    "- *More load gives more area.* The generalised force of an asperity grows with its load P0 up "
    "to JKR's apparent\n"
    "  load P1 of its radius. An asperity that (6) loads beyond P1 resists more, and a larger load "
    "may then rest on\n"
    "  less area: on 3 of 10000 frames, all with such an asperity.\n";

/// Of the page's tables, and what marks a row that is out.
constexpr const char* kHeader =
    "| reference | rows | nearest to its limit | error | allowed | lowest order |\n";
constexpr const char* kOutMark = "| **out:** ";
/// Rows that differ by less agree but for round-off, of a few operations or of a sum.
constexpr double kSumRoundOff = 1e-9;
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

std::string toleranceText(const Row& row) {
  return row.tolerance == 0.0 ? "0" : formatted("%.1e", row.tolerance);
}

std::string orderText(const Row& row) {
  if (!row.convergence) return {};
  const double order = row.convergence->order();
  return std::isinf(order) ? "exact" : formatted("%.2f", order);
}

std::string nameText(const Row& row) {
  return row.unit.empty() ? row.quantity : row.quantity + " [" + row.unit + "]";
}

/// Right- or left-aligned; letters beyond the width stay.
std::string right(const std::string& text, int width) {
  return std::string(static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))),
                     ' ') +
         text;
}
std::string left(const std::string& text, int width) {
  return text +
         std::string(static_cast<std::size_t>(std::max(0, width - static_cast<int>(text.size()))),
                     ' ');
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
    text += (i == 0 ? "" : between) + formatted("%g", convergence.resolutions[i]) + ": " +
            errorText(convergence.errors[i]);
  }
  return text;
}

/// A pipe would end the cell.
std::string cell(std::string text) {
  for (std::size_t at = text.find('|'); at != std::string::npos; at = text.find('|', at + 2))
    text.insert(at, "\\");
  return text;
}

bool isPublished(const Row& row) { return row.reason.find("published digit") != std::string::npos; }

/// Agreement that no grid, step or sample limits: the page counts such rows.
bool isToTheDigit(const Row& row) {
  const bool is_round_off = row.tolerance > 0.0 && row.tolerance <= kSumRoundOff;
  return !row.convergence && (is_round_off || isPublished(row));
}

/// Rows of a section with one reference.
struct Group {
  std::string source;
  std::vector<const Row*> rows;

  /// The row whose error is the largest share of what is allowed.
  const Row& nearest() const {
    const auto share = [](const Row* row) {
      return row->tolerance > 0.0 ? row->error() / row->tolerance : row->error();
    };
    return **std::max_element(rows.begin(), rows.end(), [&](const Row* one, const Row* other) {
      return share(one) < share(other);
    });
  }

  /// Of the row that converges slowest; empty where no row has a grid.
  std::string lowestOrder() const {
    const Row* lowest = nullptr;
    for (const Row* row : rows) {
      const bool is_lower =
          row->convergence && (!lowest || row->convergence->order() < lowest->convergence->order());
      if (is_lower) lowest = row;
    }
    return lowest ? orderText(*lowest) : "";
  }
};

/// Rows whose agreement something limits, by reference, in the order of the section.
std::vector<Group> groupsOf(const Section& section) {
  std::vector<Group> groups;
  for (const Row& row : section.rows) {
    if (!row.isWithin() || isToTheDigit(row)) continue;
    auto found = std::find_if(groups.begin(), groups.end(),
                              [&](const Group& g) { return g.source == row.source; });
    if (found == groups.end()) found = groups.insert(groups.end(), Group{row.source, {}});
    found->rows.push_back(&row);
  }
  return groups;
}

/// "9 rows, of which 8 agree to round-off or to the published digits (sources)."
std::string rowsText(const Section& section) {
  std::vector<std::string> sources;
  int to_the_digit = 0;
  for (const Row& row : section.rows) {
    if (!row.isWithin() || !isToTheDigit(row)) continue;
    ++to_the_digit;
    const bool is_new = std::find(sources.begin(), sources.end(), row.source) == sources.end();
    if (isPublished(row) && is_new) sources.push_back(row.source);
  }
  const int count = static_cast<int>(section.rows.size());
  const std::string share =
      to_the_digit == count ? "which all" : "of which " + std::to_string(to_the_digit);
  std::string text = std::to_string(count) + " rows";
  if (to_the_digit > 0) text += ", " + share + " agree to round-off";
  for (std::size_t i = 0; i < sources.size(); ++i) {
    text += (i == 0 ? " or to the published digits (" : "; ") + sources[i];
  }
  return text + (sources.empty() ? ".\n" : ").\n");
}

void writeRow(const char* begin, const std::string& source, const std::string& rows, const Row& row,
              const std::string& order, std::ostringstream& page) {
  page << begin << cell(source) << " | " << rows << " | " << cell(row.quantity) << " | "
       << errorText(row.error()) << " | " << toleranceText(row) << " | " << order << " |\n";
}

void writeSection(const Section& section, std::ostringstream& page) {
  const std::vector<Group> groups = groupsOf(section);
  const bool has_out = std::any_of(section.rows.begin(), section.rows.end(),
                                   [](const Row& row) { return !row.isWithin(); });
  page << "\n## " << section.title << "\n\n" << rowsText(section);
  if (groups.empty() && !has_out) return;
  page << "\n" << kHeader << "|---|---|---|---|---|---|\n";
  for (const Row& row : section.rows) {
    if (!row.isWithin()) writeRow(kOutMark, row.source, "1", row, orderText(row), page);
  }
  for (const Group& group : groups) {
    writeRow("| ", group.source, std::to_string(group.rows.size()), group.nearest(),
             group.lowestOrder(), page);
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

std::vector<std::string> referencesOf(const std::vector<Section>& sections) {
  std::vector<std::string> references;
  for (const Section& section : sections) {
    references.push_back(section.title + ": " + std::to_string(section.rows.size()) + " rows");
    for (const Group& group : groupsOf(section))
      references.push_back(section.title + ": " + cell(group.source));
  }
  return references;
}

std::vector<std::string> referencesOfPage(const std::string& page) {
  std::vector<std::string> references;
  std::istringstream lines(page);
  std::string title;
  bool is_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line.rfind("## ", 0) == 0) title = line.substr(3);
    const std::size_t rows = line.find(" rows");
    const bool is_count =
        rows > 0 && rows != std::string::npos &&
        std::all_of(line.begin(), line.begin() + static_cast<std::ptrdiff_t>(rows),
                    [](char letter) { return letter >= '0' && letter <= '9'; });
    if (is_count) references.push_back(title + ": " + line.substr(0, rows) + " rows");
    is_table = line + "\n" == kHeader || (is_table && line.rfind("|", 0) == 0);
    const bool is_row =
        line.rfind("| ", 0) == 0 && line.rfind(kOutMark, 0) != 0 && line + "\n" != kHeader;
    if (is_table && is_row)
      references.push_back(title + ": " + line.substr(2, line.find(" | ", 2) - 2));
  }
  return references;
}

std::string terminalTable(const std::vector<Section>& sections) {
  std::ostringstream text;
  for (const Section& section : sections) {
    Reasons reasons;
    text << section.title << "\n"
         << left("", kNameWidth + 2) << right("computed", kValueWidth)
         << right("reference", kValueWidth) << right("error", kErrorWidth)
         << right("order", kOrderWidth) << right("tol.", kErrorWidth) << "\n";
    for (const Row& row : section.rows) {
      text << "  " << left(nameText(row), kNameWidth)
           << right(valueText(row, row.computed), kValueWidth)
           << right(valueText(row, row.reference), kValueWidth)
           << right(errorText(row.error()), kErrorWidth) << right(orderText(row), kOrderWidth)
           << right(toleranceText(row), kErrorWidth) << " " << reasons.letterOf(row.reason)
           << (row.isWithin() ? "" : "  <-- OUT") << "\n";
      if (!row.convergence) continue;
      text << "      " << row.convergence->resolution << " "
           << errorsByResolution(*row.convergence, ", ") << "\n";
      if (row.convergence->order() < row.convergence->least_order) {
        text << "      order must be at least " << row.convergence->least_order << ": "
             << row.convergence->reason << "\n";
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
          "What the code computes, beside every closed form of the model and every published "
          "number that it\n"
          "must give. References are published numbers, or closed forms and quadratures written "
          "separately in\n"
          "test/verification. `scripts/verify` prints every row, writes this summary, and fails "
          "when a row is\n"
          "out.\n\n"
          "- A table has one line for each reference. The line names the row whose error is "
          "nearest to its\n"
          "  limit. *error*: |computed/reference - 1|, or |computed| where the reference is 0. "
          "`scripts/verify`\n"
          "  prints the reason of each limit.\n"
          "- *lowest order*: of the rows that depend on a grid, p in error ~ pitch^p. Their error "
          "is that of the\n"
          "  finest grid.\n"
          "- A row is out if its error exceeds what is allowed, or if its order is too low.\n\n"
       << "**" << countText(countRows(sections)) << ".**\n";
  for (const Section& section : sections) writeSection(section, page);
  page << kProperties;
  return page.str();
}

}  // namespace verification
}  // namespace mems_stiction
