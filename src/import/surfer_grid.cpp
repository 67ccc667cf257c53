#include <cmath>
#include <limits>
#include <sstream>
#include <string>

#include <opencv2/core.hpp>

#include "import/file_bytes.hpp"
#include "import/format_readers.hpp"
#include "import/plain_number.hpp"
#include "mems_stiction/errors/errors.hpp"

namespace mems_stiction {
namespace {

constexpr double kBlank = 1.70141e38;  ///< and above: no node here

/// The numbers of the file, one after the other, however its lines are broken.
class Numbers {
 public:
  explicit Numbers(const std::string& text) : words_(text) {}

  double next(const std::string& what) {
    std::string word;
    if (!(words_ >> word)) throw FileError("cut off: " + what + " is missing");
    return plainNumber(word);
  }

  void checkEnd() {
    std::string word;
    if (words_ >> word)
      throw FileError("more numbers than the heading states: '" + shownPiece(word) + "'");
  }

 private:
  std::istringstream words_;
};

int sideOf(double stated) {
  if (!(stated >= 2.0) || stated > 1e6 || stated != std::floor(stated)) {
    throw FileError("the heading does not state two numbers of nodes from 2 on");
  }
  return static_cast<int>(stated);
}

double rangeOf(double low, double high) {
  if (!(high > low)) throw FileError("the heading states a range that does not grow");
  return high - low;
}

}  // namespace

FileChannel parseSurferGrid(const std::string& bytes) {
  Numbers numbers(bytes.substr(4));
  const int cols = sideOf(numbers.next("the number of columns"));
  const int rows = sideOf(numbers.next("the number of rows"));
  checkPixelCount(static_cast<std::size_t>(cols), static_cast<std::size_t>(rows));
  double limits[6];
  for (double& limit : limits) limit = numbers.next("a limit of x, y or z");
  FileChannel channel;
  channel.takes_settings = true;
  channel.values.create(rows, cols, CV_64FC1);
  for (int row = rows - 1; row >= 0; --row) {  // the lowest y comes first
    for (int col = 0; col < cols; ++col) {
      const double height = numbers.next("a height");
      channel.values.at<double>(row, col) =
          height >= kBlank ? std::numeric_limits<double>::quiet_NaN() : height;
    }
  }
  numbers.checkEnd();
  // Nodes lie on the limits.
  channel.width = rangeOf(limits[0], limits[1]) * cols / (cols - 1);
  channel.height = rangeOf(limits[2], limits[3]) * rows / (rows - 1);
  return channel;
}

}  // namespace mems_stiction
