#define PY_SSIZE_T_CLEAN
#include "../feeds/intake.hpp"

#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "../feeds/middleware.hpp"
#include "buffer.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

// Reads a tuple (gid, name); false with a Python error set if the object is not one.
bool read_identity(PyObject* identity, std::string& gid, std::string& name) {
  const char *gid_bytes = nullptr, *name_bytes = nullptr;
  Py_ssize_t gid_size = 0, name_size = 0;
  if (!PyArg_ParseTuple(identity, "y#s#", &gid_bytes, &gid_size, &name_bytes, &name_size))
    return false;
  gid.assign(gid_bytes, static_cast<std::size_t>(gid_size));
  name.assign(name_bytes, static_cast<std::size_t>(name_size));
  return true;
}

class IntakeObject final : public Sink {
 public:
  IntakeObject(bool is_static, std::size_t most_kept, nb::callable identify,
               nb::callable on_expected)
      : core(is_static, most_kept),
        identify_(std::move(identify)),
        on_expected_(std::move(on_expected)) {}

  Intake core;

  bool receive(std::uint64_t publisher, std::int64_t sent,
               std::span<const unsigned char> bytes) override {
    return core.receive(publisher, sent, bytes);
  }

  void feed(nb::tuple buffers) {
    std::vector<SharedBuffer*> fed;
    for (const nb::handle buffer : buffers) fed.push_back(&nb::cast<BufferObject&>(buffer).shared);
    const nb::ft_lock_guard guard(buffers_mutex_);
    core.feed(std::move(fed));
    std::swap(buffers_,
              buffers);  // the previous ones are destroyed when nothing uses them any more
  }

  nb::list serve(const nb::callable& gid_of) {
    std::deque<WaitingMessage> left = take({});
    std::vector<std::uint64_t> asked;
    const auto is_new = [&](const WaitingMessage& kept) {
      return core.needs_name(kept.publisher) &&
             std::find(asked.begin(), asked.end(), kept.publisher) == asked.end();
    };
    for (auto next = std::find_if(left.begin(), left.end(), is_new); next != left.end();
         next = std::find_if(left.begin(), left.end(), is_new)) {
      asked.push_back(next->publisher);
      if (introduce(next->publisher, gid_of)) left = take(std::move(left));
    }
    tell();
    nb::list list;
    for (const WaitingMessage& kept : left) {
      list.append(nb::make_tuple(nb::bytes(kept.bytes.data(), kept.bytes.size()), kept.publisher,
                                 kept.sent));
    }
    return list;
  }

  // Shows the garbage collector what Python may have put into a cycle, which is broken by
  // forgetting it.
  int traverse(visitproc visit, void* arg) const {
    Py_VISIT(buffers_.ptr());
    Py_VISIT(identify_.ptr());
    Py_VISIT(on_expected_.ptr());
    return 0;
  }
  void forget() {
    feed(nb::tuple());
    identify_ = nb::none();
    on_expected_ = nb::none();
  }

 private:
  std::deque<WaitingMessage> take(std::deque<WaitingMessage> former) {
    const Unlocked unlocked;
    return core.take(std::move(former));
  }

  // Asks Python who a publisher is; false if it does not know, or failed.
  bool introduce(std::uint64_t publisher, const nb::callable& gid_of) {
    const nb::object identify = identify_;
    std::string gid, name;
    PyObject* identity = taking_gil([&identify, &gid_of, publisher] {
      return PyObject_CallFunction(identify.ptr(), "KO", static_cast<unsigned long long>(publisher),
                                   gid_of.ptr());
    });
    if (identity == nullptr || !read_identity(identity, gid, name))
      PyErr_WriteUnraisable(identify.ptr());
    Py_XDECREF(identity);
    if (gid.empty()) return false;
    core.introduce(publisher, gid, name);
    return true;
  }

  // The functions to call after messages were stored without Python.
  void tell() {
    if (core.take_expected()) {
      const nb::object callback = on_expected_;
      taking_gil([&callback] {
        PyObject* result = PyObject_CallNoArgs(callback.ptr());
        if (result == nullptr) PyErr_WriteUnraisable(callback.ptr());
        Py_XDECREF(result);
      });
    }
    if (!core.take_news()) return;
    for (const nb::handle buffer : fed()) nb::cast<BufferObject&>(buffer).call_listeners();
  }

  nb::tuple fed() {
    const nb::ft_lock_guard guard(buffers_mutex_);
    return buffers_;
  }

  nb::ft_mutex buffers_mutex_;  // does nothing with a GIL
  nb::tuple buffers_;           // keeps those alive that the core fills
  nb::object identify_, on_expected_;
};

std::string_view view_of(const nb::bytes& bytes) { return {bytes.c_str(), bytes.size()}; }

int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  return nb::inst_ready(self) ? nb::inst_ptr<IntakeObject>(self)->traverse(visit, arg) : 0;
}

int clear_references(PyObject* self) {
  if (nb::inst_ready(self)) nb::inst_ptr<IntakeObject>(self)->forget();
  return 0;
}

PyType_Slot slots[] = {
    {Py_tp_traverse, reinterpret_cast<void*>(traverse)},
    {Py_tp_clear, reinterpret_cast<void*>(clear_references)},
    {0, nullptr},
};

}  // namespace

void add_intake_type(nb::module_& module) {
  nb::class_<Sink>(
      module, "Sink",
      "Native code that takes messages from a middleware; see turtlewire.wire.base.Sink.");
  nb::class_<IntakeObject, Sink>(
      module, "Intake", nb::type_slots(slots),
      "A Sink that stores the TFMessages of a subscription, on the thread that receives them and "
      "without "
      "Python.\n\n"
      "It keeps back what needs Python, and what comes behind that: messages of publishers that "
      "serve has not asked\nfor yet, and malformed ones. Safe for use from many threads.\n\n"
      "Args:\n"
      "    static: Whether the transforms hold for all times.\n"
      "    most_kept: So many messages at most are kept back, the newest; 0: any number.\n"
      "    identify: `identify(publisher, gid_of)` returns gid and name of a publisher, given the "
      "middleware's number\n"
      "        and what serve was given; an empty gid if it does not know them.\n"
      "    on_expected: Called by serve after an expected message.")
      .def(nb::init<bool, std::size_t, nb::callable, nb::callable>(), "static"_a, "most_kept"_a,
           "identify"_a, "on_expected"_a)
      .def("feed", &IntakeObject::feed, "buffers"_a,
           "Which buffers to fill from now on; without any, all messages are kept back.")
      .def(
          "name",
          [](IntakeObject& self, const nb::bytes& gid, std::string_view name) {
            self.core.name(view_of(gid), name);
          },
          "gid"_a, "name"_a,
          "The authority of what a publisher sends from now on, be it identified or not yet.")
      .def(
          "stored", [](IntakeObject& self) { return self.core.stored(); },
          "The number of messages stored so far.")
      .def(
          "expect", [](IntakeObject& self) { self.core.expect(); },
          "Have on_expected called after the next message that is stored.")
      .def(
          "expect_waking",
          [](IntakeObject& self, std::uintptr_t trigger, std::int32_t guard) {
            return self.core.expect(
                Waker{reinterpret_cast<decltype(Waker::trigger)>(trigger), guard});
          },
          "trigger"_a, "guard"_a,
          "Have the next message that is stored trigger a guard condition, once: `trigger` is the "
          "address of\ndds_set_guardcondition. Python takes no part in it. Returns the number of "
          "messages stored so far.")
      .def("serve", &IntakeObject::serve, "gid_of"_a,
           "See turtlewire.wire.base.Sink. Identifies publishers, stores their messages, calls the "
           "change listeners of\nthe buffers if data came since the last time, and on_expected "
           "after an expected message.");
}

}  // namespace turtlewire::python
