// Bytes to a DDS writer.
#pragma once

#include <atomic>
#include <mutex>
#include <span>

#include "library.hpp"

namespace turtlewire::cyclone {

class Writer {
 public:
  // Not a code of Cyclone's: the bytes are no little endian CDR, the writer was closed, and Cyclone
  // makes no sample of the bytes.
  static constexpr std::int32_t kNoMessage = -1001, kClosed = -1002, kRefused = -1003;

  // `type` is the ddsi_sertype of `writer`, which lives until the writer is deleted.
  Writer(const Library& library, Entity writer, std::uintptr_t type)
      : library_(library), writer_(writer), type_(reinterpret_cast<const void*>(type)) {}

  // Sends a message with its encapsulation; a negative code if that failed. May block.
  std::int32_t write(std::span<const unsigned char> cdr) {
    if (cdr.size() <= kHeader || cdr[0] != 0 || cdr[1] != 1) return kNoMessage;
    void* const sample = sample_of(cdr);
    if (sample == nullptr) return closed_ ? kClosed : kRefused;
    return library_.write(writer_, sample);
  }

  // To be called before the writer is deleted: its type goes with it.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }

 private:
  static constexpr std::size_t kHeader = 4;
  static constexpr int kData = 2;  // SDK_DATA

  void* sample_of(std::span<const unsigned char> cdr) {
    static constexpr unsigned char kZeros[4] = {};
    const std::size_t padding = -cdr.size() & 3;  // Cyclone sends multiples of four bytes
    Block blocks[2] = {};
    blocks[0].start = cdr.data();
    blocks[0].size = static_cast<decltype(Block::size)>(cdr.size());
    blocks[1].start = kZeros;
    blocks[1].size = static_cast<decltype(Block::size)>(padding);
    const std::scoped_lock lock(mutex_);
    if (closed_) return nullptr;
    return library_.make(type_, kData, padding == 0 ? 1 : 2, blocks, cdr.size() + padding);
  }

  const Library library_;
  const Entity writer_;
  const void* const type_;
  std::mutex mutex_;
  std::atomic<bool> closed_ = false;
};

}  // namespace turtlewire::cyclone
