// The Python class turtlewire.Buffer: arguments in, results out.
#include <nanobind/stl/optional.h>
#include <nanobind/stl/string.h>
#include <nanobind/stl/string_view.h>

#include "buffer_methods.hpp"
#include "errors.hpp"
#include "lookup_arguments.hpp"
#include "transform.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

// ---------------------------------------------------------------- lookups

PyObject* look_up(BufferObject& buffer, const Lookup& asked) {
  Found found;
  return asked.lookup(buffer, found) ? make_transform(asked.target, asked.source, found) : nullptr;
}

PyObject* yes_or_no(BufferObject& buffer, const Lookup& asked) {
  if (asked.certainly_can_transform(buffer)) Py_RETURN_TRUE;
  Failure failure;
  if (!asked.can_transform(buffer, failure)) return nullptr;
  return PyBool_FromLong(failure.status == Status::ok);
}

PyObject* why_not(BufferObject& buffer, const Lookup& asked) {
  Failure failure;
  if (!asked.lookup_failure(buffer, failure)) return nullptr;
  if (failure.status == Status::ok) Py_RETURN_NONE;
  return make_error(failure, Question::lookup, nb::find(buffer).ptr());
}

// "" if it can, else the reason in the words of tf2's canTransform.
PyObject* reason(BufferObject& buffer, const Lookup& asked) {
  Failure failure;
  if (!asked.can_transform(buffer, failure)) return nullptr;
  return to_python(explain(failure, Question::can_transform));
}

constexpr char kLookup[] = "lookup_transform";
constexpr char kCan[] = "can_transform";
constexpr char kExplain[] = "explain";
constexpr char kReason[] = "_can_transform_reason";

template <const char* Method, auto Answer>
PyMethodDef question(const char* doc) {
  return fast_method<with_arguments<Method, Lookup, buffer_of, Answer>>(Method, doc);
}

// ---------------------------------------------------------------- the rest, through nanobind

// The question of ROS 2; kLatest, the answer for static links, is its time 0.
Stamp latest_common_time(BufferObject& self, std::string_view target, std::string_view source) {
  Stamp t = kLatest;
  Failure failure;
  if (self.shared.latest_common_time(target, source, t, failure) != Status::ok) {
    throw_failure(self, failure, Question::latest_common_time);
  }
  return t != kLatest ? t : 0;
}

constexpr Parameters<0> kFrames{"frames", 0, 0, {}};

nb::list frames(BufferObject& self, const Values<0>&) {
  std::vector<std::string> names;
  {
    const SharedBuffer::Access access(self.shared);
    for (const FrameId id : access->known_frames()) names.emplace_back(access->frames()[id]);
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

double seconds_of(PyObject* present) {
  const Stamp now = moment_of(nb::handle(present), "now_ns");
  return now != kLatest ? static_cast<double>(now) / 1e9 : 0.0;
}

constexpr Parameters<1> kToYaml{"to_yaml", 0, 0, {"now_ns"}};

nb::str to_yaml(BufferObject& self, const Values<1>& given) {
  const double now = seconds_of(given[0]);
  return text(locked(self, [now](const Tree& b) { return b.frames_as_yaml(now); }));
}

constexpr Parameters<1> kToDot{"to_dot", 0, 0, {"now_ns"}};

nb::str to_dot(BufferObject& self, const Values<1>& given) {
  const double now = seconds_of(given[0]);
  return text(locked(self, [now](const Tree& b) { return b.frames_as_dot(now); }));
}

constexpr Parameters<0> kClear{"clear", 0, 0, {}};

nb::object clear(BufferObject& self, const Values<0>&) {
  const SharedBuffer::Access access(self.shared);
  access->clear();
  return nb::none();
}

constexpr Parameters<1> kOnChange{"on_change", 1, 1, {"call"}};

nb::object on_change(BufferObject& buffer, const Values<1>& given) {
  const nb::handle listener = given[0];
  if (PyCallable_Check(listener.ptr()) == 0) {
    const nb::str text("call must be a function that takes no arguments, not {}");
    throw nb::type_error(text.format(listener.type().attr("__name__")).c_str());
  }
  {
    const nb::ft_object_guard guard(buffer.listeners);
    buffer.listeners.append(listener);
    buffer.listeners_changed();
  }
  const nb::object remove = nb::find(buffer).attr("_remove_change_listener");
  return checked(call_python("functools", "partial", "OO", remove.ptr(), listener.ptr()));
}

constexpr Parameters<2> kBuffer{"Buffer", 0, 2, {"cache_time_ns", "max_frames"}};

void initialize(BufferObject* self, const nb::args& arguments, const nb::kwargs& keywords) {
  static constinit const Signature signature(kBuffer);
  Values<2> given;
  if (!signature.read_all(arguments.ptr(), keywords.ptr(), given)) throw nb::python_error();
  const nb::object keep = given[0] == nullptr ? nb::int_(10'000'000'000) : nb::borrow(given[0]);
  new (self) BufferObject(keep, or_none(given[1]));
}

void remove_change_listener(BufferObject& self, nb::handle listener) {
  // Without a GIL, other threads may change the list at the same time.
  [[maybe_unused]] const nb::ft_object_guard guard(self.listeners);
  for (std::size_t i = 0; i < self.listeners.size(); ++i) {
    if (self.listeners[i].ptr() == listener.ptr()) {
      nb::del(self.listeners[i]);
      self.listeners_changed();
      return;
    }
  }
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

const std::array<PyMethodDef, 4> kQuestions{
    question<kLookup, look_up>(
        "lookup_transform($self, target_frame, source_frame, stamp_ns=None, *, timeout_ns=0, "
        "extrapolate_ns=0, fixed_frame=None, target_stamp_ns=None)\n--\n\n"
        "The pose of source_frame in target_frame at one time: `target_from_source`.\n\n"
        "Args:\n"
        "    target_frame: The frame in which the answer is expressed.\n"
        "    source_frame: The frame whose pose is asked for.\n"
        "    stamp_ns: The time of the data: an int of nanoseconds, or a datetime64; None asks for "
        "the latest time known to the whole chain.\n"
        "    timeout_ns: How long to wait for data, with the GIL released; 0 does not wait.\n"
        "    extrapolate_ns: How far outside of a link's data the motion between its two outermost "
        "samples is taken to go on; tf2 never does this.\n"
        "    fixed_frame: A frame that does not move: the answer is the pose of the source at "
        "`stamp_ns`, as the target sees it at `target_stamp_ns`.\n"
        "    target_stamp_ns: The time of the target with a fixed frame; None is the latest.\n\n"
        "Returns:\n"
        "    A Transform.\n\n"
        "Raises:\n"
        "    InvalidArgumentException: A frame id is empty or starts with a slash.\n"
        "    LookupException: A frame does not exist.\n"
        "    ConnectivityException: The frames are not in one tree.\n"
        "    ExtrapolationException: The data does not reach the time."),
    question<kCan, yes_or_no>(
        "can_transform($self, target_frame, source_frame, stamp_ns=None, *, timeout_ns=0, "
        "extrapolate_ns=0, fixed_frame=None, target_stamp_ns=None)\n--\n\n"
        "Whether lookup_transform with the same arguments gives an answer."),
    question<kExplain, why_not>(
        "explain($self, target_frame, source_frame, stamp_ns=None, *, timeout_ns=0, "
        "extrapolate_ns=0, fixed_frame=None, target_stamp_ns=None)\n--\n\n"
        "What lookup_transform with the same arguments would raise, not raised; None if it gives "
        "an answer."),
    question<kReason, reason>(
        "_can_transform_reason($self, target_frame, source_frame, stamp_ns=None, *, timeout_ns=0, "
        "extrapolate_ns=0, fixed_frame=None, target_stamp_ns=None)\n--\n\n"
        "An empty string if can_transform is true, else tf2's text of why it is not."),
};

const std::array<PyMethodDef, 5> kContents{
    buffer_method<kFrames, frames>(
        "frames($self)\n--\n\nThe names of all frames, in order of arrival."),
    buffer_method<kClear, clear>(
        "clear($self)\n--\n\n"
        "Forgets all samples. Frame names and static transforms stay, as in tf2."),
    buffer_method<kToYaml, to_yaml>(
        "to_yaml($self, *, now_ns=None)\n--\n\n"
        "tf2's YAML of frames, parents, senders, rates and ages; `now_ns` adds the delay."),
    buffer_method<kToDot, to_dot>("to_dot($self, *, now_ns=None)\n--\n\n"
                                  "tf2's Graphviz text of the tree; `now_ns` adds ages."),
    buffer_method<kOnChange, on_change>(
        "on_change($self, call)\n--\n\n"
        "Calls `call()` after data came in, without any lock: on the thread that brought it or, "
        "for data that\n"
        "the wire's receiving thread stored by itself, on the wire's reader thread, once for all "
        "that came meanwhile.\n\n"
        "Returns:\n"
        "    A function that ends the calls."),
};

// One table of the parts, with the empty entry that ends it.
template <std::size_t... N>
auto joined(const std::array<PyMethodDef, N>&... parts) {
  std::array<PyMethodDef, (N + ... + 1)> all{};
  auto* end = all.data();
  ((end = std::copy(parts.begin(), parts.end(), end)), ...);
  return all;
}

auto methods = joined(kQuestions, kContents, addition_methods(), batch_methods(), history_methods(),
                      inspection_methods());

PyType_Slot buffer_slots[] = {
    {Py_tp_methods, methods.data()},
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

// CPython calls a C method directly only if it was defined for the object's own class, which saves
// 8 ns of a lookup's 50. `turtlewire.Buffer` is derived, so it gets the methods again.
void bind_methods(nb::handle buffer_type) {
  for (PyMethodDef* method = methods.data(); method->ml_name != nullptr; ++method) {
    const nb::object bound =
        checked(PyDescr_NewMethod(reinterpret_cast<PyTypeObject*>(buffer_type.ptr()), method));
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
  cls.def("__init__", &initialize,
          nb::sig("def __init__(self, cache_time_ns=10000000000, max_frames=None)"))
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
      .def(
          "_follow_tf2",
          [](BufferObject& self, int year) {
            const SharedBuffer::Access access(self.shared);
            access->use(year < 2025   ? Rules::of_jazzy()
                        : year < 2026 ? Rules::of_kilted()
                                      : Rules::of_lyrical());
          },
          "year"_a, "Answers as tf2 of a year's release from now on; call it before data comes in.")
      .def("_latest_common_time", &latest_common_time, "target_frame"_a, "source_frame"_a)
      .def(
          "_knows",
          [](BufferObject& self, std::string_view frame) {
            const SharedBuffer::Access access(self.shared);
            const auto known = access->frames().find(frame);
            return known.has_value() && access->is_known(*known);
          },
          "frame"_a)
      .def(
          "_frames_as_string",
          [](BufferObject& self) {
            return locked(self, [](const Tree& b) { return b.frames_as_string(); });
          },
          "tf2's list of frames and parents, one line each.")
      .def(
          "_repr_svg_",
          [](nb::handle self) {
            return checked(call_python("turtlewire.tf.notebook", "buffer_svg", "(O)", self.ptr()));
          },
          "The tree of frames as SVG, for notebooks.")
      .def("_remove_change_listener", &remove_change_listener, "call"_a)
      .def(
          "_wake", [](BufferObject& self) { self.wake(); },
          "Makes every waiting lookup look at pending signals now, and go on waiting if there is "
          "none.\n\n"
          "For signal handling that does not interrupt the main thread's system call, such as "
          "rclpy's.");
  module.def("bind_methods", &bind_methods, "buffer_type"_a,
             "Gives a class that derives from Buffer its own descriptors of the methods, which "
             "CPython calls faster than inherited ones.");
  add_history_methods(cls);
  add_inspection_methods(cls);
}

}  // namespace turtlewire::python
