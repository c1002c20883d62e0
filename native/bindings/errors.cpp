#include "errors.hpp"

#include <nanobind/nanobind.h>

namespace turtlewire::python {
namespace nb = nanobind;
namespace {

PyObject* raise_named(const char* class_name, const std::string& text) {
  PyObject* module = PyImport_ImportModule("turtlewire.errors");
  if (module == nullptr) return nullptr;
  PyObject* type = PyObject_GetAttrString(module, class_name);
  Py_DECREF(module);
  if (type == nullptr) return nullptr;
  PyObject* message = PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
  if (message != nullptr) PyErr_SetObject(type, message);
  Py_XDECREF(message);
  Py_DECREF(type);
  return nullptr;
}

const char* class_of(Status status, Question question) {
  switch (status) {
    case Status::empty_name:
    case Status::slash_name:
      return "InvalidArgumentException";
    case Status::unknown_frame:
      return "LookupException";
    case Status::loop:
      return question == Question::latest_common_time ? "TransformException" : "LookupException";
    case Status::not_connected:
      return question == Question::latest_common_time ? "TransformException" : "ConnectivityException";
    default:
      return "ExtrapolationException";
  }
}

}  // namespace

PyObject* raise(const Failure& failure, Question question) {
  return raise_named(class_of(failure.status, question), explain(failure, question));
}

PyObject* raise_cdr_error(const std::string& what) { return raise_named("CdrError", "not a TFMessage: " + what); }

}  // namespace turtlewire::python
