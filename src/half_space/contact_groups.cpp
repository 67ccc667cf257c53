#include "half_space/contact_groups.hpp"

#include <numeric>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace mems_stiction {

int countContactGroups(const cv::Mat& mask, bool wraps) {
  cv::Mat labels;
  const int label_count = cv::connectedComponents(mask, labels, 4, CV_32S);
  int groups = label_count - 1;  // without the background
  if (!wraps || groups == 0) return groups;
  std::vector<int> parent(static_cast<std::size_t>(label_count));
  std::iota(parent.begin(), parent.end(), 0);
  const auto rootOf = [&](int label) {
    while (parent[static_cast<std::size_t>(label)] != label)
      label = parent[static_cast<std::size_t>(label)];
    return label;
  };
  const auto join = [&](int a, int b) {
    if (a == 0 || b == 0) return;
    const int root_a = rootOf(a);
    const int root_b = rootOf(b);
    if (root_a == root_b) return;
    parent[static_cast<std::size_t>(root_a)] = root_b;
    --groups;
  };
  for (int row = 0; row < labels.rows; ++row)
    join(labels.at<int>(row, 0), labels.at<int>(row, labels.cols - 1));
  for (int col = 0; col < labels.cols; ++col)
    join(labels.at<int>(0, col), labels.at<int>(labels.rows - 1, col));
  return groups;
}

}  // namespace mems_stiction
