// Bytes to a DDS writer.
#pragma once

#include <array>
#include <atomic>
#include <memory>
#include <mutex>
#include <span>

#include "../feeds/middleware.hpp"
#include "library.hpp"
#include "service_types.hpp"

namespace turtlewire::cyclone {

class Writer final : public Outlet {
 public:
  // Not codes of Cyclone's: the bytes are no little endian CDR, the writer was closed, Cyclone
  // makes no sample of the bytes, and none of its messages took the identity.
  static constexpr std::int32_t kNoMessage = -1001, kClosed = -1002, kRefused = -1003,
                                kNoIdentity = -1004;

  // `type` is the ddsi_sertype of `writer`, which lives until the writer is deleted.
  Writer(const Library& library, Entity writer, std::uintptr_t type)
      : library_(library), writer_(writer), type_(reinterpret_cast<const void*>(type)) {}

  // Room for the parts of a message and for the padding behind them.
  static constexpr std::size_t kMostParts = 15;
  using Parts = std::array<Block, kMostParts + 1>;

  // Sends a message, whose first part begins with its encapsulation, and copies it once, into
  // Cyclone's sample; a negative code if that failed. May block.
  std::int32_t write(Parts& parts, std::size_t count) {
    void* sample;
    const std::int32_t code = make(parts, count, sample);
    return code < 0 ? code : library_.write(writer_, sample);
  }

  // The same, with an identity beside it; the writer's type carries identities.
  std::int32_t write_identified(Parts& parts, std::size_t count, const Identity& identity) {
    void* sample;
    std::int32_t code = make(parts, count, sample);
    if (code < 0) return code;
    const auto sent = std::make_shared<Tag>(identity);
    tag(sample, sent);
    code = library_.write(writer_, sample);
    return code == 0 && sent->refused && !sent->appended ? kNoIdentity : code;
  }

  std::int32_t send(std::span<const unsigned char> bytes) override {
    Parts parts;
    parts[0] = block(bytes.data(), bytes.size());
    return write(parts, 1);
  }

  // To be called before the writer is deleted: its type goes with it.
  void close() {
    const std::scoped_lock lock(mutex_);
    closed_ = true;
  }

 private:
  static constexpr std::size_t kHeader = 4;
  static constexpr int kData = 2;  // SDK_DATA

  std::int32_t make(Parts& parts, std::size_t count, void*& sample) {
    std::size_t size = 0;
    for (std::size_t i = 0; i < count; ++i) size += parts[i].size;
    if (size <= kHeader || parts[0].size < kHeader) return kNoMessage;
    const auto* const start = static_cast<const unsigned char*>(parts[0].start);
    if (start[0] != 0 || start[1] != 1) return kNoMessage;
    sample = sample_of(parts, count, size);
    if (sample == nullptr) return closed_ ? kClosed : kRefused;
    return 0;
  }

  void* sample_of(Parts& parts, std::size_t count, std::size_t size) {
    static constexpr unsigned char kZeros[4] = {};
    const std::size_t padding = -size & 3;  // Cyclone sends multiples of four bytes
    if (padding != 0) parts[count++] = block(kZeros, padding);
    const std::scoped_lock lock(mutex_);
    if (closed_) return nullptr;
    return library_.make(type_, kData, static_cast<BlockCount>(count), parts.data(),
                         size + padding);
  }

  const Library library_;
  const Entity writer_;
  const void* const type_;
  std::mutex mutex_;
  std::atomic<bool> closed_ = false;
};

}  // namespace turtlewire::cyclone
