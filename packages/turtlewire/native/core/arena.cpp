#include "arena.hpp"

#include <algorithm>
#include <new>

#if defined(__linux__)
#include <sys/mman.h>
#endif

namespace turtlewire {

std::byte* Arena::take(std::size_t size_class) {
  std::byte* block = nullptr;
  if (Unused* unused = unused_[size_class]; unused != nullptr) {
    unused_[size_class] = unused->next;
    block = reinterpret_cast<std::byte*>(unused);
  } else {
    const std::size_t bytes = bytes_of(size_class);
    if (rest_ < bytes) add_chunk();
    block = cursor_;
    cursor_ += bytes;
    rest_ -= bytes;
  }
  ++in_use_;
  return block;
}

void Arena::give_back(std::byte* block, std::size_t size_class) noexcept {
  unused_[size_class] = new (block) Unused{unused_[size_class]};
  if (--in_use_ == 0) release();
}

// Doubles the memory, by 2 MB at most.
void Arena::add_chunk() {
  const std::size_t bytes = std::clamp(total_, kFirstChunk, kHugePage);
  const std::size_t alignment = bytes == kHugePage ? kHugePage : 64;
  chunks_.reserve(chunks_.size() + 1);
  void* memory = ::operator new(bytes, std::align_val_t{alignment});
#if defined(__linux__)
  // Without huge pages the buffer works as well, only slower: the result does not matter.
  if (bytes == kHugePage) static_cast<void>(madvise(memory, bytes, MADV_HUGEPAGE));
#endif
  chunks_.push_back({memory, alignment});
  cursor_ = static_cast<std::byte*>(memory);
  rest_ = bytes;
  total_ += bytes;
}

void Arena::release() noexcept {
  for (const Chunk& chunk : chunks_)
    ::operator delete(chunk.memory, std::align_val_t{chunk.alignment});
  chunks_.clear();
  unused_ = {};
  cursor_ = nullptr;
  rest_ = total_ = 0;
}

}  // namespace turtlewire
