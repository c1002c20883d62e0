// Memory for samples: blocks of a few sizes, cut from large chunks.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace turtlewire {

// Hands out blocks of three sizes and takes them back for reuse. Page faults cost more than storing
// a sample, so a large buffer takes its memory in chunks of 2 MB that ask for huge pages; a small
// buffer takes smaller chunks. All memory goes back to the system when no block is in use.
class Arena {
 public:
  // Bytes of the smallest block; each further size is twice the size before it.
  static constexpr std::size_t kSmallest = 8 * 64;
  static constexpr std::size_t kSizes = 3;

  static constexpr std::size_t bytes_of(std::size_t size_class) { return kSmallest << size_class; }

  Arena() = default;
  Arena(const Arena&) = delete;
  Arena& operator=(const Arena&) = delete;
  ~Arena() { release(); }

  // A block aligned to 64 bytes; throws std::bad_alloc.
  std::byte* take(std::size_t size_class);
  void give_back(std::byte* block, std::size_t size_class) noexcept;

 private:
  static constexpr std::size_t kHugePage = std::size_t{2} << 20;
  static constexpr std::size_t kFirstChunk = 8 * kSmallest;

  struct Chunk {
    void* memory;
    std::size_t alignment;
  };
  struct Unused {  // stands in a block that was given back
    Unused* next;
  };

  void add_chunk();
  void release() noexcept;

  std::vector<Chunk> chunks_;
  std::byte* cursor_ = nullptr;  // of the newest chunk: where its unused rest begins
  std::size_t rest_ = 0;
  std::size_t total_ = 0;   // bytes of all chunks
  std::size_t in_use_ = 0;  // blocks
  std::array<Unused*, kSizes> unused_{};
};

}  // namespace turtlewire
