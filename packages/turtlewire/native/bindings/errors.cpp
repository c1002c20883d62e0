#include "errors.hpp"

#include <nanobind/nanobind.h>

#include <array>

#include "gil.hpp"

namespace turtlewire::python {
namespace nb = nanobind;
namespace {

enum Class : std::size_t {
  cdr,
  invalid_argument,
  lookup,
  connectivity,
  transform,
  extrapolation,
  kClasses
};
constexpr std::array<const char*, kClasses> kNames{"CdrError",           "InvalidArgumentException",
                                                   "LookupException",    "ConnectivityException",
                                                   "TransformException", "ExtrapolationException"};
std::array<PyObject*, kClasses> classes;  // those of turtlewire.errors

// The attributes of the exceptions, by the names that turtlewire.errors documents.
enum Field : std::size_t {
  frame,
  buffer_asked,
  target_frame,
  source_frame,
  target_root,
  source_root,
  parent_frame,
  child_frame,
  requested_ns,
  oldest_ns,
  newest_ns,
  has_data,
  reason,
  kFields
};
constexpr std::array<const char*, kFields> kFieldNames{
    "frame",       "_buffer",      "target_frame", "source_frame", "target_root",
    "source_root", "parent_frame", "child_frame",  "requested_ns", "oldest_ns",
    "newest_ns",   "_has_data",    "reason"};
std::array<PyObject*, kFields> field_names;

PyObject* text_of(const std::string& text) {
  return PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
}

Class class_of(Status status, Question question) {
  switch (status) {
    case Status::empty_name:
    case Status::slash_name:
      return invalid_argument;
    case Status::unknown_frame:
      return lookup;
    case Status::loop:
      return question == Question::latest_common_time ? transform : lookup;
    case Status::not_connected:
      return question == Question::latest_common_time ? transform : connectivity;
    default:
      return extrapolation;
  }
}

const char* reason_of(Status status) {
  switch (status) {
    case Status::future:
      return "future";
    case Status::past:
      return "past";
    default:
      return "no data";
  }
}

// Each sets one attribute; false with a Python error set.
bool set(PyObject* error, Field field, PyObject* value) {
  return PyObject_SetAttr(error, field_names[field], value) == 0;
}
bool set_new(PyObject* error, Field field, PyObject* value) {
  const bool done = value != nullptr && set(error, field, value);
  Py_XDECREF(value);
  return done;
}
bool set(PyObject* error, Field field, const std::string& text) {
  return set_new(error, field, text_of(text));
}
bool set(PyObject* error, Field field, Stamp stamp) {
  return set_new(error, field, PyLong_FromLongLong(stamp));
}

bool describe(PyObject* error, const Failure& f, Question question, PyObject* buffer) {
  switch (f.status) {
    case Status::unknown_frame:
      return set(error, frame, f.name) && set(error, buffer_asked, buffer);
    case Status::not_connected:
      return question == Question::latest_common_time ||
             (set(error, target_frame, f.target) && set(error, source_frame, f.source) &&
              set(error, target_root, f.target_root) && set(error, source_root, f.source_root));
    case Status::no_data:
    case Status::future:
    case Status::past:
      return set(error, target_frame, f.target) && set(error, source_frame, f.source) &&
             set(error, parent_frame, f.link_parent) && set(error, child_frame, f.link_child) &&
             set(error, requested_ns, f.requested) && set(error, oldest_ns, f.oldest) &&
             set(error, newest_ns, f.newest) &&
             set(error, has_data, f.emptied ? Py_False : Py_True) &&
             set_new(error, reason, PyUnicode_InternFromString(reason_of(f.status)));
    default:
      return true;
  }
}

// Null with a Python error set if there is no memory for it.
PyObject* make(Class which, const std::string& text) {
  PyObject* message = text_of(text);
  if (message == nullptr) return nullptr;
  PyObject* error =
      taking_gil([=] { return PyObject_CallFunctionObjArgs(classes[which], message, nullptr); });
  Py_DECREF(message);
  return error;
}

}  // namespace

void load_error_classes() {
  const nb::module_ errors = nb::module_::import_("turtlewire.errors");
  for (std::size_t i = 0; i < kClasses; ++i)
    classes[i] = nb::object(errors.attr(kNames[i])).release().ptr();
  for (std::size_t i = 0; i < kFields; ++i)
    field_names[i] = PyUnicode_InternFromString(kFieldNames[i]);
}

PyObject* raise(const Failure& failure, Question question, PyObject* buffer) {
  const Class which = class_of(failure.status, question);
  PyObject* error = make(which, explain(failure, question));
  if (error != nullptr && describe(error, failure, question, buffer))
    PyErr_SetObject(classes[which], error);
  Py_XDECREF(error);
  return nullptr;
}

PyObject* raise_cdr_error(const std::string& what) {
  PyObject* error = make(cdr, "not a TFMessage: " + what);
  if (error != nullptr) PyErr_SetObject(classes[cdr], error);
  Py_XDECREF(error);
  return nullptr;
}

}  // namespace turtlewire::python
