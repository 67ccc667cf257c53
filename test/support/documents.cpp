#include "support/documents.hpp"

#include <gtest/gtest.h>

#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <vector>

namespace mems_stiction {
namespace documents {
namespace {

/// Sees one row per setting.
class RowVisitor : public OptionVisitor {
 public:
  void number(const std::string& key, double& value, const std::string& unit, const Range& range,
              const std::string& meaning) override {
    row(key, unit == "-" ? "" : unit, yamlNumber(value), range.text(), meaning);
  }
  void integer(const std::string& key, int& value, const Range& range,
               const std::string& meaning) override {
    row(key, "", std::to_string(value), "integer " + range.text(), meaning);
  }
  void flag(const std::string& key, bool& value, const std::string& meaning) override {
    row(key, "", value ? "true" : "false", "true, false", meaning);
  }
  void text(const std::string& key, std::string& value, const std::string& meaning) override {
    row(key, "", value.empty() ? "empty" : value, "a text", meaning);
  }
  void choice(const std::string& key, std::string& value, const std::vector<std::string>& names,
              const std::string& meaning) override {
    std::string allowed;
    for (const std::string& name : names) allowed += (allowed.empty() ? "" : ", ") + name;
    row(key, "", value, allowed, meaning);
  }

 protected:
  virtual void row(const std::string& key, const std::string& unit, const std::string& value,
                   const std::string& allowed, const std::string& meaning) = 0;
};

/// A table for each section. Sections that follow each other with the same rows share one.
class TableWriter : public RowVisitor {
 public:
  std::string text() const {
    std::string text;
    for (std::size_t i = 0; i < sections_.size(); ++i) {
      const Section& section = sections_[i];
      const Section* twin = i + 1 < sections_.size() ? &sections_[i + 1] : nullptr;
      if (twin != nullptr && twin->rows != renamed(section, twin->name)) twin = nullptr;
      if (!section.name.empty()) {
        text += "\n### " + section.name + (twin != nullptr ? ", " + twin->name : "") + "\n";
      }
      if (twin != nullptr) {
        text += "\n`" + twin->name + "/...` has the keys of `" + section.name + "/...`.\n";
        ++i;
      }
      text += "\n| key | default | allowed | meaning |\n|---|---|---|---|\n" + section.rows;
    }
    return text;
  }

 private:
  struct Section {
    std::string name;
    std::string rows;
  };

  static std::string renamed(const Section& section, const std::string& name) {
    std::string rows = section.rows;
    const std::string from = "`" + section.name + "/";
    for (std::size_t at = rows.find(from); at != std::string::npos; at = rows.find(from, at + 1)) {
      rows.replace(at, from.size(), "`" + name + "/");
    }
    return rows;
  }

  void row(const std::string& key, const std::string& unit, const std::string& value,
           const std::string& allowed, const std::string& meaning) override {
    const std::size_t slash = key.find('/');
    const std::string name = slash == std::string::npos ? "" : key.substr(0, slash);
    if (sections_.empty() || name != sections_.back().name) sections_.push_back({name, ""});
    sections_.back().rows += "| `" + key + "` | " + value + (unit.empty() ? "" : " " + unit) +
                             " | " + allowed + " | " + meaning + " |\n";
  }

  std::vector<Section> sections_;
};

class DefaultFinder : public RowVisitor {
 public:
  explicit DefaultFinder(std::string key) : key_(std::move(key)) {}
  const std::string& text() const { return text_; }

 private:
  void row(const std::string& key, const std::string&, const std::string& value, const std::string&,
           const std::string&) override {
    if (key == key_) text_ = value;
  }

  std::string key_, text_;
};

std::string readText(const std::string& path) {
  std::ifstream file(path, std::ios::binary);
  if (!file) throw std::runtime_error(path + " cannot be read");
  return {std::istreambuf_iterator<char>(file), {}};
}

/// Begin and end of what stands between the markers.
std::pair<std::size_t, std::size_t> placeOf(const std::string& page, const std::string& name) {
  const std::size_t marker = page.find("<!-- begin " + name + ":");
  const std::size_t begin = marker == std::string::npos ? marker : page.find("-->\n", marker);
  const std::size_t end = page.find("<!-- end " + name + " -->");
  if (begin == std::string::npos || end == std::string::npos || end < begin + 4) {
    throw std::runtime_error("the page has no markers 'begin " + name + ":' and 'end " + name +
                             "'");
  }
  return {begin + 4, end};
}

}  // namespace

std::string parameterTables(const DescribeFunction& describe) {
  TableWriter writer;
  describe(writer);
  return writer.text() + "\n";
}

std::string defaultText(const DescribeFunction& describe, const std::string& key) {
  DefaultFinder finder(key);
  describe(finder);
  return finder.text();
}

std::string generatedPart(const std::string& page, const std::string& name) {
  const auto place = placeOf(page, name);
  return page.substr(place.first, place.second - place.first);
}

std::string withGeneratedPart(const std::string& page, const std::string& name,
                              const std::string& part) {
  const auto place = placeOf(page, name);
  return page.substr(0, place.first) + part + page.substr(place.second);
}

void expectUpToDate(const std::string& path, const std::string& name, const std::string& part) {
  const std::string page = readText(path);
  if (std::getenv("MEMS_STICTION_WRITE_DOCUMENTS") != nullptr) {
    std::ofstream(path, std::ios::binary) << withGeneratedPart(page, name, part);
    return;
  }
  EXPECT_EQ(generatedPart(page, name), part)
      << path << ": the part '" << name << "' is out of date; this test writes it anew with "
      << "MEMS_STICTION_WRITE_DOCUMENTS=1 in its environment";
}

}  // namespace documents
}  // namespace mems_stiction
