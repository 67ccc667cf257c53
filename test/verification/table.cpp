#include "verification/table.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <sstream>

namespace mems_stiction {
namespace verification {
namespace {

/// What test/property checks.
constexpr const char* kProperties =
    "\n## Properties of every prediction\n\n"
    "test/property checks these on random rough surfaces, materials and loads (RapidCheck; a fixed "
    "seed,\n"
    "others by `RC_PARAMS=\"seed=42 max_success=5000\"`):\n\n"
    "- If lengths are multiplied by c and stiffnesses by s, then areas grow by c^2, forces by s "
    "c^2,\n"
    "  energies by s c^3.\n"
    "- Nothing changes if the frame is turned or flipped, gets a border of invalid pixels, or the "
    "bodies\n"
    "  are exchanged or moved along z. Two tiles of a scan under twice the load have twice its "
    "force.\n"
    "- With more work of adhesion the contact is never smaller.\n"
    "- F_w and F_e are the sums over cells. The contacts share the load, the area and the pull-off "
    "force.\n"
    "- Only cells that touched are lower afterwards. The hardness determines how both bodies share "
    "the\n"
    "  volume.\n"
    "- A second, slow algorithm, which labels the frame at each step, finds the same state.\n";

/// Of the page's table, and what marks a row that is out.
constexpr const char* kHeader = "| | rows | references | nearest to its limit: error, allowed |\n";
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

/// Rows whose agreement something limits.
std::vector<const Row*> limitedRows(const Section& section) {
  std::vector<const Row*> rows;
  for (const Row& row : section.rows) {
    if (row.isWithin() && !isToTheDigit(row)) rows.push_back(&row);
  }
  return rows;
}

/// What a section is compared with beside closed forms that hold to round-off, each once.
std::string sourcesOf(const Section& section) {
  std::vector<std::string> sources;
  for (const Row& row : section.rows) {
    const bool is_named = row.isWithin() && (isPublished(row) || !isToTheDigit(row));
    const bool is_new = std::find(sources.begin(), sources.end(), row.source) == sources.end();
    if (is_named && is_new) sources.push_back(row.source);
  }
  if (sources.empty()) return "closed forms";
  std::string text;
  for (const std::string& source : sources) text += (text.empty() ? "" : "; ") + source;
  return text;
}

/// "title | rows | references", as referencesOfPage() reads it back.
std::string referenceCells(const Section& section) {
  return section.title + " | " + std::to_string(section.rows.size()) + " | " +
         cell(sourcesOf(section));
}

std::string errorCell(const Row& row, const std::string& order) {
  return errorText(row.error()) + ", " + toleranceText(row) +
         (order.empty() ? "" : "; order " + order);
}

/// The row whose error is the largest share of what is allowed, with the order of the row that
/// converges slowest.
std::string nearestCell(const Section& section) {
  const std::vector<const Row*> rows = limitedRows(section);
  if (rows.empty()) return "round-off or published digits";
  const auto share = [](const Row* row) {
    return row->tolerance > 0.0 ? row->error() / row->tolerance : row->error();
  };
  const Row& nearest = **std::max_element(
      rows.begin(), rows.end(),
      [&](const Row* one, const Row* other) { return share(one) < share(other); });
  const Row* slowest = nullptr;
  for (const Row* row : rows) {
    if (!row->convergence) continue;
    if (!slowest || row->convergence->order() < slowest->convergence->order()) slowest = row;
  }
  return cell(nearest.quantity) + ": " + errorCell(nearest, slowest ? orderText(*slowest) : "");
}

void writeSection(const Section& section, std::ostringstream& page) {
  page << "| " << referenceCells(section) << " | " << nearestCell(section) << " |\n";
  for (const Row& row : section.rows) {
    if (row.isWithin()) continue;
    page << kOutMark << cell(row.quantity) << " | 1 | " << cell(row.source) << " | "
         << errorCell(row, orderText(row)) << " |\n";
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
  for (const Section& section : sections) references.push_back(referenceCells(section));
  return references;
}

std::vector<std::string> referencesOfPage(const std::string& page) {
  std::vector<std::string> references;
  std::istringstream lines(page);
  bool is_table = false;
  for (std::string line; std::getline(lines, line);) {
    if (line + "\n" == kHeader) {
      is_table = true;
      continue;
    }
    is_table = is_table && line.rfind("|", 0) == 0;
    if (is_table && line.rfind("| ", 0) == 0 && line.rfind(kOutMark, 0) != 0)
      references.push_back(line.substr(2, line.rfind(" | ") - 2));
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
          "test/verification. `scripts/verify` prints every row with the reason of its limit, "
          "writes this\n"
          "summary, and fails when a row is out: when its error exceeds what is allowed, or its "
          "order is too\n"
          "low. *error*: |computed/reference - 1|, or |computed| where the reference is 0; on the "
          "finest grid.\n"
          "*order*: the lowest p of the rows that depend on a grid, error ~ pitch^p.\n\n"
       << "**" << countText(countRows(sections)) << ".**\n\n"
       << kHeader << "|---|---|---|---|\n";
  for (const Section& section : sections) writeSection(section, page);
  page << kProperties;
  return page.str();
}

}  // namespace verification
}  // namespace mems_stiction
