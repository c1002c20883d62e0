#include <cstring>

#include "buffer.hpp"
#include "lookup_arguments.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

// An attribute, or null without an error if there is none.
PyObject* optional_attribute(PyObject* object, PyObject* name) {
  return taking_gil([=] {
    PyObject* value = nullptr;
#if defined(Py_LIMITED_API)
    value = PyObject_GetAttr(object, name);
    if (value == nullptr && PyErr_ExceptionMatches(PyExc_AttributeError) != 0) PyErr_Clear();
#elif PY_VERSION_HEX >= 0x030D0000
    PyObject_GetOptionalAttr(object, name, &value);
#else
    _PyObject_LookupAttr(object, name, &value);
#endif
    return value;
  });
}

bool take_integer(PyObject* value, Stamp& integer) {
  if (value == nullptr) return false;
  integer = to_int64(value);
  Py_DECREF(value);
  return integer != -1 || PyErr_Occurred() == nullptr;
}

// False with an OverflowError if the time does not fit into 64 bits.
bool join_seconds(Stamp sec, Stamp nanosec, Stamp& t, const char* what) {
  constexpr Stamp second = 1'000'000'000;
  constexpr Stamp limit = kForever / second;
  const bool fits =
      sec <= limit && sec >= -limit &&
      (nanosec > 0 ? sec * second <= kForever - nanosec : sec * second >= -kForever - 1 - nanosec);
  if (fits) {
    t = sec * second + nanosec;
  } else {
    PyErr_Format(PyExc_OverflowError, "%s does not fit into 64 bits of nanoseconds", what);
  }
  return fits;
}

// tf2_py's converters: a message with sec and nanosec, else an rclpy Time or Duration with
// nanoseconds.
bool time_of(PyObject* object, Stamp& t, const char* what) {
  static constinit const Interned sec_name, nanosec_name, nanoseconds_name;
  Stamp seconds = 0, nanoseconds = 0;
  PyObject* sec = optional_attribute(object, sec_name.get("sec"));
  PyObject* nanosec =
      sec != nullptr ? optional_attribute(object, nanosec_name.get("nanosec")) : nullptr;
  if (nanosec != nullptr) {
    const bool has_seconds = take_integer(sec, seconds);
    const bool has_nanoseconds = take_integer(nanosec, nanoseconds);  // releases it in any case
    return has_seconds && has_nanoseconds && join_seconds(seconds, nanoseconds, t, what);
  }
  Py_XDECREF(sec);
  if (PyErr_Occurred() != nullptr) return false;
  PyObject* total = optional_attribute(object, nanoseconds_name.get("nanoseconds"));
  if (total == nullptr) {
    return PyErr_Occurred() == nullptr && raise_no_ros_time(object, what);
  }
  if (!take_integer(total, nanoseconds)) return false;
  t = nanoseconds;
  return true;
}

// Where the fields of one message class lie: each is a slot, and no __init__ is needed to fill it.
template <std::size_t N>
class Layout {
 public:
  Layout(nb::handle cls, const std::array<const char*, N>& fields)
      : type_(reinterpret_cast<PyTypeObject*>(cls.ptr())) {
    for (std::size_t i = 0; i < N; ++i) {
      offsets_[i] = offset_of(cls, cls.attr(fields[i]));
      if (offsets_[i] == 0) {
        throw nb::type_error(
            (std::string(nb::str(cls).c_str()) + ": the field '" + fields[i] + "' is not a slot")
                .c_str());
      }
    }
    Py_INCREF(cls.ptr());
  }
  Layout(const Layout&) = delete;
  Layout& operator=(const Layout&) = delete;
  ~Layout() { Py_DECREF(reinterpret_cast<PyObject*>(type_)); }

  // A new instance that owns the given values; null, and the values gone, if one of them is null.
  PyObject* make(const std::array<PyObject*, N>& values) const {
    PyObject* object = PyType_GenericAlloc(type_, 0);
    bool complete = object != nullptr;
    for (std::size_t i = 0; i < N; ++i) {
      complete = complete && values[i] != nullptr;
      if (object != nullptr) {
        std::memcpy(reinterpret_cast<char*>(object) + offsets_[i], &values[i], sizeof(PyObject*));
      } else {
        Py_XDECREF(values[i]);
      }
    }
    if (complete) return object;
    Py_XDECREF(object);
    return nullptr;
  }

 private:
  // Where an instance holds the value of a slot, found by setting one; 0 for what is no slot. The
  // stable ABI has no other way to tell.
  static std::size_t offset_of(nb::handle cls, nb::handle slot) {
    if (Py_TYPE(slot.ptr()) != &PyMemberDescr_Type) return 0;
    auto* type = reinterpret_cast<PyTypeObject*>(cls.ptr());
    const auto instance = nb::steal(PyType_GenericAlloc(type, 0));
    const nb::object value = nb::list();  // a new one, which nothing else refers to
    slot.attr("__set__")(instance, value);
    const auto size = nb::cast<std::size_t>(cls.attr("__basicsize__"));
    for (std::size_t at = sizeof(PyObject); at + sizeof(PyObject*) <= size;
         at += sizeof(PyObject*)) {
      PyObject* held = nullptr;
      std::memcpy(&held, reinterpret_cast<const char*>(instance.ptr()) + at, sizeof held);
      if (held == value.ptr()) return at;
    }
    return 0;
  }

  PyTypeObject* type_;
  std::array<std::size_t, N> offsets_{};
};

// The six classes that make up a TransformStamped, as a default instance shows them.
class StampedMaker {
 public:
  explicit StampedMaker(const nb::object& example)
      : stamped_(example.type(), {"header", "child_frame_id", "transform"}),
        header_(example.attr("header").type(), {"stamp", "frame_id"}),
        time_(example.attr("header").attr("stamp").type(), {"sec", "nanosec"}),
        transform_(example.attr("transform").type(), {"translation", "rotation"}),
        vector_(example.attr("transform").attr("translation").type(), {"x", "y", "z"}),
        quaternion_(example.attr("transform").attr("rotation").type(), {"x", "y", "z", "w"}) {}

  PyObject* make(PyObject* target, PyObject* source, const Found& found) const {
    constexpr Stamp second = 1'000'000'000;
    const Stamp stamp_ns = found.stamp != kLatest ? found.stamp : 0;
    Stamp sec = stamp_ns / second, nanosec = stamp_ns % second;
    if (nanosec < 0) {
      nanosec += second;
      --sec;
    }
    const auto& [t, q] = found.target_from_source;
    PyObject* stamp = time_.make({PyLong_FromLongLong(sec), PyLong_FromLongLong(nanosec)});
    PyObject* header = header_.make({stamp, plain_string(target)});
    PyObject* translation =
        vector_.make({PyFloat_FromDouble(t.x), PyFloat_FromDouble(t.y), PyFloat_FromDouble(t.z)});
    PyObject* rotation = quaternion_.make({PyFloat_FromDouble(q.x), PyFloat_FromDouble(q.y),
                                           PyFloat_FromDouble(q.z), PyFloat_FromDouble(q.w)});
    return stamped_.make({header, plain_string(source), transform_.make({translation, rotation})});
  }

 private:
  static PyObject* plain_string(PyObject* text) {
    return PyUnicode_CheckExact(text) ? Py_NewRef(text) : PyUnicode_FromObject(text);
  }

  Layout<3> stamped_;
  Layout<2> header_, time_, transform_;
  Layout<3> vector_;
  Layout<4> quaternion_;
};

class MessageLookup {
 public:
  MessageLookup(nb::object buffer, const nb::object& example)
      : maker(example), owner_(std::move(buffer)) {
    if (!nb::isinstance<BufferObject>(owner_))
      throw nb::type_error("the first argument must be a native Buffer");
    this->buffer = buffer_of(owner_.ptr());
    if (this->buffer == nullptr) throw nb::python_error();
  }

  nb::handle owner() const { return owner_; }

  StampedMaker maker;
  BufferObject* buffer;

 private:
  nb::object owner_;
};

MessageLookup* self_of(PyObject* self) {
  if (!nb::inst_ready(self)) [[unlikely]] {
    PyErr_SetString(PyExc_RuntimeError, "MessageLookup.__init__() was not called");
    return nullptr;
  }
  return nb::inst_ptr<MessageLookup>(self);
}

// A time of ROS; 0 means the latest.
bool moment_of_message(PyObject* object, Stamp& t) {
  if (!time_of(object, t, "time")) return false;
  if (t == 0) t = kLatest;
  return true;
}

bool timeout_of(PyObject* object, Stamp& span) {
  return object == nullptr || time_of(object, span, "duration");
}

struct AtOneTime {
  static constexpr std::size_t kCount = 4;

  PyObject *target = nullptr, *source = nullptr;
  Stamp t = kLatest, timeout = 0;

  static constexpr Parameters<kCount> parameters(const char* method) {
    return {method, 3, 4, {"target_frame", "source_frame", "time", "timeout"}};
  }
  bool take(const Values<kCount>& v) {
    target = v[0];
    source = v[1];
    return moment_of_message(v[2], t) && timeout_of(v[3], timeout);
  }
  bool lookup(BufferObject& buffer, Found& found) const {
    return buffer.lookup(target, source, t, timeout, found);
  }
};

// Through a fixed frame, which did not move between the two times.
struct AtTwoTimes {
  static constexpr std::size_t kCount = 6;

  PyObject *target = nullptr, *source = nullptr, *fixed = nullptr;
  Stamp target_time = kLatest, source_time = kLatest, timeout = 0;

  static constexpr Parameters<kCount> parameters(const char* method) {
    return {
        method,
        5,
        6,
        {"target_frame", "target_time", "source_frame", "source_time", "fixed_frame", "timeout"}};
  }
  bool take(const Values<kCount>& v) {
    target = v[0];
    source = v[2];
    fixed = v[4];
    return moment_of_message(v[1], target_time) && moment_of_message(v[3], source_time) &&
           timeout_of(v[5], timeout);
  }
  bool lookup(BufferObject& buffer, Found& found) const {
    FullRequest request{.target_time = target_time, .source_time = source_time};
    return text_of(target, request.target, "target_frame") &&
           text_of(source, request.source, "source_frame") &&
           text_of(fixed, request.fixed, "fixed_frame") &&
           buffer.ask(request, timeout, &found, nullptr);
  }
};

template <typename Arguments>
PyObject* look_up(const MessageLookup& self, const Arguments& arguments) {
  Found found;
  return arguments.lookup(*self.buffer, found)
             ? self.maker.make(arguments.target, arguments.source, found)
             : nullptr;
}

constexpr char kLookup[] = "lookup";
constexpr char kLookupFull[] = "lookup_full";

template <const char* Method, typename Arguments>
PyMethodDef lookup(const char* doc) {
  return fast_method<with_arguments<Method, Arguments, self_of, look_up<Arguments>>>(Method, doc);
}

PyMethodDef methods[] = {
    lookup<kLookup, AtOneTime>(
        "lookup($self, target_frame, source_frame, time, timeout=None)\n--\n\n"
        "Buffer.lookup_transform with ROS times, returning a TransformStamped."),
    lookup<kLookupFull, AtTwoTimes>(
        "lookup_full($self, target_frame, target_time, source_frame, source_time, fixed_frame, "
        "timeout=None)\n"
        "--\n\nBuffer.lookup_transform through a fixed frame, with ROS times, returning a "
        "TransformStamped."),
    {nullptr, nullptr, 0, nullptr},
};

// Shows the garbage collector cycles through the buffer, which breaks them: it forgets its
// listeners.
int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (nb::inst_ready(self)) Py_VISIT(nb::inst_ptr<MessageLookup>(self)->owner().ptr());
  return 0;
}

PyType_Slot slots[] = {
    {Py_tp_methods, methods},
    {Py_tp_traverse, reinterpret_cast<void*>(traverse)},
    {0, nullptr},
};

}  // namespace

void add_message_lookup_type(nb::module_& module) {
  nb::class_<MessageLookup>(
      module, "MessageLookup", nb::type_slots(slots),
      "Lookups in a Buffer that return TransformStamped messages.\n\n"
      "Args:\n"
      "    buffer: The native Buffer.\n"
      "    example: A TransformStamped with default fields; its classes must keep their fields in\n"
      "        plain slots, which are filled here without running any __init__.")
      .def(nb::init<nb::object, nb::object>(), "buffer"_a, "example"_a);
}

}  // namespace turtlewire::python
