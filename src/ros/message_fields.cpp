#include "ros/message_fields.hpp"
#include "numeric/words.hpp"

#include <sstream>

namespace mems_stiction {

std::vector<std::string> fieldNames(const std::string& definition) {
  std::vector<std::string> names;
  std::istringstream lines(definition);
  for (std::string line; std::getline(lines, line) && !startsWith(line, "==");) {
    std::istringstream words(line.substr(0, line.find('#')));
    std::string type, name, sign;
    words >> type >> name >> sign;
    if (!name.empty() && sign.empty() && name.find('=') == std::string::npos) names.push_back(name);
  }
  return names;
}

const MessageFields::Entry* MessageFields::valueOf(const std::string& name) {
  for (std::size_t i = 0; i < figures_.size(); ++i) {
    const std::size_t place = (next_ + i) % figures_.size();
    if (figures_[place].name != name) continue;
    next_ = place + 1;
    return &figures_[place];
  }
  return nullptr;
}

}  // namespace mems_stiction
