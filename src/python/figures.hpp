#pragma once

/// @file
/// The figures of the core for Python: their values as a dictionary, with words for enumerations,
/// and what they are as a class whose annotations and text are made of their declarations.

#include <pybind11/pybind11.h>

#include <string>

#include "evaluation/record.hpp"
#include "half_space/half_space_fields.hpp"
#include "prediction/prediction_fields.hpp"
#include "verdict/verdict_fields.hpp"

namespace mems_stiction {
namespace python {

/// Visitor that adds fields to a dictionary.
class DictionaryFields {
 public:
  template <typename Value>
  void operator()(const Figure& figure, const Value& value) {
    dictionary[figure.name] = shown(value);
  }

  pybind11::dict dictionary;
};

/// What `visit` shows to the visitor that it is called with.
template <typename Visit>
pybind11::dict dictionaryOf(const Visit& visit) {
  DictionaryFields fields;
  visit(fields);
  return fields.dictionary;
}

/// A dictionary for each step of the cleaning that ran.
inline pybind11::list stepsOf(const PreprocessRecord& record) {
  pybind11::list steps;
  for (const PreprocessStep& step : record.steps) {
    steps.append(dictionaryOf([&](auto& fields) { visitStepFields(step, fields); }));
  }
  return steps;
}

/// Visitor that makes {name: (type, unit, meaning)} and a class without anything but annotations
/// and a text.
class DeclaredFields {
 public:
  template <typename Value>
  void operator()(const Figure& figure, const Value& /*value*/) {
    const pybind11::object type = pybind11::type::of(pybind11::cast(shown(Value())));
    annotations_[figure.name] = type;
    declared_[figure.name] =
        pybind11::make_tuple(type.attr("__name__"), figure.unit, figure.meaning);
    text_ += std::string(text_.empty() ? "" : "\n") + figure.name;
    if (*figure.unit != '\0') text_ += std::string(" [") + figure.unit + "]";
    text_ += std::string(": ") + figure.meaning;
  }

  /// Adds the class, and its declarations to `figures` of the module.
  void addTo(pybind11::module& module, const char* name) const {
    pybind11::dict body;
    body["__module__"] = module.attr("__name__");
    body["__doc__"] = text_;
    body["__annotations__"] = annotations_;
    const auto type =
        pybind11::reinterpret_borrow<pybind11::object>(reinterpret_cast<PyObject*>(&PyType_Type));
    module.attr(name) = type(name, pybind11::tuple(), body);
    if (!pybind11::hasattr(module, "figures")) module.attr("figures") = pybind11::dict();
    module.attr("figures")[name] = declared_;
  }

 private:
  pybind11::dict annotations_;
  pybind11::dict declared_;
  std::string text_;
};

/// The figures of a verdict, and who judged.
template <typename Visitor>
void visitJudgedFields(const Verdict& verdict, Visitor&& visit) {
  visitVerdictFields(verdict, visit);
  visit({"verdict_by", "", "whose figures it rests on: prediction or half_space"},
        std::string(judgeText(verdict.judge)));
}

inline pybind11::dict verdictFigures(const Verdict& verdict) {
  return dictionaryOf([&](auto& fields) { visitJudgedFields(verdict, fields); });
}

}  // namespace python
}  // namespace mems_stiction
