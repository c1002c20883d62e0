#include "intake.hpp"

#include <nanobind/stl/string_view.h>

#include <cstdint>
#include <deque>
#include <span>
#include <utility>
#include <vector>

#include "../core/intake.hpp"
#include "../core/sink.hpp"
#include "buffer.hpp"
#include "gil.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

class IntakeObject final : public Sink {
 public:
  IntakeObject(bool is_static, std::size_t most_kept, nb::callable on_expected)
      : core(is_static, most_kept), on_expected_(std::move(on_expected)) {}

  Intake core;

  bool receive(std::uint64_t publisher, std::int64_t sent,
               std::span<const unsigned char> bytes) override {
    return core.receive(publisher, sent, bytes);
  }

  void feed(nb::tuple buffers) {
    std::vector<SharedBuffer*> fed;
    for (const nb::handle buffer : buffers) fed.push_back(&nb::cast<BufferObject&>(buffer).shared);
    core.feed(std::move(fed));
    std::swap(buffers_,
              buffers);  // the former ones die, if they do, when nothing of them is in use any more
  }

  void serve() {
    if (core.take_expected()) call_on_expected();
    if (!core.take_news()) return;
    const nb::tuple fed = buffers_;
    for (const nb::handle buffer : fed) nb::cast<BufferObject&>(buffer).call_listeners();
  }

  nb::handle buffers() const { return buffers_; }
  nb::handle on_expected() const { return on_expected_; }
  void forget_callback() { on_expected_ = nb::none(); }

 private:
  void call_on_expected() {
    const nb::object callback = on_expected_;
    PyObject* result = taking_gil([&callback] { return PyObject_CallNoArgs(callback.ptr()); });
    if (result == nullptr) throw nb::python_error();
    Py_DECREF(result);
  }

  nb::tuple buffers_;  // keeps those alive that the core fills
  nb::object on_expected_;
};

nb::list take(IntakeObject& self) {
  std::deque<Intake::Kept> taken;
  {
    const Unlocked unlocked;
    taken = self.core.take();
  }
  nb::list list;
  for (const Intake::Kept& kept : taken) {
    list.append(
        nb::make_tuple(nb::bytes(kept.bytes.data(), kept.bytes.size()), kept.publisher, kept.sent));
  }
  return list;
}

std::string_view view_of(const nb::bytes& bytes) { return {bytes.c_str(), bytes.size()}; }

int traverse(PyObject* self, visitproc visit, void* arg) {
  Py_VISIT(Py_TYPE(self));
  if (!nb::inst_ready(self)) return 0;
  const auto* intake = nb::inst_ptr<IntakeObject>(self);
  Py_VISIT(intake->buffers().ptr());
  Py_VISIT(intake->on_expected().ptr());
  return 0;
}

int clear_references(PyObject* self) {
  if (!nb::inst_ready(self)) return 0;
  auto* intake = nb::inst_ptr<IntakeObject>(self);
  intake->feed(nb::tuple());
  intake->forget_callback();
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
      "It keeps back what needs Python, and whatever comes behind that: messages of publishers "
      "whose name it was not\n"
      "told, and malformed ones. Safe for use from many threads.\n\n"
      "Args:\n"
      "    static: Whether the transforms hold for all times.\n"
      "    most_kept: So many messages at most are kept back, the newest; 0: any number.\n"
      "    on_expected: Called by serve after an expected message.")
      .def(nb::init<bool, std::size_t, nb::callable>(), "static"_a, "most_kept"_a, "on_expected"_a)
      .def("feed", &IntakeObject::feed, "buffers"_a,
           "Which buffers to fill from now on; without any, all messages are kept back.")
      .def(
          "introduce",
          [](IntakeObject& self, std::uint64_t publisher, const nb::bytes& gid) {
            self.core.introduce(publisher, view_of(gid));
          },
          "publisher"_a, "gid"_a, "Which publisher the middleware means by a number.")
      .def(
          "name",
          [](IntakeObject& self, const nb::bytes& gid, std::string_view name) {
            self.core.name(view_of(gid), name);
          },
          "gid"_a, "name"_a, "The authority of what an introduced publisher sends.")
      .def("take", &take,
           "The next messages kept back that need Python, as (bytes, number of the publisher, time "
           "of sending in ns). "
           "To be\n"
           "called until there are none: only then new ones take the short way again.")
      .def(
          "stored", [](IntakeObject& self) { return self.core.stored(); },
          "The number of messages stored so far.")
      .def(
          "expect", [](IntakeObject& self) { self.core.expect(); },
          "Have on_expected called after the next message that is stored.")
      .def("serve", &IntakeObject::serve,
           "Calls the change listeners of the buffers, if data came for any of them since the last "
           "time,\nand on_expected after an expected message.");
}

}  // namespace turtlewire::python
