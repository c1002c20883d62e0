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
  invalid_transform,
  kClasses
};
constexpr std::array<const char*, kClasses> kNames{"CdrError",
                                                   "InvalidArgumentException",
                                                   "LookupException",
                                                   "ConnectivityException",
                                                   "TransformException",
                                                   "ExtrapolationException",
                                                   "InvalidTransformError"};
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
  reason,
  sender,
  row,
  in_batch,
  kFields
};
constexpr std::array<const char*, kFields> kFieldNames{
    "frame",       "_buffer",      "target_frame", "source_frame", "target_root",
    "source_root", "parent_frame", "child_frame",  "requested_ns", "oldest_ns",
    "newest_ns",   "reason",       "sender",       "row",          "_in_batch"};
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
    case Status::no_static_data:
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

const char* reason_of(const Refusal& refusal) {
  switch (refusal.verdict) {
    case Verdict::accepted:
      break;
    case Verdict::self_transform:
      return "self";
    case Verdict::no_child_frame:
      return "no child";
    case Verdict::no_parent_frame:
      return "no parent";
    case Verdict::nan_value:
      return refusal.pose.rotation == Quat{0, 0, 0, 0} ? "zero quaternion" : "nan";
    case Verdict::denormalized:
      return "denormalized";
    case Verdict::old_data:
      return "old";
    case Verdict::reserved_name:
    case Verdict::bad_name:
      return "bad name";
    case Verdict::too_many_frames:
      return "too many frames";
  }
  return "";
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
bool set_if(bool known, PyObject* error, Field field, Stamp stamp) {
  return known ? set(error, field, stamp) : set(error, field, Py_None);
}

bool describe(PyObject* error, const Failure& f, Question question, PyObject* buffer) {
  switch (f.status) {
    case Status::empty_name:
    case Status::slash_name:
      return set(error, frame, f.name);
    case Status::unknown_frame:
      return set(error, frame, f.name) && set(error, buffer_asked, buffer);
    case Status::loop:
      return question == Question::latest_common_time || set(error, buffer_asked, buffer);
    case Status::not_connected:
      return question == Question::latest_common_time ||
             (set(error, target_frame, f.target) && set(error, source_frame, f.source) &&
              set(error, target_root, f.target_root) && set(error, source_root, f.source_root));
    case Status::no_data:
    case Status::future:
    case Status::past:
      return set(error, target_frame, f.target) && set(error, source_frame, f.source) &&
             set(error, parent_frame, f.link_parent) && set(error, child_frame, f.link_child) &&
             set_if(f.requested != kLatest, error, requested_ns, f.requested) &&
             set_if(!f.emptied, error, oldest_ns, f.oldest) &&
             set_if(!f.emptied, error, newest_ns, f.newest) &&
             set_new(error, reason, PyUnicode_InternFromString(reason_of(f.status))) &&
             set(error, buffer_asked, buffer);
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

PyObject* make_error(const Failure& failure, Question question, PyObject* buffer) {
  PyObject* error = make(class_of(failure.status, question), explain(failure, question));
  if (error == nullptr || describe(error, failure, question, buffer)) return error;
  Py_DECREF(error);
  return nullptr;
}

PyObject* raise(const Failure& failure, Question question, PyObject* buffer) {
  PyObject* error = make_error(failure, question, buffer);
  if (error != nullptr) PyErr_SetObject(classes[class_of(failure.status, question)], error);
  Py_XDECREF(error);
  return nullptr;
}

PyObject* raise_in_batch(const Failure& failure, PyObject* buffer) {
  PyObject* error = make_error(failure, Question::lookup, buffer);
  const Class which = class_of(failure.status, Question::lookup);
  if (error != nullptr && (which != extrapolation || set(error, in_batch, Py_True)))
    PyErr_SetObject(classes[which], error);
  Py_XDECREF(error);
  return nullptr;
}

PyObject* raise(const Refusal& refusal, std::optional<std::size_t> place) {
  PyObject* error = make(invalid_transform, explain(refusal));
  if (error != nullptr && set(error, parent_frame, std::string(refusal.parent)) &&
      set(error, child_frame, std::string(refusal.child)) &&
      set(error, sender, std::string(refusal.authority)) &&
      set_new(error, reason, PyUnicode_InternFromString(reason_of(refusal))) &&
      (!place || set_new(error, row, PyLong_FromSize_t(*place)))) {
    PyErr_SetObject(classes[invalid_transform], error);
  }
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
