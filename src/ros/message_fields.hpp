#pragma once

/// @file
/// Figures into the fields of a message that bear their names, so that no field is written down
/// beside the definition of the message and the declaration of the figure. A figure without a field
/// is left out, as is a field without a figure.
///
///     MessageFields fields;
///     visitPredictionFields(prediction, fields);
///     fields.fill(message);

#include <ros/message_traits.h>
#include <ros/serialization.h>

#include <cstddef>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <vector>

#include "mems_stiction/settings/figure.hpp"

namespace mems_stiction {

/// The fields of a definition in their order, without constants; those of the messages within are
/// not.
std::vector<std::string> fieldNames(const std::string& definition);

/// Visitor that takes figures, and what the fields of a message are then read from, as from the
/// wire. Texts must live until then.
class MessageFields {
 public:
  template <typename Value>
  void operator()(const Figure& figure, const Value& value) {
    if constexpr (std::is_same_v<Value, std::string>) {
      figures_.push_back({figure.name, 0.0, &value});
    } else {
      figures_.push_back({figure.name, static_cast<double>(value), nullptr});
    }
  }

  /// Forgets the figures.
  template <typename Message>
  void fill(Message& message) {
    static const std::vector<std::string> names =
        fieldNames(ros::message_traits::Definition<Message>::value());
    name_ = names.data();
    ros::serialization::deserialize(*this, message);
    figures_.clear();
  }

  /// For ros::serialization: the field that comes next in the definition.
  template <typename Field>
  void next(Field& field) {
    const Entry* value = valueOf(*name_++);
    if (value == nullptr) return;
    if constexpr (std::is_arithmetic_v<Field>) {
      field = static_cast<Field>(value->number);
    } else if constexpr (std::is_same_v<Field, std::string>) {
      if (value->text == nullptr)
        throw std::logic_error(std::string(value->name) + ": a number for a field of text");
      field = *value->text;
    }
  }

 private:
  struct Entry {
    const char* name;
    double number;  ///< also of counts, of 32 bits at most
    const std::string* text;
  };

  /// Null for a field without a figure.
  const Entry* valueOf(const std::string& name);

  std::vector<Entry> figures_;
  std::size_t next_ = 0;  ///< behind the one that was found: the next field is likely its
  const std::string* name_ = nullptr;
};

}  // namespace mems_stiction
