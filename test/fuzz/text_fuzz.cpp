/// The bytes of a text file of heights.

#include "fuzz/fuzzing.hpp"
#include "height_map/scan_sanity.hpp"
#include "import/format_readers.hpp"
#include "mems_stiction/height_map/raw_scan.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  fuzzing::accepted([&] {
    const FileChannel channel = parseTextGrid(fuzzing::textOf(data, size));
    fuzzing::require(!channel.values.empty(), "a grid has cells");
    ScanOptions options;
    options.pitch_x = options.pitch_y = 1e-8;
    scanWarnings(heightMapFromPixels(channel.values, options));
  });
  return 0;
}
