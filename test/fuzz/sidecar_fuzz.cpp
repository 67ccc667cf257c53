/// The text of a sidecar, beside a scan that states nothing.

#include <cmath>

#include "fuzz/fuzzing.hpp"
#include "mems_stiction/import/scan_file.hpp"
#include "support/scratch_folder.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  static const ScratchFolder folder;
  static const std::string scan = folder.write("scan.csv", "1, 2, 3\n4, 5, 7\n");
  folder.write("scan.csv.yaml", fuzzing::textOf(data, size));
  fuzzing::accepted([&] {
    const ScanFile file = openScanFile(scan);
    const double pitch = file.surface.pitchX();
    fuzzing::require(pitch > 0.0 && std::isfinite(pitch), "a scan that was read has a pitch");
  });
  fuzzing::accepted(
      [&] { fuzzing::require(listScanChannels(scan).size() == 1, "one grid is one channel"); });
  return 0;
}
