/// Errors by name, and settings from a dictionary or a file, both with the words of the core.

#include <pybind11/stl.h>
#include <yaml-cpp/yaml.h>

#include <opencv2/core.hpp>

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "bindings.hpp"
#include "configuration/named_files.hpp"
#include "evaluation/plausibility.hpp"
#include "evaluation/row_columns.hpp"
#include "mems_stiction/configuration/configuration_yaml.hpp"
#include "mems_stiction/configuration/provenance.hpp"
#include "mems_stiction/errors/errors.hpp"
#include "numeric/words.hpp"
#include "settings/option_yaml.hpp"
#include "settings/yaml_text.hpp"

namespace mems_stiction {
namespace python {
namespace {

namespace py = pybind11;
using py::literals::operator""_a;

/// Python's values as the reader of configuration files sees them: numbers and words are scalars,
/// anything that has no place in a configuration is the text that Python shows for it, so that the
/// reader names it.
YAML::Node nodeOf(const py::handle& value) {
  if (value.is_none()) return YAML::Node(YAML::NodeType::Null);
  if (py::isinstance<py::bool_>(value))
    return typedNode(py::cast<bool>(value) ? "true" : "false", "bool");
  if (py::isinstance<py::str>(value)) return YAML::Node(py::cast<std::string>(value));
  if (py::isinstance<py::float_>(value))
    return typedNode(yamlNumber(py::cast<double>(value)), "float");
  if (py::isinstance<py::int_>(value)) return typedNode(std::string(py::str(value)), "int");
  if (py::isinstance<py::dict>(value)) {
    YAML::Node map(YAML::NodeType::Map);
    for (const auto& entry : py::reinterpret_borrow<py::dict>(value)) {
      map.force_insert(std::string(py::str(entry.first)), nodeOf(entry.second));
    }
    return map;
  }
  if (py::isinstance<py::list>(value) || py::isinstance<py::tuple>(value)) {
    YAML::Node list(YAML::NodeType::Sequence);
    for (const py::handle& item : value) list.push_back(nodeOf(item));
    return list;
  }
  return YAML::Node(std::string(py::str(value)));
}

/// Raises an error whose text may name a file, whose name may be no UTF-8.
void raise(PyObject* kind, const std::string& text) {
  const auto size = static_cast<Py_ssize_t>(text.size());
  const py::object message = py::reinterpret_steal<py::object>(
      PyUnicode_DecodeUTF8(text.data(), size, "backslashreplace"));
  if (message) PyErr_SetObject(kind, message.ptr());
}

}  // namespace

void bindErrors(py::module& module) {
  // A base that is a tuple: PyErr_NewException takes several.
  const py::object base(py::exception<Error>(module, "Error", PyExc_Exception));
  const auto bases = [&base](PyObject* other) {
    return py::make_tuple(base, py::reinterpret_borrow<py::object>(other));
  };
  // Never let go of: they must outlive every exception, and no object of Python may be freed after
  // its interpreter.
  static PyObject* const error = py::object(base).release().ptr();
  static PyObject* const options_error =
      py::exception<OptionsError>(module, "OptionsError", bases(PyExc_ValueError)).release().ptr();
  static PyObject* const surface_error =
      py::exception<SurfaceError>(module, "SurfaceError", bases(PyExc_ValueError)).release().ptr();
  static PyObject* const file_error =
      py::exception<FileError>(module, "FileError", bases(PyExc_OSError)).release().ptr();
  // NOLINTNEXTLINE(performance-unnecessary-value-param): the signature is pybind11's
  py::register_exception_translator([](std::exception_ptr thrown) {
    try {
      if (thrown) std::rethrow_exception(thrown);
    } catch (const OptionsError& caught) {
      raise(options_error, caught.what());
    } catch (const SurfaceError& caught) {
      raise(surface_error, caught.what());
    } catch (const FileError& caught) {
      raise(file_error, caught.what());
    } catch (const Error& caught) {
      raise(error, caught.what());
    } catch (const cv::Exception& caught) {
      if (caught.code != cv::Error::StsNoMem) throw;
      raise(PyExc_MemoryError, caught.err);
    }
  });
}

void bindSettings(py::module& module) {
  module.def("version", &packageVersion, "of the package, which the core was compiled with");
  module.def(
      "column_groups",
      [] {
        std::vector<std::pair<std::string, std::string>> groups;
        for (const ColumnGroup& group : columnGroups())
          groups.emplace_back(group.name, group.meaning);
        return groups;
      },
      "names and meanings, in the order in which they take columns");
  module.def("chosen_columns", &chosenColumns, "names"_a, "known"_a, "wanted"_a = std::nullopt);
  py::class_<Configuration>(module, "Configuration")
      .def(py::init<>())
      .def(
          "changed",
          [](const Configuration& configuration, const py::dict& tree, const py::dict& over) {
            const YAML::Node node = nodeOf(tree);
            const YAML::Node before = nodeOf(over);
            Configuration changed = configurationFromYaml(node, before, configuration);
            std::vector<std::string> keys = keysOf(node);
            addMissing(keysOf(before), keys);
            placeNamedFiles(keys, std::filesystem::current_path(), changed);
            return changed;
          },
          "tree"_a, "over"_a)
      .def(
          "loaded",
          [](const Configuration& configuration, const py::bytes& path, const py::dict& over) {
            return loadConfiguration(path, nodeOf(over), configuration);
          },
          "path"_a, "over"_a)
      .def(
          "read",
          [](const Configuration& configuration, const std::string& text) {
            return configurationFromYaml(parseYaml(text, "settings"), configuration);
          },
          "text"_a)
      .def_property_readonly("warnings", &settingsWarnings)
      .def_property_readonly("pitch",
                             [](const Configuration& configuration) {
                               return std::make_pair(configuration.scan.pitch_x,
                                                     configuration.scan.pitch_y);
                             })
      .def("yaml", [](const Configuration& configuration) { return toYaml(configuration); });
}

}  // namespace python
}  // namespace mems_stiction
