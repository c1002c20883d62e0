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
  forward,
  backward,
  no_data,
  kClasses
};
constexpr std::array<const char*, kClasses> kNames{"CdrError",
                                                   "InvalidArgumentException",
                                                   "LookupException",
                                                   "ConnectivityException",
                                                   "TransformException",
                                                   "ForwardExtrapolationException",
                                                   "BackwardExtrapolationException",
                                                   "NoDataForExtrapolationException"};
std::array<PyObject*, kClasses> classes;  // those of turtlewire.errors
PyObject* details_name;

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
    case Status::future:
      return forward;
    case Status::past:
      return backward;
    default:
      return no_data;
  }
}

// The attributes of the exception, by the names that turtlewire.errors gives them. Null without an
// error: there are none.
PyObject* details_of(const Failure& f, Question question, PyObject* buffer) {
  switch (f.status) {
    case Status::unknown_frame:
      return Py_BuildValue("{sNsO}", "frame", text_of(f.name), "buffer", buffer);
    case Status::not_connected:
      if (question == Question::latest_common_time) return nullptr;
      return Py_BuildValue("{sNsNsNsN}", "target_frame", text_of(f.target), "source_frame",
                           text_of(f.source), "target_root", text_of(f.target_root), "source_root",
                           text_of(f.source_root));
    case Status::no_data:
    case Status::future:
    case Status::past:
      return Py_BuildValue(
          "{sNsNsNsNsLsLsLsO}", "target_frame", text_of(f.target), "source_frame",
          text_of(f.source), "parent_frame", text_of(f.link_parent), "child_frame",
          text_of(f.link_child), "requested_ns", static_cast<long long>(f.requested), "oldest_ns",
          static_cast<long long>(f.oldest), "newest_ns", static_cast<long long>(f.newest),
          "has_data", f.emptied ? Py_False : Py_True);
    default:
      return nullptr;
  }
}

PyObject* raise_class(Class which, const std::string& text, PyObject* details) {
  PyObject* message = text_of(text);
  PyObject* error = message == nullptr
                        ? nullptr
                        : taking_gil([=] { return PyObject_CallOneArg(classes[which], message); });
  if (error != nullptr &&
      (details == nullptr || PyObject_SetAttr(error, details_name, details) == 0)) {
    PyErr_SetObject(classes[which], error);
  }
  Py_XDECREF(error);
  Py_XDECREF(message);
  Py_XDECREF(details);
  return nullptr;
}

}  // namespace

void load_error_classes() {
  const nb::module_ errors = nb::module_::import_("turtlewire.errors");
  for (std::size_t i = 0; i < kClasses; ++i)
    classes[i] = nb::object(errors.attr(kNames[i])).release().ptr();
  details_name = PyUnicode_InternFromString("_details");
}

PyObject* raise(const Failure& failure, Question question, PyObject* buffer) {
  PyObject* details = details_of(failure, question, buffer);
  if (details == nullptr && PyErr_Occurred() != nullptr) return nullptr;
  return raise_class(class_of(failure.status, question), explain(failure, question), details);
}

PyObject* raise_cdr_error(const std::string& what) {
  return raise_class(cdr, "not a TFMessage: " + what, nullptr);
}

}  // namespace turtlewire::python
