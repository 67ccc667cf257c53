#include "numeric/words.hpp"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <locale>
#include <numeric>
#include <sstream>

namespace mems_stiction {
namespace {

/// Levenshtein's distance: insertions, deletions and substitutions from one word to the other.
/// @return it, or a number beyond `most` if it is
std::size_t editDistance(const std::string& left, const std::string& right, std::size_t most) {
  std::vector<std::size_t> row(right.size() + 1);
  std::iota(row.begin(), row.end(), std::size_t{0});
  for (std::size_t i = 0; i < left.size(); ++i) {
    std::size_t diagonal = row[0];
    row[0] = i + 1;
    std::size_t least = row[0];
    for (std::size_t j = 0; j < right.size(); ++j) {
      const std::size_t substituted = diagonal + (left[i] == right[j] ? 0 : 1);
      diagonal = row[j + 1];
      row[j + 1] = std::min(substituted, std::min(row[j], row[j + 1]) + 1);
      least = std::min(least, row[j + 1]);
    }
    if (least > most) return least;  // the next rows are no smaller
  }
  return row.back();
}

}  // namespace

std::string lowered(std::string text) {
  // not std::tolower(): in a Turkish locale it leaves an I
  for (char& c : text) {
    if (c >= 'A' && c <= 'Z') c = static_cast<char>(c - 'A' + 'a');
  }
  return text;
}

std::string trimmed(const std::string& text, const std::string& around) {
  const std::size_t begin = text.find_first_not_of(around);
  return begin == std::string::npos ? ""
                                    : text.substr(begin, text.find_last_not_of(around) - begin + 1);
}

bool startsWith(std::string_view text, std::string_view start) {
  return text.substr(0, start.size()) == start;
}

bool endsWith(std::string_view text, std::string_view end) {
  return text.size() >= end.size() && text.substr(text.size() - end.size()) == end;
}

std::string replaced(std::string text, const std::string& what, const std::string& with) {
  for (std::size_t at = text.find(what); at != std::string::npos;
       at = text.find(what, at + with.size())) {
    text.replace(at, what.size(), with);
  }
  return text;
}

std::string countText(std::size_t count, const std::string& word) {
  return std::to_string(count) + " " + word + (count == 1 ? "" : "s");
}

std::string listed(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : ", ") + word;
  return text;
}

void addMissing(const std::vector<std::string>& more, std::vector<std::string>& lines) {
  for (const std::string& line : more) {
    if (std::find(lines.begin(), lines.end(), line) == lines.end()) lines.push_back(line);
  }
}

std::vector<std::string> wordsOf(const std::string& text) {
  std::istringstream stream(text);
  stream.imbue(std::locale::classic());
  return {std::istream_iterator<std::string>(stream), {}};
}

std::string lastPart(const std::string& key) { return key.substr(key.rfind('/') + 1); }

std::string suggestion(const std::string& unknown, const std::vector<std::string>& known) {
  const std::size_t farthest = std::max<std::size_t>(2, unknown.size() / 4);
  const std::string unknown_end = lastPart(unknown);
  const auto distanceTo = [&](const std::string& key, std::size_t most) {
    if (lastPart(key) == unknown_end) return std::size_t{1};
    // no word is nearer than their lengths differ, and the distance to a very long one takes long
    // to find
    const std::size_t least =
        std::max(key.size(), unknown.size()) - std::min(key.size(), unknown.size());
    return least > most ? least : editDistance(unknown, key, most);
  };
  std::vector<std::string> nearest;
  std::size_t best = farthest + 1;
  for (const std::string& key : known) {
    const std::size_t distance = distanceTo(key, best);
    if (distance < best) {
      best = distance;
      nearest.clear();
    }
    if (distance == best && best <= farthest) nearest.push_back(key);
  }
  if (nearest.size() > 1 && unknown_end != unknown) {  // of those that share the last part
    const auto whole = [&](const std::string& key) {
      return editDistance(unknown, key, std::max(key.size(), unknown.size()));
    };
    std::size_t least = whole(nearest.front());
    for (const std::string& key : nearest) least = std::min(least, whole(key));
    nearest.erase(std::remove_if(nearest.begin(), nearest.end(),
                                 [&](const std::string& key) { return whole(key) > least; }),
                  nearest.end());
  }
  if (nearest.empty() || nearest.size() > 3) return "";
  std::string text = " (did you mean ";
  for (std::size_t i = 0; i < nearest.size(); ++i) text += (i == 0 ? "" : " or ") + nearest[i];
  return text + "?)";
}

}  // namespace mems_stiction
