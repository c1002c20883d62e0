// Collects fields of many messages of one type, as they lie in CDR.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <utility>
#include <vector>

namespace turtlewire {

// What comes next in a message. The numbers are those of turtlewire/bag/column_steps.py.
struct ColumnStep {
  enum class Kind : std::uint32_t {
    kNumbers,   // `size` bytes
    kText,      // a string
    kSequence,  // elements of `size` bytes after their count
    kLoop,      // a sequence whose elements the next `body` steps pass
    kRepeat,    // an array of `size` elements, as above
  };
  static constexpr std::uint32_t kNoColumn = UINT32_MAX;

  Kind kind;
  std::uint32_t size, align, body;
  std::uint32_t column;  // where it goes
};

class ColumnReader {
 public:
  ColumnReader(std::vector<ColumnStep> steps, std::size_t columns)
      : steps_(std::move(steps)), columns_(columns) {}

  // Adds the fields of a message to the columns: numbers as they are; of texts and sequences where
  // they begin in the message and how many elements they have, of loops how many bytes, as two
  // little endian numbers of 64 bits. False for bytes that are not little endian CDR of this type;
  // the columns are of no use then.
  bool take(std::span<const unsigned char> message);

  const std::vector<std::vector<unsigned char>>& columns() const { return columns_; }

 private:
  struct Cursor;

  bool run(std::span<const ColumnStep> steps, Cursor& cursor);
  bool pass(const ColumnStep& step, Cursor& cursor);
  bool pass_many(const ColumnStep& step, std::size_t count, Cursor& cursor);
  void add(std::uint32_t column, std::span<const unsigned char> bytes);
  void add_place(std::uint32_t column, std::uint64_t begin, std::uint64_t count);

  std::vector<ColumnStep> steps_;
  std::vector<std::vector<unsigned char>> columns_;
};

}  // namespace turtlewire
