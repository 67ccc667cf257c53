/// verify: computes every row of the verification table, prints it, and exits with 1 when a row is
/// out.

#include <unistd.h>

#include <fstream>
#include <iostream>

#include <CLI/CLI.hpp>

#include "verification/sections.hpp"
#include "verification/table.hpp"

namespace {

using namespace mems_stiction::verification;

/// Moves one row to twice its tolerance. @return false if there is no such row
bool falsify(std::vector<Section>& sections, const std::string& name) {
  for (Section& section : sections) {
    for (Row& row : section.rows) {
      if (section.title + ": " + row.quantity != name) continue;
      const double scale = row.reference == 0.0 ? 1.0 : row.reference;
      row.computed = row.reference + 2.0 * scale * (row.tolerance > 0.0 ? row.tolerance : 1.0);
      return true;
    }
  }
  return false;
}

}  // namespace

int main(int argc, char** argv) {
  std::string markdown_file;
  std::string falsified;
  CLI::App app{"Computes every row of the verification table and compares it with its reference."};
  app.add_option("--markdown", markdown_file, "write the table to this file as well");
  app.add_option("--falsify", falsified,
                 "put the row 'section: quantity' out, to see the run fail");
  CLI11_PARSE(app, argc, argv);

  const bool is_watched = isatty(STDERR_FILENO) != 0;
  std::vector<Section> sections = allSections([&](std::size_t number, std::size_t count) {
    if (is_watched) std::cerr << "\r\033[Ksection " << number << " of " << count << std::flush;
  });
  if (is_watched) std::cerr << "\r\033[K";
  if (!falsified.empty() && !falsify(sections, falsified)) {
    std::cerr << "verify: there is no row '" << falsified << "'\n";
    return 2;
  }
  std::cout << terminalTable(sections);
  if (!markdown_file.empty()) {
    std::ofstream stream(markdown_file, std::ios::binary);
    stream << markdownPage(sections);
    stream.close();
    if (!stream) {
      std::cerr << "verify: cannot write '" << markdown_file << "'\n";
      return 2;
    }
  }
  return countRows(sections).out == 0 ? 0 : 1;
}
