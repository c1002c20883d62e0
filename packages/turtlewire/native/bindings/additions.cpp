#include "../feeds/tf_message.hpp"
#include "buffer_methods.hpp"
#include "bytes.hpp"
#include "errors.hpp"

namespace turtlewire::python {
namespace {

// One transform as Python gives it.
struct Given {
  std::string_view parent{}, child{}, sender = kUnknownSender;
  Stamp stamp = 0;
  Pose pose{};
  bool is_static = false;

  bool take_frames(PyObject* parent_object, PyObject* child_object, PyObject* sender_object) {
    return text_of(parent_object, parent, "parent_frame") &&
           text_of(child_object, child, "child_frame") &&
           (sender_object == nullptr || text_of(sender_object, sender, "sender"));
  }
  bool take_pose(PyObject* translation, PyObject* rotation) {
    double t[3], q[4] = {0, 0, 0, 1};
    if (!numbers_of(translation, t, 3, "translation") ||
        (rotation != nullptr && !numbers_of(rotation, q, 4, "rotation"))) {
      return false;
    }
    pose = {{t[0], t[1], t[2]}, {q[0], q[1], q[2], q[3]}};
    return true;
  }
  Refusal add_to(BufferObject& buffer) const {
    return {buffer.set(parent, child, stamp, pose, sender, is_static),
            parent,
            child,
            sender,
            stamp,
            pose};
  }
};

PyObject* none_or_error(const Refusal& refusal) {
  if (refusal.verdict == Verdict::accepted) Py_RETURN_NONE;
  return raise(refusal);
}

PyObject* set_transform(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                        PyObject* keywords) {
  static constinit const Signature<6> signature(
      {"set_transform",
       4,
       5,
       {"parent_frame", "child_frame", "stamp_ns", "translation", "rotation", "sender"}});
  Values<6> v;
  Given given;
  BufferObject* buffer = buffer_of(self);
  if (buffer == nullptr || !signature.read(arguments, count, keywords, v) ||
      !given.take_frames(v[0], v[1], v[5]) || !nanoseconds_of(v[2], given.stamp, "stamp_ns") ||
      !given.take_pose(v[3], v[4])) {
    return nullptr;
  }
  return none_or_error(given.add_to(*buffer));
}

PyObject* set_static_transform(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                               PyObject* keywords) {
  static constinit const Signature<5> signature(
      {"set_static_transform",
       3,
       4,
       {"parent_frame", "child_frame", "translation", "rotation", "sender"}});
  Values<5> v;
  Given given{.is_static = true};
  BufferObject* buffer = buffer_of(self);
  if (buffer == nullptr || !signature.read(arguments, count, keywords, v) ||
      !given.take_frames(v[0], v[1], v[4]) || !given.take_pose(v[2], v[3])) {
    return nullptr;
  }
  return none_or_error(given.add_to(*buffer));
}

// For the packages with ROS names, whose buffers log a refusal.
PyObject* set_or_explain(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                         PyObject* keywords) {
  static constinit const Signature<7> signature(
      {"_set_transform",
       7,
       7,
       {"parent_frame", "child_frame", "stamp_ns", "translation", "rotation", "static", "sender"}});
  Values<7> v;
  Given given;
  BufferObject* buffer = buffer_of(self);
  if (buffer == nullptr || !signature.read(arguments, count, keywords, v) ||
      !given.take_frames(v[0], v[1], v[6]) || !nanoseconds_of(v[2], given.stamp, "stamp_ns") ||
      !given.take_pose(v[3], v[4])) {
    return nullptr;
  }
  given.is_static = is_true(v[5]);
  return to_python(explain(given.add_to(*buffer)));
}

PyObject* add_tf_message(PyObject* self, PyObject* const* arguments, Py_ssize_t count,
                         PyObject* keywords) {
  static constinit const Signature<3> signature(
      {"add_tf_message", 1, 1, {"cdr", "static", "sender"}});
  thread_local TfMessage message;
  Values<3> v;
  std::string_view sender = kUnknownSender;
  BufferObject* buffer = buffer_of(self);
  Bytes bytes;
  if (buffer == nullptr || !signature.read(arguments, count, keywords, v) || !bytes.read(v[0]) ||
      (v[2] != nullptr && !text_of(v[2], sender, "sender"))) {
    return nullptr;
  }
  const bool is_static = is_true(v[1]);
  const std::string fault = message.decode(bytes.data(), bytes.size());
  if (!fault.empty()) {
    buffer->refuse_message(fault, sender);
    return raise_cdr_error(fault);
  }
  const long accepted = buffer->shared.add(message.transforms(), sender, is_static).accepted;
  if (accepted > 0) buffer->call_listeners();
  return PyLong_FromLong(accepted);
}

}  // namespace

std::array<PyMethodDef, 4> addition_methods() {
  return {{
      fast_method<set_transform>(
          "set_transform",
          "set_transform($self, parent_frame, child_frame, stamp_ns, translation, "
          "rotation=(0, 0, 0, 1), *, sender='default_authority')\n--\n\n"
          "Adds one sample: the pose of child_frame in parent_frame at a time.\n\n"
          "Args:\n"
          "    parent_frame: header.frame_id of a TransformStamped.\n"
          "    child_frame: Its child_frame_id.\n"
          "    stamp_ns: Its time: an int of nanoseconds, or a datetime64.\n"
          "    translation: (x, y, z) in metres.\n"
          "    rotation: Quaternion (x, y, z, w); it is normalised.\n"
          "    sender: The name that `links` shows.\n\n"
          "Raises:\n"
          "    InvalidTransformError: The sample is not added; the text is tf2's reason."),
      fast_method<set_static_transform>(
          "set_static_transform",
          "set_static_transform($self, parent_frame, child_frame, translation, "
          "rotation=(0, 0, 0, 1), *, sender='default_authority')\n--\n\n"
          "Adds a pose of child_frame in parent_frame that holds at all times.\n\n"
          "Takes and raises the same as set_transform."),
      fast_method<set_or_explain>(
          "_set_transform",
          "_set_transform($self, parent_frame, child_frame, stamp_ns, translation, rotation, "
          "static, sender)\n--\n\n"
          "Adds a transform; returns tf2's reason if it is refused, else an empty string."),
      fast_method<add_tf_message>(
          "add_tf_message",
          "add_tf_message($self, cdr, *, static=False, sender='default_authority')\n--\n\n"
          "Adds the transforms of one tf2_msgs/msg/TFMessage, given as CDR bytes with their 4-byte "
          "header.\n\n"
          "Returns:\n"
          "    How many were accepted.\n\n"
          "Raises:\n"
          "    CdrError: The bytes are malformed; nothing of them was added."),
  }};
}

}  // namespace turtlewire::python
