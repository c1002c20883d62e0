// What we call of Cyclone DDS 11. Python looks it up, in the very library that it uses itself.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

namespace turtlewire::python {

using Entity = std::int32_t;

struct SampleInfo {  // dds_sample_info_t
  std::uint32_t sample_state, view_state, instance_state;
  bool valid_data;
  std::int64_t source_timestamp;
  std::uint64_t instance_handle, publication_handle;
  std::uint32_t disposed_generation_count, no_writers_generation_count;
  std::uint32_t sample_rank, generation_rank, absolute_generation_rank;
};

// The addresses of dds_takecdr, ddsi_serdata_size, ddsi_serdata_to_ser, ddsi_serdata_unref and
// dds_set_guardcondition.
using Addresses = std::array<std::uintptr_t, 5>;

struct Cyclone {
  Cyclone() = default;
  explicit Cyclone(const Addresses& at)
      : take(reinterpret_cast<decltype(take)>(at[0])),
        size_of(reinterpret_cast<decltype(size_of)>(at[1])),
        copy_of(reinterpret_cast<decltype(copy_of)>(at[2])),
        release(reinterpret_cast<decltype(release)>(at[3])),
        trigger(reinterpret_cast<decltype(trigger)>(at[4])) {}

  std::int32_t (*take)(Entity reader, void** samples, std::uint32_t most, SampleInfo* infos,
                       std::uint32_t states) = nullptr;
  std::uint32_t (*size_of)(const void* sample) = nullptr;
  void (*copy_of)(const void* sample, std::size_t offset, std::size_t size, void* bytes) = nullptr;
  void (*release)(void* sample) = nullptr;
  std::int32_t (*trigger)(Entity guard, bool triggered) = nullptr;
};

// Some samples of a reader, for as long as this lives.
class Samples {
 public:
  static constexpr std::uint32_t kMost = 32;

  Samples(const Cyclone& cyclone, Entity reader, std::uint32_t most)
      : cyclone_(cyclone),
        count_(cyclone.take(reader, samples_.data(), most, infos_.data(), kAnyState)) {}
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
  ~Samples() {
    for (std::size_t i = 0; i < size(); ++i) cyclone_.release(samples_[i]);
  }

  // 0 also when the reader has gone.
  std::size_t size() const { return count_ < 0 ? 0 : static_cast<std::size_t>(count_); }
  const SampleInfo& info(std::size_t i) const { return infos_[i]; }
  std::size_t bytes(std::size_t i) const { return cyclone_.size_of(samples_[i]); }
  void copy(std::size_t i, std::size_t bytes, void* to) const {
    cyclone_.copy_of(samples_[i], 0, bytes, to);
  }

 private:
  static constexpr std::uint32_t kAnyState = 127;

  const Cyclone& cyclone_;
  std::array<void*, kMost> samples_;
  std::array<SampleInfo, kMost> infos_;
  std::int32_t count_;
};

}  // namespace turtlewire::python
