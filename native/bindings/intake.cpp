#include "intake.hpp"

#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/string_view.h>

#include <algorithm>
#include <cstdint>
#include <deque>
#include <utility>
#include <vector>

#include "../core/intake.hpp"
#include "buffer.hpp"
#include "cyclone.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

class IntakeObject {
 public:
  IntakeObject(bool is_static, std::size_t most_kept, nb::callable on_expected)
      : core(is_static, most_kept), on_expected_(std::move(on_expected)) {}

  Intake core;

  void connect(const Addresses& functions, Entity guard) {
    cyclone_ = Cyclone(functions);
    guard_ = guard;
  }

  void feed(nb::tuple buffers) {
    std::vector<SharedBuffer*> fed;
    for (const nb::handle buffer : buffers) fed.push_back(&nb::cast<BufferObject&>(buffer).shared);
    core.feed(std::move(fed));
    std::swap(buffers_,
              buffers);  // the former ones die, if they do, when nothing of them is in use any more
  }

  void call_listeners() {
    if (core.take_expected()) on_expected_();
    if (!core.take_news()) return;
    const nb::tuple fed = buffers_;
    for (const nb::handle buffer : fed) nb::cast<BufferObject&>(buffer).call_listeners();
  }

  nb::handle buffers() const { return buffers_; }
  nb::handle on_expected() const { return on_expected_; }
  void forget_callback() { on_expected_ = nb::none(); }

  // The dds_on_data_available_fn, on the thread of Cyclone that received something, or on the one
  // of a publisher in this process. It must not want the GIL: who holds that may be waiting for a
  // lock of Cyclone's that is held here.
  static void on_data(Entity reader, void* intake) noexcept {
    static_cast<IntakeObject*>(intake)->take_all(reader);
  }

 private:
  void take_all(Entity reader) noexcept {
    bool wanted = false;
    for (bool more = true; more;) {
      const Samples samples(cyclone_, reader, Samples::kMost);
      more = samples.size() == Samples::kMost;
      for (std::size_t i = 0; i < samples.size(); ++i) {
        if (samples.info(i).valid_data) wanted |= receive(samples, i);
      }
    }
    if (wanted) cyclone_.trigger(guard_, true);
  }

  bool receive(const Samples& samples, std::size_t i) noexcept try {
    bytes_.resize(samples.bytes(i));
    samples.copy(i, bytes_.size(), bytes_.data());
    return core.receive(samples.info(i).publication_handle, samples.info(i).source_timestamp,
                        bytes_);
  } catch (const std::bad_alloc&) {
    return false;  // the message is lost
  }

  Cyclone cyclone_;
  Entity guard_ = 0;
  std::vector<unsigned char> bytes_;  // Cyclone calls a listener on one thread at a time
  nb::tuple buffers_;                 // keeps those alive that the core fills
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

// Messages of a reader, as take() above returns them.
nb::list take_messages(const Cyclone& cyclone, Entity reader, std::int64_t most) {
  nb::list list;
  for (bool more = true; more && most > 0;) {
    const std::uint32_t wanted =
        static_cast<std::uint32_t>(std::min<std::int64_t>(most, Samples::kMost));
    const Samples samples(cyclone, reader, wanted);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      const SampleInfo& info = samples.info(i);
      if (!info.valid_data) continue;
      const std::size_t size = samples.bytes(i);
      const auto bytes =
          nb::steal(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
      if (!bytes.is_valid()) throw nb::python_error();
      samples.copy(i, size, PyBytes_AS_STRING(bytes.ptr()));
      list.append(nb::make_tuple(bytes, info.publication_handle, info.source_timestamp));
    }
    more = samples.size() == wanted;
    most -= wanted;
  }
  return list;
}

}  // namespace

void add_intake_type(nb::module_& module) {
  nb::class_<IntakeObject>(
      module, "Intake", nb::type_slots(slots),
      "Stores TFMessages that a DDS reader receives, on the thread that receives them and without "
      "Python.\n\n"
      "It keeps back what needs Python, and whatever comes behind that: messages of publishers "
      "whose name it was not\n"
      "told, and malformed ones. Safe for use from many threads.\n\n"
      "Args:\n"
      "    static: Whether the transforms hold for all times.\n"
      "    most_kept: So many messages at most are kept back, the newest; 0: any number.\n"
      "    on_expected: Called by call_listeners after an expected message.")
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
      .def("call_listeners", &IntakeObject::call_listeners,
           "Calls the change listeners of the buffers, if data came for any of them since the last "
           "time,\nand on_expected after an expected message.")
      .def(
          "connect",
          [](nb::handle_t<IntakeObject> self, const Addresses& functions, Entity guard) {
            auto* intake = nb::inst_ptr<IntakeObject>(self);
            intake->connect(functions, guard);
            return std::pair(reinterpret_cast<std::uintptr_t>(&IntakeObject::on_data),
                             reinterpret_cast<std::uintptr_t>(intake));
          },
          "functions"_a, "guard"_a,
          "Gets ready for a reader of Cyclone DDS.\n\n"
          "Args:\n"
          "    functions: Addresses of dds_takecdr, ddsi_serdata_size, ddsi_serdata_to_ser, "
          "ddsi_serdata_unref and\n"
          "        dds_set_guardcondition.\n"
          "    guard: The guard condition to be triggered when there is something to take or "
          "listeners to call.\n\n"
          "Returns:\n"
          "    What is called when data is available, and its argument; this object must outlive "
          "the reader.");
  nb::class_<Cyclone>(module, "Taker",
                      "Takes messages of readers of Cyclone DDS, with the GIL held.\n\n"
                      "Args:\n"
                      "    functions: As for Intake.connect.")
      .def(nb::init<const Addresses&>(), "functions"_a)
      .def("take", &take_messages, "reader"_a, "limit"_a,
           "At most `limit` messages, as Intake.take returns them; none when the reader has gone.");
}

}  // namespace turtlewire::python
