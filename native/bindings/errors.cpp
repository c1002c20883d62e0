#include "errors.hpp"

#include <nanobind/nanobind.h>

namespace turtlewire::python {
namespace nb = nanobind;
namespace {

// The class of turtlewire.errors, looked up once; null with an error set.
PyObject* error_class(const char* name) {
  static PyObject* const module = PyImport_ImportModule("turtlewire.errors");
  return module != nullptr ? PyObject_GetAttrString(module, name) : nullptr;
}

PyObject* text_of(const std::string& text) {
  return PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
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
    case Status::future:
      return "ForwardExtrapolationException";
    case Status::past:
      return "BackwardExtrapolationException";
    default:
      return "NoDataForExtrapolationException";
  }
}

// What the properties of the exception show; the order is documented there. Null without an error: nothing to tell.
PyObject* details_of(const Failure& f, Question question, PyObject* buffer) {
  switch (f.status) {
    case Status::unknown_frame:
      return Py_BuildValue("(NO)", text_of(f.name), buffer);
    case Status::not_connected:
      if (question == Question::latest_common_time) return nullptr;
      return Py_BuildValue("(NNNN)", text_of(f.target), text_of(f.source), text_of(f.target_root),
                           text_of(f.source_root));
    case Status::no_data:
    case Status::future:
    case Status::past:
      return Py_BuildValue("(NNNNLLLO)", text_of(f.target), text_of(f.source), text_of(f.link_parent),
                           text_of(f.link_child), static_cast<long long>(f.requested), static_cast<long long>(f.oldest),
                           static_cast<long long>(f.newest), f.emptied ? Py_False : Py_True);
    default:
      return nullptr;
  }
}

PyObject* raise_named(const char* class_name, const std::string& text, PyObject* details) {
  static PyObject* const details_name = PyUnicode_InternFromString("_details");
  PyObject* type = error_class(class_name);
  PyObject* message = type != nullptr ? text_of(text) : nullptr;
  PyObject* error = message != nullptr ? PyObject_CallOneArg(type, message) : nullptr;
  if (error != nullptr && (details == nullptr || PyObject_SetAttr(error, details_name, details) == 0)) {
    PyErr_SetObject(type, error);
  }
  Py_XDECREF(error);
  Py_XDECREF(message);
  Py_XDECREF(type);
  Py_XDECREF(details);
  return nullptr;
}

}  // namespace

PyObject* raise(const Failure& failure, Question question, PyObject* buffer) {
  PyObject* details = details_of(failure, question, buffer);
  if (details == nullptr && PyErr_Occurred() != nullptr) return nullptr;
  return raise_named(class_of(failure.status, question), explain(failure, question), details);
}

PyObject* raise_cdr_error(const std::string& what) {
  return raise_named("CdrError", "not a TFMessage: " + what, nullptr);
}

}  // namespace turtlewire::python
