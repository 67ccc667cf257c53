/// The bytes of a bag. What compressed chunks hold is not looked at: decompressing and reading them
/// is rosbag's.

#include "fuzz/fuzzing.hpp"
#include "support/scratch_folder.hpp"
#include "tools/bag_check.hpp"
#include "tools/scan_bag_reader.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  const std::string bytes = fuzzing::textOf(data, size);
  if (bytes.find("bz2") != std::string::npos || bytes.find("lz4") != std::string::npos) return 0;
  static const ScratchFolder folder;
  const std::string path = folder.write("scans.bag", bytes);
  fuzzing::accepted([&] {
    if (checkBag(path) == BagEnd::kCutOff)
      return;  // another program mends it: this is about what is in it
    const ScanBagReader reader(path, "height", {});
    for (std::size_t scan = 0; scan < reader.count(); ++scan) {
      fuzzing::accepted([&] {
        const BagScan read = reader.read(scan, true);
        fuzzing::require(read.surface.rows() > 0, "a scan has rows");
      });
    }
  });
  return 0;
}
