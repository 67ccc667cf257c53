/// The frame of 4 x 4 cells on which doc/architecture.md explains the approach: its numbers are
/// those of the code.

#include <cstdarg>
#include <cstdio>
#include <string>

#include <gtest/gtest.h>

#include "paper/patch_sweep.hpp"
#include "support/documents.hpp"

namespace mems_stiction {
namespace {

const std::string kPage = std::string(MEMS_STICTION_DOC_DIR) + "/architecture.md";
constexpr double kStep = 1e-9;

__attribute__((format(printf, 1, 2))) std::string format(const char* pattern, ...) {
  char line[128];
  std::va_list arguments;
  va_start(arguments, pattern);
  std::vsnprintf(line, sizeof(line), pattern, arguments);
  va_end(arguments);
  return line;
}

std::string nanometres(double gap) { return format("%3.1f", gap * 1e9); }

std::string letter(std::int32_t dale) { return {static_cast<char>('A' + dale)}; }

std::string withoutTrailingSpaces(const std::string& line) {
  return line.substr(0, line.find_last_not_of(' ') + 1);
}

std::string fenced(const std::string& text) { return "```text\n" + text + "```\n"; }

class WorkedFrame : public testing::Test {
 protected:
  WorkedFrame() {
    // heights [nm]; the highest cell touches first and has gap 0
    const cv::Mat heights = (cv::Mat1d(4, 4) << 8.8, 9.6, 8.3, 6.4,  //
                             7.7, 8.5, 6.8, 7.2,                     //
                             6.6, 5.9, 8.9, 10.0,                    //
                             7.4, 6.3, 7.8, 9.1);
    field_.compute({HeightMap(heights * 1e-9, 20e-9, 20e-9), {}});
    order_.build(field_, 1.0, kStep);
    dales_.start(field_);
    table_.start(field_, order_, dales_);
  }

  /// What lies around the cell at a place of the order, from the window that starts with its group.
  CellSurroundings surroundings(int place) {
    if (place == order_.groupStart(order_.groupOfPlace(place))) table_.collectFrom(place);
    return table_.at(place);
  }

  GapField field_;
  GapOrder order_;
  DaleMap dales_;
  SurroundingsTable table_;
};

TEST_F(WorkedFrame, HasTheGroupsAndDalesOfThePage) {
  // dales are numbered in the order in which the approach asks for them
  for (int place = 0; place < field_.validCount(); ++place) surroundings(place);
  std::string text = "gap [nm]                  group            dale\n";
  for (int row = 0; row < field_.rows(); ++row) {
    std::string gaps;
    std::string groups;
    std::string dales;
    for (int col = 0; col < field_.cols(); ++col) {
      const GridCell cell = field_.cellAt(row, col);
      gaps += nanometres(field_.gap(cell.index)) + "  ";
      groups += format("%d  ", order_.groupOf(field_.gap(cell.index)));
      dales += letter(dales_.find(cell)) + "  ";
    }
    text +=
        withoutTrailingSpaces(format("%-26s%-17s%s", gaps.c_str(), groups.c_str(), dales.c_str())) +
        "\n";
  }
  documents::expectUpToDate(kPage, "frame", fenced(text));
}

}  // namespace
}  // namespace mems_stiction
