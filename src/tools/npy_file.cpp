#include "npy_file.hpp"

#include "files/output_file.hpp"

namespace mems_stiction {
namespace {

const char* kindOf(int depth) { return depth == CV_8U ? "|u1" : depth == CV_32F ? "<f4" : "<f8"; }

}  // namespace

void writeNpy(const std::string& path, const cv::Mat& pixels) {
  const cv::Mat whole = pixels.isContinuous() ? pixels : pixels.clone();
  std::string header = std::string("{'descr': '") + kindOf(whole.depth()) +
                       "', 'fortran_order': False, 'shape': (" + std::to_string(whole.rows) + ", " +
                       std::to_string(whole.cols) + "), }";
  constexpr std::size_t kPreface = 10;
  header.append(63 - (kPreface + header.size()) % 64, ' ');
  header += '\n';
  std::string text("\x93NUMPY\x01\x00", 8);
  text += static_cast<char>(header.size() & 0xFF);
  text += static_cast<char>(header.size() >> 8);
  text += header;
  text.append(reinterpret_cast<const char*>(whole.data), whole.total() * whole.elemSize());
  writeFile(path, text, OutputSafety::kWhole);
}

}  // namespace mems_stiction
