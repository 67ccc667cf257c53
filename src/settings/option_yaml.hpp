#pragma once

/// @file
/// Settings from YAML and back, for anything that describes itself to an OptionVisitor.
///
/// Keys are either nested maps or flat names with slashes: `lower: {hardness: 12e9}` and
/// `lower/hardness: 12e9` are the same. Every key supplied must belong to exactly one described
/// field, so that a typing error is an error and not a default. A key that one map has twice is an
/// error that names both lines. Numbers may be quoted: PyYAML and rosparam hand over `1e-9` as a
/// string.
///
///     readYaml(YAML::Load(text), [&](OptionVisitor& visitor) {
///       configuration.describe(visitor);
///       visitor.integer("queue_size", queue_size, Range::within(1, 1000), "scans that may wait");
///     });

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "mems_stiction/settings/option_visitor.hpp"

namespace YAML {
class Node;
}

namespace mems_stiction {

/// Shows every field of one or several options structs to the visitor.
using DescribeFunction = std::function<void(OptionVisitor&)>;

/// Sets the described fields that `tree` names and leaves the others. Supplied and untouched fields
/// are checked against their ranges.
/// @return one line for each key that is unknown, given twice, of the wrong type or out of range;
/// empty when all is well. A number out of range has been stored; after any violation the fields
/// are not fit for use.
std::vector<std::string> readYaml(const YAML::Node& tree, const DescribeFunction& describe);

/// Keys and values that the tree states, nested ones with slashes, in its order. Ends where
/// readYaml() refuses the tree.
std::vector<std::pair<std::string, YAML::Node>> statedIn(const YAML::Node& tree);

/// The keys of statedIn().
std::vector<std::string> keysOf(const YAML::Node& tree);

/// The tree without these keys.
YAML::Node withoutKeys(const YAML::Node& tree, const std::vector<std::string>& keys);

/// What states nothing where somebody may have meant to: an empty text, a section with nothing
/// below.
std::vector<std::string> emptyPartsOf(const YAML::Node& tree);

/// A value that came as a number or a flag from a source that has types, where 0017 has become 15
/// or 17. It serves for numbers, flags and choices; a text setting refuses it.
/// - @p type YAML's name: "int", "float" or "bool"
YAML::Node typedNode(const std::string& value, const std::string& type);

/// Every described field as nested YAML, its unit, range and meaning beside it as a comment. Reads
/// back by readYaml().
std::string toYaml(const DescribeFunction& describe);

/// A number as YAML 1.1 and 1.2 both take for a number: "2.0e-09", ".nan", "-.inf".
std::string yamlNumber(double value);

}  // namespace mems_stiction
