#include "column_reader.hpp"

#include "bag_records.hpp"

namespace turtlewire {
namespace {

constexpr std::size_t kHeader = 4;

}  // namespace

struct ColumnReader::Cursor {
  std::span<const unsigned char> message;
  std::size_t at = kHeader;

  std::size_t rest() const { return message.size() - at; }

  bool align(std::size_t size) {
    const std::size_t padding = (kHeader - at) % size;
    if (padding > rest()) return false;
    at += padding;
    return true;
  }

  // A count of elements, of which each has a byte at least.
  bool count(std::size_t& value) {
    if (!align(4) || rest() < 4) return false;
    value = little<std::uint32_t>(message.data() + at);
    at += 4;
    return value <= rest();
  }
};

bool ColumnReader::take(std::span<const unsigned char> message) {
  if (message.size() < kHeader || message[0] != 0 || message[1] != 1) return false;
  Cursor cursor{message};
  return run(steps_, cursor);
}

bool ColumnReader::run(std::span<const ColumnStep> steps, Cursor& cursor) {
  for (std::size_t i = 0; i < steps.size(); i += 1 + steps[i].body) {
    const ColumnStep& step = steps[i];
    if (step.kind != ColumnStep::Kind::kLoop && step.kind != ColumnStep::Kind::kRepeat) {
      if (!pass(step, cursor)) return false;
      continue;
    }
    std::size_t count = step.size;
    if (step.kind == ColumnStep::Kind::kLoop && !cursor.count(count)) return false;
    const std::size_t begin = cursor.at;
    for (; count > 0; --count)
      if (!run(steps.subspan(i + 1, step.body), cursor)) return false;
    if (step.column != ColumnStep::kNoColumn) add_place(step.column, begin, cursor.at - begin);
  }
  return true;
}

bool ColumnReader::pass(const ColumnStep& step, Cursor& cursor) {
  std::size_t count = 1;
  switch (step.kind) {
    case ColumnStep::Kind::kNumbers:
      if (!cursor.align(step.align) || cursor.rest() < step.size) return false;
      if (step.column != ColumnStep::kNoColumn)
        add(step.column, cursor.message.subspan(cursor.at, step.size));
      cursor.at += step.size;
      return true;
    case ColumnStep::Kind::kText: {
      if (!cursor.count(count)) return false;
      const std::size_t end = cursor.at + count;
      if (cursor.message[end - 1] != 0) return false;  // without a terminator
      if (step.column != ColumnStep::kNoColumn)
        add_place(step.column, cursor.at, count == 0 ? 0 : count - 1);
      cursor.at = end;
      return true;
    }
    case ColumnStep::Kind::kSequence:
      return cursor.count(count) && pass_many(step, count, cursor);
    default:
      return false;
  }
}

bool ColumnReader::pass_many(const ColumnStep& step, std::size_t count, Cursor& cursor) {
  if (count > 0 && !cursor.align(step.align)) return false;
  if (step.size != 0 && count > cursor.rest() / step.size) return false;
  if (step.column != ColumnStep::kNoColumn) add_place(step.column, cursor.at, count);
  cursor.at += count * step.size;
  return true;
}

void ColumnReader::add(std::uint32_t column, std::span<const unsigned char> bytes) {
  columns_[column].insert(columns_[column].end(), bytes.begin(), bytes.end());
}

void ColumnReader::add_place(std::uint32_t column, std::uint64_t begin, std::uint64_t count) {
  for (const std::uint64_t value : {begin, count})
    for (int shift = 0; shift < 64; shift += 8)
      columns_[column].push_back(static_cast<unsigned char>(value >> shift));
}

}  // namespace turtlewire
