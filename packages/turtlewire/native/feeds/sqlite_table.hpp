// The messages of rosbag2's sqlite3 files, without SQL: https://www.sqlite.org/fileformat2.html.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace turtlewire {

// A row of the table `messages`, whose columns are id, topic_id, timestamp and data.
struct SqliteRow {
  std::int64_t id = 0, topic = 0, log_time = 0;
  std::size_t data_size = 0;
  std::span<const unsigned char> on_leaf;  // the beginning of the data
  std::uint32_t overflow = 0;              // the page with the rest; 0 means that there is none
};

// A table in the pages of a file. It refuses rows in any form that rosbag2 does not write; SQLite
// can read those.
class SqliteTable {
 public:
  // Args: the file, the size of its pages, and how much of each is in use.
  SqliteTable(std::span<const unsigned char> file, std::size_t page_bytes, std::size_t usable_bytes)
      : file_(file), page_bytes_(page_bytes), usable_bytes_(usable_bytes) {}

  // Appends the leaves of the table whose tree begins at a page, in the order of their rows.
  bool find_leaves(std::uint32_t root, std::vector<std::uint32_t>& leaves) const;

  // The number of rows on a leaf.
  std::size_t rows_on(std::uint32_t leaf) const;

  bool read(SqliteRow& row, std::uint32_t leaf, std::size_t number) const;

  // Copies the data of a row, `row.data_size` bytes.
  bool copy_data(const SqliteRow& row, unsigned char* into) const;

 private:
  std::span<const unsigned char> page(std::uint32_t number) const;
  bool find_leaves(std::uint32_t page, int depth, std::vector<std::uint32_t>& leaves) const;

  std::span<const unsigned char> file_;
  std::size_t page_bytes_, usable_bytes_;
};

}  // namespace turtlewire
