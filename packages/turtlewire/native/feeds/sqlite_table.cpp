#include "sqlite_table.hpp"

#include <algorithm>
#include <cstring>

namespace turtlewire {
namespace {

constexpr unsigned char kInterior = 0x05, kLeaf = 0x0D;
constexpr std::size_t kInteriorHeader = 12, kLeafHeader = 8;
constexpr int kDeepest = 20;  // SQLite's own limit
constexpr std::uint64_t kNull = 0, kFirstBlob = 12;

template <typename T>
T big(const unsigned char* p) {
  T value = 0;
  for (std::size_t i = 0; i < sizeof(T); ++i) value = static_cast<T>(value << 8 | p[i]);
  return value;
}

// Reads from the front of some bytes; `ok` is false once they were too few.
struct Front {
  std::span<const unsigned char> bytes;
  bool ok = true;

  std::uint64_t varint() {
    std::uint64_t value = 0;
    for (std::size_t i = 0; i < 9 && i < bytes.size(); ++i) {
      const std::uint64_t byte = bytes[i];
      const bool is_last = i == 8 || byte < 0x80;
      value = i == 8 ? value << 8 | byte : value << 7 | (byte & 0x7F);
      if (!is_last) continue;
      bytes = bytes.subspan(i + 1);
      return value;
    }
    ok = false;
    return 0;
  }

  // An integer of a record, as its serial type says; other types are refused.
  std::int64_t integer(std::uint64_t type) {
    if (type == 8 || type == 9) return static_cast<std::int64_t>(type) - 8;
    constexpr std::size_t kSizes[] = {0, 1, 2, 3, 4, 6, 8};
    const std::size_t size = type >= 1 && type <= 6 ? kSizes[type] : 0;
    ok = ok && size > 0 && size <= bytes.size();
    if (!ok) return 0;
    std::uint64_t value = (bytes[0] & 0x80) != 0 ? UINT64_MAX : 0;
    for (const unsigned char byte : bytes.first(size)) value = value << 8 | byte;
    bytes = bytes.subspan(size);
    return static_cast<std::int64_t>(value);
  }
};

}  // namespace

std::span<const unsigned char> SqliteTable::page(std::uint32_t number) const {
  if (number < 2 || number > file_.size() / page_bytes_) return {};  // 1 has the file's header
  return file_.subspan((number - 1) * page_bytes_, usable_bytes_);
}

bool SqliteTable::find_leaves(std::uint32_t root, std::vector<std::uint32_t>& leaves) const {
  return find_leaves(root, 0, leaves);
}

bool SqliteTable::find_leaves(std::uint32_t number, int depth,
                              std::vector<std::uint32_t>& leaves) const {
  const auto bytes = page(number);
  // A damaged file may name a page twice.
  if (bytes.empty() || depth > kDeepest || leaves.size() > file_.size() / page_bytes_) return false;
  if (bytes[0] == kLeaf) {
    leaves.push_back(number);
    return true;
  }
  if (bytes[0] != kInterior) return false;
  const std::size_t cells = big<std::uint16_t>(&bytes[3]);
  if (cells > (bytes.size() - kInteriorHeader) / 2) return false;
  for (std::size_t i = 0; i < cells; ++i) {
    const std::size_t cell = big<std::uint16_t>(&bytes[kInteriorHeader + 2 * i]);
    if (cell > bytes.size() - 4) return false;
    if (!find_leaves(big<std::uint32_t>(&bytes[cell]), depth + 1, leaves)) return false;
  }
  return find_leaves(big<std::uint32_t>(&bytes[8]), depth + 1, leaves);
}

std::size_t SqliteTable::rows_on(std::uint32_t leaf) const {
  return big<std::uint16_t>(&page(leaf)[3]);
}

bool SqliteTable::read(SqliteRow& row, std::uint32_t leaf, std::size_t number) const {
  const auto bytes = page(leaf);
  const std::size_t pointer = kLeafHeader + 2 * number;
  if (pointer > bytes.size() - 2) return false;
  const std::size_t cell = big<std::uint16_t>(&bytes[pointer]);
  if (cell >= bytes.size()) return false;

  Front front{bytes.subspan(cell)};
  const std::uint64_t payload = front.varint();
  row.id = static_cast<std::int64_t>(front.varint());
  if (!front.ok || payload > file_.size()) return false;
  const std::size_t most = usable_bytes_ - 35;
  std::size_t local = static_cast<std::size_t>(payload);
  if (payload > most) {
    const std::size_t least = (usable_bytes_ - 12) * 32 / 255 - 23;
    local = least + (static_cast<std::size_t>(payload) - least) % (usable_bytes_ - 4);
    if (local > most) local = least;
  }
  const bool overflows = local < payload;
  if (local + 4 * overflows > front.bytes.size()) return false;
  row.overflow = overflows ? big<std::uint32_t>(&front.bytes[local]) : 0;

  Front values{front.bytes.first(local)};
  const std::size_t before = values.bytes.size();
  const std::uint64_t header = values.varint();
  std::uint64_t types[4];
  for (std::uint64_t& type : types) type = values.varint();
  if (!values.ok || before - values.bytes.size() != header) return false;
  if (types[0] != kNull || types[3] < kFirstBlob || types[3] % 2 != 0) return false;
  row.topic = values.integer(types[1]);
  row.log_time = values.integer(types[2]);
  row.data_size = static_cast<std::size_t>((types[3] - kFirstBlob) / 2);
  row.on_leaf = values.bytes;
  return values.ok && before - values.bytes.size() + row.data_size == payload;
}

bool SqliteTable::copy_data(const SqliteRow& row, unsigned char* into) const {
  auto part = row.on_leaf;
  std::uint32_t next = row.overflow;
  for (std::size_t rest = row.data_size;;) {
    if (!part.empty()) std::memcpy(into, part.data(), part.size());
    into += part.size();
    rest -= part.size();
    if (rest == 0) return true;
    const auto bytes = page(next);
    if (bytes.empty()) return false;
    next = big<std::uint32_t>(bytes.data());
    part = bytes.subspan(4, std::min(rest, bytes.size() - 4));
  }
}

}  // namespace turtlewire
