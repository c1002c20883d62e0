#include "bag_messages.hpp"

#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../feeds/bag_records.hpp"
#include "../feeds/column_reader.hpp"
#include "../feeds/ros1_to_cdr.hpp"
#include "bytes.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

nb::object checked(PyObject* object) {
  if (object == nullptr) throw nb::python_error();
  return nb::steal(object);
}

nb::object bytes_of(std::span<const unsigned char> data) {
  return checked(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(data.data()),
                                           static_cast<Py_ssize_t>(data.size())));
}

// Whether the channel of a record is requested; consecutive records often have the same channel.
class Wanted {
 public:
  explicit Wanted(nb::handle channels) : channels_(channels) {}

  bool operator()(std::uint32_t channel) {
    if (channels_.is_none()) return true;
    if (channel != last_) {
      last_ = channel;
      const int found = PySequence_Contains(channels_.ptr(), nb::int_(channel).ptr());
      if (found < 0) throw nb::python_error();
      is_last_wanted_ = found == 1;
    }
    return is_last_wanted_;
  }

 private:
  nb::handle channels_;
  std::uint64_t last_ = UINT64_MAX;
  bool is_last_wanted_ = false;
};

using ReadRecord = bool (*)(BagRecord&, std::span<const unsigned char>, std::size_t);

template <ReadRecord read>
std::size_t messages(nb::handle records, std::size_t position, nb::handle wanted, nb::list into) {
  Bytes bytes;
  if (!bytes.read(records.ptr())) throw nb::python_error();
  Wanted is_wanted(wanted);
  BagRecord record;
  for (; position < bytes.size(); position = record.end) {
    if (!read(record, bytes.span(), position) || !record.is_message) break;
    if (!is_wanted(record.channel)) continue;
    const std::array<nb::object, 4> items = {
        checked(PyLong_FromUnsignedLongLong(record.log_time)), nb::int_(record.channel),
        checked(PyLong_FromUnsignedLongLong(record.publish_time)), bytes_of(record.data)};
    const nb::object message = checked(PyTuple_New(4));
    for (std::size_t i = 0; i < items.size(); ++i)
      set_tuple_item(message.ptr(), static_cast<Py_ssize_t>(i), Py_NewRef(items[i].ptr()));
    into.append(message);
  }
  return position;
}

// The steps of a type, as tuples of so many numbers; the first four are alike for both kinds.
template <typename Step, std::size_t N>
std::vector<Step> steps_of(const nb::list& rows, std::uint32_t last_kind) {
  std::vector<Step> steps;
  for (const nb::handle handle : rows) {
    const auto row = nb::cast<nb::tuple>(handle);
    std::array<std::uint32_t, N> numbers{};
    if (row.size() != N) throw std::invalid_argument("a step has other numbers");
    for (std::size_t i = 0; i < N; ++i) numbers[i] = nb::cast<std::uint32_t>(row[i]);
    if (numbers[0] > last_kind) throw std::invalid_argument("there is no such step");
    Step step{static_cast<typename Step::Kind>(numbers[0]), numbers[1], numbers[2], numbers[3]};
    if constexpr (N == 5) step.column = numbers[4];
    steps.push_back(step);
  }
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (steps[i].body >= steps.size() - i) throw std::invalid_argument("a loop has no end");
    if (!std::has_single_bit(steps[i].align) || steps[i].align > 8)
      throw std::invalid_argument("there is no such alignment");
  }
  return steps;
}

void make_conversion(Ros1ToCdr* self, const nb::list& rows) {
  constexpr auto last = static_cast<std::uint32_t>(ConversionStep::Kind::kEmptyText);
  new (self) Ros1ToCdr(steps_of<ConversionStep, 4>(rows, last));
}

void make_reader(ColumnReader* self, const nb::list& rows, std::uint32_t columns) {
  constexpr auto last = static_cast<std::uint32_t>(ColumnStep::Kind::kRepeat);
  auto steps = steps_of<ColumnStep, 5>(rows, last);
  for (const ColumnStep& step : steps)
    if (step.column != ColumnStep::kNoColumn && step.column >= columns)
      throw std::invalid_argument("there is no such column");
  new (self) ColumnReader(std::move(steps), columns);
}

bool take(ColumnReader& self, const nb::list& messages) {
  for (const nb::handle message : messages) {
    Bytes bytes;
    if (!bytes.read(nb::cast<nb::tuple>(message)[3].ptr())) throw nb::python_error();
    if (!self.take(bytes.span())) return false;
  }
  return true;
}

nb::list columns(const ColumnReader& self) {
  nb::list found;
  for (const auto& column : self.columns()) found.append(bytes_of(column));
  return found;
}

nb::object convert(const Ros1ToCdr& self, nb::handle message) {
  Bytes bytes;
  if (!bytes.read(message.ptr())) throw nb::python_error();
  std::vector<unsigned char> cdr;
  return self.convert(bytes.span(), cdr) ? bytes_of(cdr) : nb::none();
}

constexpr char kMessagesDoc[] =
    "Appends the messages of a chunk's records to a list, up to a record of another kind.\n\n"
    "Args:\n"
    "    records: The bytes.\n"
    "    position: Where the first record begins.\n"
    "    wanted: The channels whose messages are wanted; None means all.\n"
    "    into: The list, to which log time, channel, publish time and bytes are appended.\n\n"
    "Returns:\n"
    "    Where the first record begins that is no message or is damaged; else the end.";

}  // namespace

void add_bag_message_types(nb::module_& module) {
  module.def("mcap_messages", &messages<read_mcap_record>, "records"_a, "position"_a,
             "wanted"_a.none(), "into"_a, kMessagesDoc);
  module.def("ros1_messages", &messages<read_ros1_record>, "records"_a, "position"_a,
             "wanted"_a.none(), "into"_a, kMessagesDoc);
  nb::class_<Ros1ToCdr>(module, "Ros1ToCdr",
                        "Converts the messages of one type from the bytes of ROS 1 to CDR.\n\n"
                        "Args:\n"
                        "    steps: Kind, size, alignment and body of each step; see\n"
                        "        turtlewire.bag.ros1_steps.")
      .def("__init__", &make_conversion, "steps"_a)
      .def("convert", &convert, "message"_a,
           "The CDR of a message; None for bytes that do not follow the steps, or that hold text\n"
           "beyond ASCII.");
  nb::class_<ColumnReader>(module, "ColumnReader",
                           "Collects fields of many messages of one type.\n\n"
                           "Args:\n"
                           "    steps: Kind, size, alignment, body and column of each step; see\n"
                           "        turtlewire.bag.column_steps.\n"
                           "    columns: The number of columns.")
      .def("__init__", &make_reader, "steps"_a, "columns"_a)
      .def("take", &take, "messages"_a,
           "Adds the fields of messages, whose bytes are the fourth items of tuples. False, and\n"
           "the columns are of no use, if one is not little endian CDR of the type.")
      .def_prop_ro("columns", &columns,
                   "The bytes of each column: numbers; of texts and sequences where they begin in "
                   "their message, and how many elements they have, 64 bits each.");
}

}  // namespace turtlewire::python
