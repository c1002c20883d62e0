// The history of one link: samples in order of time, in one ring of exact capacity, stamps apart
// from poses.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <new>
#include <utility>

#include "pose.hpp"

namespace turtlewire {

using FrameId = std::uint32_t;   // 0 is "NO_PARENT"
using Stamp = std::int64_t;      // nanoseconds; 0 asks for the latest
using SourceId = std::uint32_t;  // who sent it

inline constexpr Stamp kForever = std::numeric_limits<Stamp>::max();

// The time a span before another; the first of all times if there is none.
inline Stamp earlier(Stamp t, Stamp span) {
  constexpr Stamp first = std::numeric_limits<Stamp>::min();
  return t < first + span ? first : t - span;
}

// As tf2 turns times and durations into seconds; its texts show the rounding.
inline double seconds(Stamp t) {
  constexpr Stamp second = 1'000'000'000;
  return static_cast<double>(t / second) + 1e-9 * static_cast<double>(t % second);
}

// One cache line. The stamps, which a search reads, are kept apart, so that a search touches 8
// bytes of a sample.
struct alignas(64) Sample {
  Pose pose;
  FrameId parent = 0;
  SourceId source = 0;
};
static_assert(sizeof(Sample) == 64);

// Samples sorted by stamp; those of one stamp are in order of arrival. Index 0 is the oldest.
class Samples {
 public:
  Samples() = default;
  Samples(const Samples&) = delete;
  Samples& operator=(const Samples&) = delete;
  Samples& operator=(Samples&& other) noexcept {
    std::swap(stamps_, other.stamps_);
    std::swap(samples_, other.samples_);
    std::swap(capacity_, other.capacity_);
    std::swap(head_, other.head_);
    std::swap(size_, other.size_);
    std::swap(per_ns_, other.per_ns_);
    return *this;
  }
  ~Samples() { release(); }

  std::size_t size() const { return size_; }
  bool empty() const { return size_ == 0; }
  std::size_t capacity() const { return capacity_; }
  std::size_t bytes() const { return capacity_ * (sizeof(Stamp) + sizeof(Sample)); }

  Stamp stamp(std::size_t i) const { return stamps_[slot(i)]; }
  const Sample& operator[](std::size_t i) const { return samples_[slot(i)]; }
  Sample& operator[](std::size_t i) { return samples_[slot(i)]; }
  Stamp oldest() const { return stamps_[head_]; }
  Stamp newest() const { return stamps_[slot(size_ - 1)]; }
  const Sample& front() const { return samples_[head_]; }
  const Sample& back() const { return samples_[slot(size_ - 1)]; }

  // `keep` is how long samples are kept: it tells, with the rate so far, how many there will be.
  void push_back(Stamp stamp, const Sample& sample, Stamp keep) {
    if (size_ == capacity_) grow(keep);
    const std::size_t at = slot(size_);
    stamps_[at] = stamp;
    samples_[at] = sample;
    ++size_;
    if (size_ < 64 || at % 64 == 0) measure_rate();
  }

  void insert(std::size_t i, Stamp stamp, const Sample& sample, Stamp keep) {
    push_back(stamp, sample, keep);
    for (std::size_t k = size_ - 1; k > i; --k) {
      stamps_[slot(k)] = stamps_[slot(k - 1)];
      samples_[slot(k)] = samples_[slot(k - 1)];
    }
    stamps_[slot(i)] = stamp;
    samples_[slot(i)] = sample;
    measure_rate();
  }

  void pop_front() {
    head_ = slot(1);
    --size_;
  }

  void clear() {
    release();
    stamps_ = nullptr;
    samples_ = nullptr;
    capacity_ = head_ = size_ = 0;
    per_ns_ = 0.0;
  }

  // The last sample at or before `t`; needs oldest() <= t. The place is guessed from the mean rate,
  // so that its cost depends on how regular the stamps are and not on how old `t` is.
  std::size_t last_at_or_before(Stamp t) const {
    const std::size_t last = size_ - 1;
    if (t >= newest()) return last;
    const double back = static_cast<double>(newest() - t) * per_ns_;
    const std::size_t guess =
        back < static_cast<double>(last) ? last - 1 - static_cast<std::size_t>(back) : 0;
    if (stamp(guess) > t) return gallop_down(guess, t);
    return stamp(guess + 1) > t ? guess : gallop_up(guess, t);
  }

  // The same, tried first at `hint` and its successor: for stamps that come in order.
  std::size_t last_at_or_before(Stamp t, std::size_t hint) const {
    if (hint + 2 < size_ && stamp(hint) <= t) {
      if (t < stamp(hint + 1)) return hint;
      if (t < stamp(hint + 2)) return hint + 1;
    }
    return last_at_or_before(t);
  }

 private:
  static constexpr std::size_t kFirstCapacity = 8;

  std::size_t slot(std::size_t i) const {
    const std::size_t at = head_ + i;
    return at < capacity_ ? at : at - capacity_;
  }

  void measure_rate() {
    const Stamp span = newest() - oldest();
    per_ns_ = span > 0 ? static_cast<double>(size_ - 1) / static_cast<double>(span) : 0.0;
  }

  // Both assume stamp(size_ - 1) > t.
  std::size_t gallop_up(std::size_t low, Stamp t) const {
    std::size_t step = 1;
    while (low + step < size_ - 1 && stamp(low + step) <= t) {
      low += step;
      step *= 2;
    }
    return bisect(low, std::min(low + step, size_ - 1), t);
  }

  std::size_t gallop_down(std::size_t high, Stamp t) const {
    std::size_t step = 1;
    while (high > step && stamp(high - step) > t) {
      high -= step;
      step *= 2;
    }
    return bisect(high > step ? high - step : 0, high, t);
  }

  // stamp(low) <= t < stamp(high)
  std::size_t bisect(std::size_t low, std::size_t high, Stamp t) const {
    while (high - low > 1) {
      const std::size_t middle = low + (high - low) / 2;
      (stamp(middle) <= t ? low : high) = middle;
    }
    return low;
  }

  // Doubling, but not beyond what a full cache will hold at the present rate: a full cache has 1/16
  // of slack at most.
  void grow(Stamp keep) {
    std::size_t wanted = std::max(kFirstCapacity, 2 * capacity_);
    if (size_ >= 64 && newest() > oldest()) {
      const double expected = static_cast<double>(size_) * static_cast<double>(keep) /
                              static_cast<double>(newest() - oldest());
      const double fitting =
          std::max(expected * (33.0 / 32.0), static_cast<double>(size_) * (33.0 / 32.0)) + 8.0;
      if (fitting < static_cast<double>(wanted)) wanted = static_cast<std::size_t>(fitting);
    }
    move_to(wanted);
  }

  void move_to(std::size_t wanted) {
    auto* stamps = static_cast<Stamp*>(::operator new(wanted * sizeof(Stamp)));
    Sample* samples;
    try {
      samples = static_cast<Sample*>(
          ::operator new(wanted * sizeof(Sample), std::align_val_t{alignof(Sample)}));
    } catch (...) {
      ::operator delete(stamps);
      throw;
    }
    const std::size_t until_end = std::min(size_, capacity_ - head_);
    std::copy_n(stamps_ + head_, until_end, stamps);
    std::copy_n(stamps_, size_ - until_end, stamps + until_end);
    std::copy_n(samples_ + head_, until_end, samples);
    std::copy_n(samples_, size_ - until_end, samples + until_end);
    release();
    stamps_ = stamps;
    samples_ = samples;
    capacity_ = wanted;
    head_ = 0;
  }

  void release() {
    ::operator delete(stamps_);
    ::operator delete(samples_, std::align_val_t{alignof(Sample)});
  }

  Stamp* stamps_ = nullptr;
  Sample* samples_ = nullptr;
  std::size_t capacity_ = 0;
  std::size_t head_ = 0;
  std::size_t size_ = 0;
  double per_ns_ = 0.0;
};

}  // namespace turtlewire
