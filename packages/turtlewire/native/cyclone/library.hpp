// The functions of Cyclone DDS that we call, which are the same in 0.10 and 11. Python looks them
// up in the library that it uses itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <cstring>

namespace turtlewire::cyclone {

using Entity = std::int32_t;

// One block of memory (ddsrt_iovec_t), and the type that counts such blocks.
#if defined(_WIN32)
struct Block {
  std::uint32_t size;
  const void* start;
};
using BlockCount = std::uint32_t;
#else
struct Block {
  const void* start;
  std::size_t size;
};
#if defined(__linux__)
using BlockCount = std::size_t;
#else
using BlockCount = int;
#endif
#endif

inline Block block(const void* start, std::size_t size) {
  Block made = {};
  made.start = start;
  made.size = static_cast<decltype(Block::size)>(size);
  return made;
}

// The addresses of the functions of Library, in their order.
using Addresses = std::array<std::uintptr_t, 8>;

// dds_sample_info_t as src/turtlewire/wire/cyclone/library.py declares it: its size, and where in
// it valid_data, source_timestamp and publication_handle are.
using InfoLayout = std::array<std::size_t, 4>;

struct Library {
  Library(const Addresses& at, const InfoLayout& info)
      : take(reinterpret_cast<decltype(take)>(at[0])),
        size_of(reinterpret_cast<decltype(size_of)>(at[1])),
        copy_of(reinterpret_cast<decltype(copy_of)>(at[2])),
        release(reinterpret_cast<decltype(release)>(at[3])),
        trigger(reinterpret_cast<decltype(trigger)>(at[4])),
        make(reinterpret_cast<decltype(make)>(at[5])),
        write(reinterpret_cast<decltype(write)>(at[6])),
        wait(reinterpret_cast<decltype(wait)>(at[7])),
        info(info) {}

  // dds_takecdr, ddsi_serdata_size, ddsi_serdata_to_ser, ddsi_serdata_unref
  std::int32_t (*take)(Entity reader, void** samples, std::uint32_t most, void* infos,
                       std::uint32_t states);
  std::uint32_t (*size_of)(const void* sample);
  void (*copy_of)(const void* sample, std::size_t offset, std::size_t size, void* bytes);
  void (*release)(void* sample);
  // dds_set_guardcondition
  std::int32_t (*trigger)(Entity guard, bool triggered);
  // ddsi_serdata_from_ser_iov, and dds_writecdr, which takes the sample over
  void* (*make)(const void* type, int kind, BlockCount count, const Block* blocks,
                std::size_t size);
  std::int32_t (*write)(Entity writer, void* sample);
  // dds_waitset_wait
  std::int32_t (*wait)(Entity wait_set, std::int64_t* triggered, std::size_t most,
                       std::int64_t timeout_ns);

  InfoLayout info;
};

// Some samples of a reader, for as long as this lives.
class Samples {
 public:
  static constexpr std::uint32_t kMost = 32;
  static constexpr std::size_t kLargestInfo = 128;

  Samples(const Library& library, Entity reader, std::uint32_t most)
      : library_(library),
        count_(library.take(reader, samples_.data(), most, infos_.data(), kAnyState)) {}
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
  ~Samples() {
    for (std::size_t i = 0; i < size(); ++i) library_.release(samples_[i]);
  }

  // 0 also if the reader was deleted.
  std::size_t size() const { return count_ < 0 ? 0 : static_cast<std::size_t>(count_); }
  bool valid(std::size_t i) const { return info<unsigned char>(i, 1) != 0; }
  std::int64_t sent(std::size_t i) const { return info<std::int64_t>(i, 2); }
  std::uint64_t publisher(std::size_t i) const { return info<std::uint64_t>(i, 3); }
  std::size_t bytes(std::size_t i) const { return library_.size_of(samples_[i]); }
  void copy(std::size_t i, std::size_t bytes, void* to) const {
    library_.copy_of(samples_[i], 0, bytes, to);
  }

 private:
  static constexpr std::uint32_t kAnyState = 127;

  template <typename Value>
  Value info(std::size_t i, std::size_t member) const {
    Value value;
    std::memcpy(&value, infos_.data() + i * library_.info[0] + library_.info[member], sizeof value);
    return value;
  }

  const Library& library_;
  std::array<void*, kMost> samples_;
  alignas(std::max_align_t) std::array<unsigned char, kMost * kLargestInfo> infos_;
  std::int32_t count_;
};

}  // namespace turtlewire::cyclone
