// The Python class turtlewire.Buffer: arguments in, results out.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include "../feeds/tf_message.hpp"
#include "batch.hpp"
#include "buffer.hpp"
#include "bytes.hpp"
#include "errors.hpp"
#include "inspection.hpp"
#include "lookup_arguments.hpp"
#include "transform.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

template <std::size_t N>
using Values = std::array<PyObject*, N>;

// ---------------------------------------------------------------- lookups

template <typename Arguments>
PyObject* look_up(BufferObject& buffer, const Arguments& arguments) {
  Found found;
  return arguments.lookup(buffer, found) ? make_transform(arguments.target, arguments.source, found)
                                         : nullptr;
}

template <typename Arguments>
PyObject* yes_or_no(BufferObject& buffer, const Arguments& arguments) {
  if (arguments.certainly_can_transform(buffer)) Py_RETURN_TRUE;
  Failure failure;
  if (!arguments.can_transform(buffer, failure)) return nullptr;
  return PyBool_FromLong(failure.status == Status::ok);
}

PyObject* to_python(const std::string& text) {
  return PyUnicode_DecodeUTF8(text.data(), static_cast<Py_ssize_t>(text.size()), "replace");
}

// "" if it can, else tf2's reason.
template <typename Arguments>
PyObject* reason(BufferObject& buffer, const Arguments& arguments) {
  Failure failure;
  if (!arguments.can_transform(buffer, failure)) return nullptr;
  return to_python(explain(failure, Question::can_transform));
}

constexpr char kLookup[] = "lookup_transform";
constexpr char kLookupFull[] = "lookup_transform_full";
constexpr char kCan[] = "can_transform";
constexpr char kCanFull[] = "can_transform_full";
constexpr char kReason[] = "can_transform_reason";
constexpr char kReasonFull[] = "can_transform_full_reason";

using One = AtOneTime<Nanoseconds>;
using Two = AtTwoTimes<Nanoseconds>;

template <const char* Method, typename Arguments, auto Answer>
PyMethodDef question(const char* doc) {
  return fast_method<with_arguments<Method, Arguments, buffer_of, Answer>>(Method, doc);
}

// ---------------------------------------------------------------- data in

bool flag_of(PyObject* object, bool& flag) {
  const int truth = object == nullptr ? 0 : PyObject_IsTrue(object);
  flag = truth == 1;
  return truth >= 0;
}

PyObject* set_transform(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                        PyObject* keywords) {
  static const Signature<7> signature("set_transform", 5,
                                      {"parent_frame", "child_frame", "stamp_ns", "translation",
                                       "rotation", "static", "authority"});
  Values<7> v;
  Stamp stamp = 0;
  bool is_static = false;
  double t[3], q[4];
  std::string_view parent, child, authority = "default_authority";
  BufferObject* buffer = buffer_of(self);
  if (buffer == nullptr || !signature.read(arguments, count, keywords, v) ||
      !text_of(v[0], parent, "parent_frame") || !text_of(v[1], child, "child_frame") ||
      !nanoseconds_of(v[2], stamp, "stamp_ns") || !numbers_of(v[3], t, 3, "translation") ||
      !numbers_of(v[4], q, 4, "rotation") || !flag_of(v[5], is_static) ||
      (v[6] != nullptr && !text_of(v[6], authority, "authority"))) {
    return nullptr;
  }
  const Pose pose{{t[0], t[1], t[2]}, {q[0], q[1], q[2], q[3]}};
  const std::string refusal = buffer->set(parent, child, stamp, pose, authority, is_static);
  if (refusal.empty()) buffer->call_listeners();
  return to_python(refusal);
}

PyObject* ingest(PyObject* self, PyObject* const* arguments, Py_ssize_t count, PyObject* keywords) {
  static const Signature<3> signature("ingest", 1, {"cdr", "static", "authority"});
  thread_local TfMessage message;
  Values<3> v;
  bool is_static = false;
  std::string_view authority = "default_authority";
  BufferObject* buffer = buffer_of(self);
  Bytes bytes;
  if (buffer == nullptr || !signature.read(arguments, count, keywords, v) || !bytes.read(v[0]) ||
      !flag_of(v[1], is_static) || (v[2] != nullptr && !text_of(v[2], authority, "authority"))) {
    return nullptr;
  }
  const std::string fault = message.decode(bytes.data(), bytes.size());
  if (!fault.empty()) {
    buffer->refuse_message(fault, authority);
    return raise_cdr_error(fault);
  }
  const long accepted = buffer->shared.add(message.transforms(), authority, is_static).accepted;
  if (accepted > 0) buffer->call_listeners();
  return PyLong_FromLong(accepted);
}

// ---------------------------------------------------------------- the rest, through nanobind

Stamp latest_common_time(BufferObject& self, std::string_view target, std::string_view source) {
  Stamp t = 0;
  Failure failure;
  if (self.shared.latest_common_time(target, source, t, failure) != Status::ok) {
    raise(failure, Question::latest_common_time, nb::find(self).ptr());
    throw nb::python_error();
  }
  return t;
}

nb::list frame_strings(BufferObject& self) {
  std::vector<std::string> names;
  {
    const SharedBuffer::Access access(self.shared);
    const Names& frames = access->frames();
    for (const FrameId id : access->known_frames()) names.emplace_back(frames[id]);
  }
  nb::list list;
  for (const std::string& name : names) list.append(name);
  return list;
}

template <typename Make>
std::string locked(BufferObject& self, Make make) {
  const SharedBuffer::Access access(self.shared);
  return make(*access);
}

nb::object add_change_listener(nb::handle self, nb::callable listener) {
  auto* buffer = nb::inst_ptr<BufferObject>(self);
  {
    const nb::ft_object_guard guard(buffer->listeners);
    buffer->listeners.append(listener);
    buffer->listeners_changed();
  }
  const nb::object remove = self.attr("_remove_change_listener");
  const auto bound = nb::steal(taking_gil([&]() -> PyObject* {
    PyObject* functools = PyImport_ImportModule("functools");
    if (functools == nullptr) return nullptr;
    PyObject* result =
        PyObject_CallMethod(functools, "partial", "(OO)", remove.ptr(), listener.ptr());
    Py_DECREF(functools);
    return result;
  }));
  if (!bound.is_valid()) throw nb::python_error();
  return bound;
}

void remove_change_listener(BufferObject& self, nb::handle listener) {
  // Without a GIL, others may change the list meanwhile.
  [[maybe_unused]] const nb::ft_object_guard guard(self.listeners);
  for (std::size_t i = 0; i < self.listeners.size(); ++i) {
    if (self.listeners[i].ptr() == listener.ptr()) {
      nb::del(self.listeners[i]);
      self.listeners_changed();
      return;
    }
  }
}

PyObject* buffer_svg(PyObject* self) {
  PyObject* svg = taking_gil([self]() -> PyObject* {
    PyObject* notebook = PyImport_ImportModule("turtlewire.tf.notebook");
    if (notebook == nullptr) return nullptr;
    PyObject* result = PyObject_CallMethod(notebook, "buffer_svg", "(O)", self);
    Py_DECREF(notebook);
    return result;
  });
  if (svg == nullptr) throw nb::python_error();
  return svg;
}

int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (nb::inst_ready(self)) Py_VISIT(nb::inst_ptr<BufferObject>(self)->listeners.ptr());
  return 0;
}

int clear_references(PyObject* self) {
  if (nb::inst_ready(self)) nb::inst_ptr<BufferObject>(self)->listeners.clear();
  return 0;
}

PyMethodDef hot_methods[] = {
    question<kLookup, One, look_up<One>>(
        "lookup_transform($self, target_frame, source_frame, stamp_ns=0, timeout_ns=0)\n--\n\n"
        "The pose of source_frame in target_frame at one time: `target_from_source`.\n\n"
        "Args:\n"
        "    target_frame: The frame in which the answer is expressed.\n"
        "    source_frame: The frame whose pose is asked for.\n"
        "    stamp_ns: Time in nanoseconds; 0 asks for the latest time known to the whole chain.\n"
        "    timeout_ns: How long to wait for data, with the GIL released; 0 does not wait.\n\n"
        "Returns:\n"
        "    A Transform.\n\n"
        "Raises:\n"
        "    InvalidArgumentException: A frame id is empty or starts with a slash.\n"
        "    LookupException: A frame does not exist.\n"
        "    ConnectivityException: The frames are not in one tree.\n"
        "    ExtrapolationException: The data does not reach the time."),
    question<kLookupFull, Two, look_up<Two>>(
        "lookup_transform_full($self, target_frame, target_stamp_ns, source_frame, "
        "source_stamp_ns, fixed_frame, "
        "timeout_ns=0)\n--\n\n"
        "The pose of source_frame at one time in target_frame at another, by way of a frame that "
        "did not move.\n\n"
        "Returns and raises as lookup_transform; the stamp is that of the target."),
    question<kCan, One, yes_or_no<One>>(
        "can_transform($self, target_frame, source_frame, stamp_ns=0, timeout_ns=0)\n--\n\n"
        "Whether lookup_transform with the same arguments gives an answer."),
    question<kCanFull, Two, yes_or_no<Two>>(
        "can_transform_full($self, target_frame, target_stamp_ns, "
        "source_frame, source_stamp_ns, fixed_frame, "
        "timeout_ns=0)\n--\n\nWhether lookup_transform_full with the "
        "same arguments gives an answer."),
    question<kReason, One, reason<One>>(
        "can_transform_reason($self, target_frame, source_frame, stamp_ns=0, timeout_ns=0)\n--\n\n"
        "An empty string if can_transform is true, else tf2's text of why it is not."),
    question<kReasonFull, Two, reason<Two>>(
        "can_transform_full_reason($self, target_frame, target_stamp_ns, source_frame, "
        "source_stamp_ns, "
        "fixed_frame, timeout_ns=0)\n--\n\n"
        "An empty string if can_transform_full is true, else tf2's text of why it is not."),
    fast_method<set_transform>(
        "set_transform",
        "set_transform($self, parent_frame, child_frame, stamp_ns, translation, rotation, "
        "static=False, "
        "authority='default_authority')\n--\n\n"
        "Adds one sample: the pose of child_frame in parent_frame at a time.\n\n"
        "Args:\n"
        "    parent_frame: header.frame_id of a TransformStamped.\n"
        "    child_frame: Its child_frame_id.\n"
        "    stamp_ns: Its time, in nanoseconds.\n"
        "    translation: (x, y, z) in metres.\n"
        "    rotation: Quaternion (x, y, z, w); it is normalised.\n"
        "    static: Whether the pose holds for all times.\n"
        "    authority: Who says so.\n\n"
        "Returns:\n"
        "    An empty string if the sample was accepted, else tf2's reason for refusing it."),
    fast_method<ingest>("ingest",
                        "ingest($self, cdr, static=False, authority='default_authority')\n--\n\n"
                        "Adds the transforms of one tf2_msgs/msg/TFMessage, given as CDR bytes "
                        "with their 4-byte header.\n\n"
                        "Returns:\n"
                        "    How many were accepted.\n\n"
                        "Raises:\n"
                        "    CdrError: The bytes are malformed; nothing of them was added."),
    {nullptr, nullptr, 0, nullptr},
};

PyType_Slot buffer_slots[] = {
    {Py_tp_methods, hot_methods},
    {Py_tp_traverse, reinterpret_cast<void*>(traverse)},
    {Py_tp_clear, reinterpret_cast<void*>(clear_references)},
    {0, nullptr},
};

}  // namespace

BufferObject* buffer_of(PyObject* self) {
  if (!nb::inst_ready(self)) [[unlikely]] {
    PyErr_SetString(PyExc_RuntimeError, "Buffer.__init__() was not called");
    return nullptr;
  }
  return nb::inst_ptr<BufferObject>(self);
}

// CPython calls a C method without a detour only if it was made for the very class of the object:
// 8 ns of a lookup's 50. `turtlewire.Buffer` is derived, so it gets the methods once more.
void bind_hot_methods(nb::handle buffer_type) {
  for (PyMethodDef* method = hot_methods; method->ml_name != nullptr; ++method) {
    const nb::object bound =
        nb::steal(PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(buffer_type.ptr()), method));
    if (!bound.is_valid()) throw nb::python_error();
    nb::setattr(buffer_type, method->ml_name, bound);
  }
}

void add_buffer_type(nb::module_& module) {
  nb::class_<BufferObject> cls(
      module, "Buffer", nb::type_slots(buffer_slots), nb::is_weak_referenceable(),
      "The transforms of a tree of frames over time. Safe for use from many threads.\n\n"
      "Args:\n"
      "    cache_time_ns: How long samples are kept, counted back from the newest of their link; "
      "None: forever.\n"
      "    max_frames: How many frames it takes; transforms of further ones are refused. None: no "
      "limit.");
  cls.def(nb::init<std::optional<Stamp>, std::optional<std::int64_t>>(),
          "cache_time_ns"_a.none() = 10'000'000'000, "max_frames"_a.none() = nb::none())
      .def_prop_ro(
          "cache_time_ns",
          [](BufferObject& self) -> std::optional<Stamp> {
            if (self.shared.keep() == kForever) return std::nullopt;
            return self.shared.keep();
          },
          "How long samples are kept; None: forever.")
      .def_prop_ro(
          "max_frames",
          [](BufferObject& self) -> std::optional<std::size_t> {
            const SharedBuffer::Access access(self.shared);
            if (access->max_frames() == 0) return std::nullopt;
            return access->max_frames();
          },
          "How many frames it takes; None: no limit.")
      .def_prop_ro(
          "is_full",
          [](BufferObject& self) {
            const SharedBuffer::Access access(self.shared);
            return access->is_full();
          },
          "Whether a frame was refused because of max_frames, since frames were last removed.")
      .def("latest_common_time", &latest_common_time, "target_frame"_a, "source_frame"_a,
           "The newest time in nanoseconds that all dynamic links between the frames have reached; "
           "0 if all are static.")
      .def(
          "clear",
          [](BufferObject& self) {
            const SharedBuffer::Access access(self.shared);
            access->clear();
          },
          "Forgets all samples. Frame names and static transforms stay, as in tf2.")
      .def("frame_strings", &frame_strings,
           "The names of all frames ever heard of, in order of arrival.")
      .def(
          "frame_exists",
          [](BufferObject& self, std::string_view frame) {
            const SharedBuffer::Access access(self.shared);
            const auto known = access->frames().find(frame);
            return known.has_value() && access->is_known(*known);
          },
          "frame"_a, "Whether the frame was ever heard of.")
      .def(
          "all_frames_as_string",
          [](BufferObject& self) {
            return locked(self, [](const Tree& b) { return b.frames_as_string(); });
          },
          "tf2's list of frames and parents, one line each.")
      .def(
          "all_frames_as_yaml",
          [](BufferObject& self, double now) {
            return locked(self, [now](const Tree& b) { return b.frames_as_yaml(now); });
          },
          "now"_a = 0.0,
          "tf2's YAML of frames, parents, senders, rates and ages; `now` in seconds adds the "
          "delay.")
      .def(
          "all_frames_as_dot",
          [](BufferObject& self, double now) {
            return locked(self, [now](const Tree& b) { return b.frames_as_dot(now); });
          },
          "now"_a = 0.0, "tf2's Graphviz text of the tree; `now` in seconds adds ages.")
      .def(
          "_repr_svg_", [](nb::handle self) { return nb::steal(buffer_svg(self.ptr())); },
          "The tree of frames as SVG, for notebooks.")
      .def("add_change_listener", &add_change_listener, "listener"_a,
           "Has `listener()` called after data came in, without any lock: on the thread that "
           "brought it or, for data "
           "that\n"
           "the wire's receiving thread stored by itself, on the wire's reader thread, once for "
           "all that came "
           "meanwhile.\n\n"
           "Returns:\n"
           "    A function that removes the listener again.")
      .def("_remove_change_listener", &remove_change_listener, "listener"_a)
      .def(
          "wake", [](BufferObject& self) { self.wake(); },
          "Makes every waiting lookup look at pending signals now, and go on waiting if there is "
          "none.\n\n"
          "For signal handling that does not interrupt the main thread's system call, such as "
          "rclpy's.");
  module.def("bind_hot_methods", &bind_hot_methods, "buffer_type"_a,
             "Gives a class that derives from Buffer its own descriptors of the hot methods, which "
             "CPython calls faster than inherited ones.");
  add_batch_methods(cls);
  add_inspection_methods(cls);
}

}  // namespace turtlewire::python
