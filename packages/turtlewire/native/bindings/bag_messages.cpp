#include <algorithm>
#include <array>
#include <bit>
#include <cstdint>
#include <stdexcept>
#include <utility>
#include <vector>

#include "../feeds/bag_records.hpp"
#include "../feeds/column_reader.hpp"
#include "../feeds/ros1_to_cdr.hpp"
#include "../feeds/sqlite_table.hpp"
#include "bytes.hpp"
#include "types.hpp"

namespace turtlewire::python {
namespace {

using namespace nb::literals;

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

// The columns of messages, and when these were recorded.
struct LoggedColumns {
  ColumnReader reader;
  std::vector<std::int64_t> log_times;
};

void make_reader(LoggedColumns* self, const nb::list& rows, std::uint32_t columns) {
  constexpr auto last = static_cast<std::uint32_t>(ColumnStep::Kind::kRepeat);
  auto steps = steps_of<ColumnStep, 5>(rows, last);
  for (const ColumnStep& step : steps)
    if (step.column != ColumnStep::kNoColumn && step.column >= columns)
      throw std::invalid_argument("there is no such column");
  new (self) LoggedColumns{ColumnReader(std::move(steps), columns), {}};
}

bool take(LoggedColumns& self, const nb::list& messages) {
  for (const nb::handle message : messages) {
    if (!PyTuple_Check(message.ptr()) || tuple_size(message.ptr()) < 2)
      throw std::invalid_argument("a message is a tuple of log time and bytes");
    const long long log_time = PyLong_AsLongLong(tuple_item(message.ptr(), 0));
    if (log_time == -1 && PyErr_Occurred() != nullptr) throw nb::python_error();
    Bytes bytes;
    PyObject* const data = tuple_item(message.ptr(), tuple_size(message.ptr()) - 1);
    if (!bytes.read(data)) throw nb::python_error();
    if (!self.reader.take(bytes.span())) return false;
    self.log_times.push_back(log_time);
  }
  return true;
}

nb::object log_times(const LoggedColumns& self) {
  const std::span<const std::int64_t> times(self.log_times);
  return checked(PyBytes_FromStringAndSize(reinterpret_cast<const char*>(times.data()),
                                           static_cast<Py_ssize_t>(times.size_bytes())));
}

nb::list columns(const LoggedColumns& self) {
  nb::list found;
  for (const auto& column : self.reader.columns()) found.append(bytes_of(column));
  return found;
}

nb::object convert(const Ros1ToCdr& self, nb::handle message) {
  Bytes bytes;
  if (!bytes.read(message.ptr())) throw nb::python_error();
  std::vector<unsigned char> cdr;
  return self.convert(bytes.span(), cdr) ? bytes_of(cdr) : nb::none();
}

// Appends messages, converted if their channel has a conversion; returns where the first one is
// that Python must convert: its channel has None, or the bytes do not follow the steps.
std::size_t convert_messages(const nb::list& messages, std::size_t position,
                             const nb::dict& conversions, nb::list into) {
  std::vector<unsigned char> cdr;
  for (; position < messages.size(); ++position) {
    const nb::object message = messages[position];
    if (!PyTuple_Check(message.ptr()) || tuple_size(message.ptr()) != 4)
      throw std::invalid_argument("a message is a tuple of two times, a channel and bytes");
    PyObject* const conversion =
        PyDict_GetItemWithError(conversions.ptr(), tuple_item(message.ptr(), 1));
    if (conversion == nullptr) {
      if (PyErr_Occurred() != nullptr) throw nb::python_error();
      into.append(message);
      continue;
    }
    if (conversion == Py_None) break;
    Bytes bytes;
    if (!bytes.read(tuple_item(message.ptr(), 3))) throw nb::python_error();
    if (!nb::cast<const Ros1ToCdr&>(nb::handle(conversion)).convert(bytes.span(), cdr)) break;
    const nb::object converted = checked(PyTuple_New(4));
    for (Py_ssize_t i = 0; i < 3; ++i)
      set_tuple_item(converted.ptr(), i, Py_NewRef(tuple_item(message.ptr(), i)));
    set_tuple_item(converted.ptr(), 3, bytes_of(cdr).release().ptr());
    into.append(converted);
  }
  return position;
}

// The messages of a sqlite3 file, from the first row to the last.
class MessageTable {
 public:
  MessageTable(nb::handle file, std::size_t page_bytes, std::size_t usable_bytes,
               std::uint32_t root)
      : table_(bytes_of_file(file), page_bytes, usable_bytes) {
    // 480 usable bytes are the fewest that SQLite accepts.
    if (usable_bytes < 480 || page_bytes < usable_bytes || page_bytes > 1 << 16)
      throw std::invalid_argument("SQLite has no pages of this size");
    is_whole_ = table_.find_leaves(root, leaves_);
    if (!is_whole_) leaves_.clear();
  }

  bool read(nb::handle topics, std::int64_t start, std::int64_t end, std::size_t bytes,
            const nb::list& into) {
    Wanted is_wanted(topics);
    SqliteRow row;
    for (; leaf_ < leaves_.size(); ++leaf_, row_ = 0) {
      for (const std::size_t rows = table_.rows_on(leaves_[leaf_]); row_ < rows; ++row_) {
        if (bytes == 0) return true;
        if (!table_.read(row, leaves_[leaf_], row_) || row.topic < 0 || row.topic > UINT32_MAX)
          return stop();
        const bool in_time = start <= row.log_time && row.log_time <= end;
        if (in_time && is_wanted(static_cast<std::uint32_t>(row.topic))) {
          if (!append(row, into)) return stop();
          bytes -= std::min(bytes, row.data_size + 1);
        }
        last_id_ = row.id;
      }
    }
    return false;
  }

  bool is_whole() const { return is_whole_; }
  std::int64_t last_id() const { return last_id_; }

 private:
  std::span<const unsigned char> bytes_of_file(nb::handle file) {
    if (!file_.read(file.ptr())) throw nb::python_error();
    return file_.span();
  }

  bool append(const SqliteRow& row, const nb::list& into) const {
    const auto size = static_cast<Py_ssize_t>(row.data_size);
    const nb::object data = checked(PyBytes_FromStringAndSize(nullptr, size));
    auto* const start = reinterpret_cast<unsigned char*>(bytes_start(data.ptr()));
    if (!table_.copy_data(row, start)) return false;
    const nb::object log_time = checked(PyLong_FromLongLong(row.log_time));
    const nb::object message = checked(PyTuple_New(2));
    set_tuple_item(message.ptr(), 0, Py_NewRef(log_time.ptr()));
    set_tuple_item(message.ptr(), 1, Py_NewRef(data.ptr()));
    if (PyList_Append(into.ptr(), message.ptr()) != 0) throw nb::python_error();
    return true;
  }

  bool stop() {
    is_whole_ = false;
    leaf_ = leaves_.size();
    return false;
  }

  Bytes file_;
  SqliteTable table_;
  std::vector<std::uint32_t> leaves_;
  std::size_t leaf_ = 0, row_ = 0;  // where the next row is
  std::int64_t last_id_ = INT64_MIN;
  bool is_whole_ = true;
};

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
  module.def("convert_messages", &convert_messages, "messages"_a.lock(), "position"_a,
             "conversions"_a.lock(), "into"_a,
             "Appends messages to a list, converted to CDR if their channel has a Ros1ToCdr.\n\n"
             "Returns:\n"
             "    Where the first message is that it cannot convert: its channel has None, or\n"
             "    Ros1ToCdr.convert() returns None for it. The length if it converts all.");
  nb::class_<MessageTable>(
      module, "MessageTable",
      "Reads the table of messages of a rosbag2 file of sqlite3, without SQL.\n\n"
      "Args:\n"
      "    file: The bytes of the file.\n"
      "    page_bytes: The size of a page.\n"
      "    usable_bytes: How much of a page is in use.\n"
      "    root: The first page of the table.")
      .def(nb::init<nb::handle, std::size_t, std::size_t, std::uint32_t>(), "file"_a,
           "page_bytes"_a, "usable_bytes"_a, "root"_a)
      .def("read", &MessageTable::read, "topics"_a, "start_ns"_a, "end_ns"_a, "block_bytes"_a,
           "into"_a, nb::lock_self(),
           "Appends log time and bytes of the next messages to a list, until there are enough\n"
           "bytes. False at the end of the table, or before a row of another form.")
      .def_prop_ro("is_whole", &MessageTable::is_whole, nb::lock_self(),
                   "False if a row has another form than the rows of rosbag2.")
      .def_prop_ro("last_id", &MessageTable::last_id, nb::lock_self(),
                   "The id of the last row that was read; the lowest number before the first.");
  nb::class_<LoggedColumns>(module, "ColumnReader",
                            "Collects fields of many messages of one type.\n\n"
                            "Args:\n"
                            "    steps: Kind, size, alignment, body and column of each step; see\n"
                            "        turtlewire.bag.column_steps.\n"
                            "    columns: The number of columns.")
      .def("__init__", &make_reader, "steps"_a, "columns"_a)
      .def("take", &take, "messages"_a.lock(), nb::lock_self(),
           "Adds the fields of messages: tuples whose first item is the log time and whose last\n"
           "is the bytes. False, and the columns are of no use, if one is not little endian CDR\n"
           "of the type. Raises OverflowError for a log time beyond 63 bits.")
      .def_prop_ro("log_times", &log_times, nb::lock_self(),
                   "The log times of the messages in nanoseconds, 64 bits each.")
      .def_prop_ro("columns", &columns, nb::lock_self(),
                   "The bytes of each column: numbers; of texts and sequences where they begin in "
                   "their message, and how many elements they have, 64 bits each.");
}

}  // namespace turtlewire::python
