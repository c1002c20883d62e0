#include <nanobind/stl/array.h>
#include <nanobind/stl/pair.h>
#include <nanobind/stl/vector.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstring>
#include <stdexcept>

#include "../cyclone/abort.hpp"
#include "../cyclone/first_requests.hpp"
#include "../cyclone/inlet.hpp"
#include "../cyclone/library.hpp"
#include "../cyclone/service_types.hpp"
#include "../cyclone/writer.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;
using cyclone::Entity;
using cyclone::FirstRequests;
using cyclone::Inlet;
using cyclone::Library;
using cyclone::Samples;
using cyclone::Writer;

void make_library(Library* self, const cyclone::Addresses& functions,
                  const cyclone::InfoLayout& info) {
  if (info[0] > Samples::kLargestInfo)
    throw std::invalid_argument("dds_sample_info_t is too large");
  new (self) Library(functions, info);
}

nb::list take(const Library& library, Entity reader, std::int64_t most) {
  nb::list list;
  for (bool more = true; more && most > 0;) {
    const std::uint32_t wanted =
        static_cast<std::uint32_t>(std::min<std::int64_t>(most, Samples::kMost));
    const Samples samples(library, reader, wanted);
    for (std::size_t i = 0; i < samples.size(); ++i) {
      if (!samples.valid(i)) continue;
      const std::size_t size = samples.bytes(i);
      const auto bytes = checked(PyBytes_FromStringAndSize(nullptr, static_cast<Py_ssize_t>(size)));
      samples.copy(i, size, bytes_start(bytes.ptr()));
      list.append(nb::make_tuple(bytes, samples.publisher(i), samples.sent(i)));
    }
    more = samples.size() == wanted;
    most -= wanted;
  }
  return list;
}

std::int32_t wait(const Library& library, Entity wait_set, nb::handle triggered, std::size_t most,
                  std::int64_t timeout_ns) {
  Py_buffer view;
  if (PyObject_GetBuffer(triggered.ptr(), &view, PyBUF_WRITABLE) != 0) throw nb::python_error();
  std::int32_t count = 0;
  {
    const std::size_t fitting = static_cast<std::size_t>(view.len) / sizeof(std::int64_t);
    const Unlocked unlocked;
    count = library.wait(wait_set, static_cast<std::int64_t*>(view.buf), std::min(most, fitting),
                         timeout_ns);
  }
  PyBuffer_Release(&view);
  return count;
}

// The memory of the parts of a message, as long as this lives; made and destroyed with the GIL.
class Buffers {
 public:
  explicit Buffers(PyObject* cdr) {
    if (!PyTuple_Check(cdr)) {
      add(cdr);
      return;
    }
    const auto count = static_cast<std::size_t>(tuple_size(cdr));
    if (count > Writer::kMostParts) {
      joined_ = nb::bytes("", 0).attr("join")(nb::handle(cdr));
      add(joined_.ptr());
      return;
    }
    for (std::size_t i = 0; i < count; ++i) add(tuple_item(cdr, static_cast<Py_ssize_t>(i)));
  }
  Buffers(const Buffers&) = delete;
  Buffers& operator=(const Buffers&) = delete;
  ~Buffers() { release(); }

  std::size_t size() const { return count_; }
  Writer::Parts parts() const {
    Writer::Parts parts;
    for (std::size_t i = 0; i < count_; ++i)
      parts[i] = cyclone::block(views_[i].buf, static_cast<std::size_t>(views_[i].len));
    return parts;
  }

 private:
  void add(PyObject* part) {
    if (PyObject_GetBuffer(part, &views_[count_], PyBUF_SIMPLE) != 0) {
      release();  // the destructor of what was not made is not called
      throw nb::python_error();
    }
    ++count_;
  }
  void release() {
    while (count_ > 0) PyBuffer_Release(&views_[--count_]);
  }

  nb::object joined_;
  std::array<Py_buffer, Writer::kMostParts> views_;
  std::size_t count_ = 0;
};

std::int32_t write(Writer& self, nb::handle cdr) {
  const Buffers buffers(cdr.ptr());
  Writer::Parts parts = buffers.parts();
  const Unlocked unlocked;
  return self.write(parts, buffers.size());
}

FirstRequests::Guid guid_of(const nb::bytes& bytes) {
  FirstRequests::Guid guid;
  if (bytes.size() != guid.size()) throw std::invalid_argument("a GUID has 16 bytes");
  std::memcpy(guid.data(), bytes.c_str(), guid.size());
  return guid;
}

void make_first_requests(FirstRequests* self, const FirstRequests::Functions& functions,
                         const nb::bytes& reader, FirstRequests::Targets targets) {
  new (self) FirstRequests(functions, guid_of(reader), std::move(targets));
}

std::int32_t write_identified(Writer& self, nb::handle cdr, const nb::bytes& guid,
                              std::int64_t number) {
  const cyclone::Identity identity{guid_of(guid), number};
  const Buffers buffers(cdr.ptr());
  Writer::Parts parts = buffers.parts();
  const Unlocked unlocked;
  return self.write_identified(parts, buffers.size(), identity);
}

}  // namespace

void add_cyclone_types(nb::module_& module) {
  nb::class_<Library>(
      module, "Cyclone",
      "Cyclone DDS for native code.\n\n"
      "Args:\n"
      "    functions: Addresses of dds_takecdr, ddsi_serdata_size, ddsi_serdata_to_ser,\n"
      "        ddsi_serdata_unref, dds_set_guardcondition, ddsi_serdata_from_ser_iov, "
      "dds_writecdr\n"
      "        and dds_waitset_wait.\n"
      "    info: Size of dds_sample_info_t, and the offsets of its valid_data, source_timestamp "
      "and\n"
      "        publication_handle.")
      .def("__init__", &make_library, "functions"_a, "info"_a)
      .def("take", &take, "reader"_a, "limit"_a,
           "At most `limit` messages of a reader, with the GIL held, as (bytes, number of the "
           "publisher,\ntime of sending in ns); none when the reader has gone.")
      .def("wait", &wait, "wait_set"_a, "triggered"_a, "most"_a, "timeout_ns"_a,
           "dds_waitset_wait, without the GIL: the number of what is triggered, or an error code.");
  nb::class_<Writer, Outlet>(module, "CycloneWriter",
                             "Sends messages.\n\n"
                             "Args:\n"
                             "    library: What it calls.\n"
                             "    writer: The DDS writer.\n"
                             "    sertype: Address of its ddsi_sertype.")
      .def(nb::init<const Library&, Entity, std::uintptr_t>(), "library"_a, "writer"_a, "sertype"_a)
      .def("write", &write, "cdr"_a,
           "Send a message, which is one buffer or a tuple of the buffers that make it up, "
           "without\n"
           "the GIL. A negative code if that failed: one of Cyclone's, -1001 for bytes that are "
           "no\n"
           "message, -1002 after close(), -1003 if Cyclone makes no sample of them.")
      .def("write_identified", &write_identified, "cdr"_a, "guid"_a, "number"_a,
           "Send a message of a service with the identity of a request beside it, as Fast DDS "
           "does.\n"
           "The code is that of write(), or -1004 if no message of Cyclone's took the identity.")
      .def("close", &Writer::close, "To be called before the writer is deleted.");
  nb::class_<Inlet>(
      module, "CycloneInlet",
      "Hands the messages of a reader to a sink, on the thread that receives them.\n\n"
      "It must outlive the reader, and the sink must outlive it.\n\n"
      "Args:\n"
      "    library: What it calls.\n"
      "    guard: The guard condition that is triggered when the sink is to be served.\n"
      "    sink: Takes the messages.")
      .def(nb::init<const Library&, Entity, Sink&>(), "library"_a, "guard"_a, "sink"_a)
      .def(
          "listener",
          [](Inlet& self) {
            return std::pair(reinterpret_cast<std::uintptr_t>(&Inlet::on_data),
                             reinterpret_cast<std::uintptr_t>(&self));
          },
          "What the reader calls when data is available, and its argument.");
  nb::class_<FirstRequests>(
      module, "CycloneFirstRequests",
      "Asks new clients on Fast DDS for their first request. It must outlive the reader.\n\n"
      "Args:\n"
      "    functions: Addresses of dds_get_matched_publication_data and\n"
      "        dds_builtintopic_free_endpoint.\n"
      "    reader: The GUID of the reader of requests.\n"
      "    targets: IPv4 addresses, as numbers, and ports at which Cyclone receives.")
      .def("__init__", &make_first_requests, "functions"_a, "reader"_a, "targets"_a)
      .def(
          "close",
          [](FirstRequests& self) {
            const Unlocked unlocked;
            self.close();
          },
          "Ask no more clients; wait for the end of the thread that does.")
      .def(
          "listener",
          [](FirstRequests& self) {
            return std::pair(reinterpret_cast<std::uintptr_t>(&FirstRequests::on_matched),
                             reinterpret_cast<std::uintptr_t>(&self));
          },
          "What the reader calls when it matches a writer, and its argument.");
  module.def("carry_identities", &cyclone::carry_identities, "library"_a, "sertype"_a, "base"_a = 0,
             "Have messages of a type carry the identities of requests, as Fast DDS does: those "
             "received\nbegin with a mark, a GUID and a number. False if Cyclone's memory is not "
             "laid out as expected.\n\nArgs:\n"
             "    library: The functions of Cyclone.\n"
             "    sertype: Address of the type.\n"
             "    base: Address of the type of which Cyclone made this one; 0 if it made it anew.");
  module.def("keep_type", &cyclone::keep_type, "library"_a, "sertype"_a,
             "Have the writers of a type use it itself, in Cyclone 0.10. False if Cyclone's memory "
             "is not laid out as expected.");
  module.def("tagged_samples", &cyclone::tagged_samples,
             "The number of samples that have an identity at this moment.");
  module.attr("NUMBER_OF_SAMPLE") = cyclone::Identity::kOfSample;
  module.def("print_on_abort", &cyclone::print_on_abort, "pipe"_a,
             "When this process aborts, write on stderr what can be read from a pipe.");
}

}  // namespace turtlewire::python
