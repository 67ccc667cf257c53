/// The bytes of a .gwy file.

#include "fuzz/fuzzing.hpp"
#include "height_map/scan_sanity.hpp"
#include "import/channel_choice.hpp"
#include "import/format_readers.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace mems_stiction;
  fuzzing::accepted([&] {
    const std::vector<FileChannel> channels = parseGwy(fuzzing::textOf(data, size));
    const std::size_t chosen = chooseHeightChannel(channels);
    fuzzing::require(chosen < channels.size(), "what is chosen is there");
    passedOver(channels, chosen);
    const HeightMap surface = surfaceOfChannel(channels[chosen]);
    fuzzing::require(surface.pitchX() > 0.0 && surface.pitchY() > 0.0, "a surface has a pitch");
    scanWarnings(surface);
  });
  return 0;
}
