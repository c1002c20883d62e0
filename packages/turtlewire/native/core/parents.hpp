// The parents of the samples of one link.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <memory>

namespace turtlewire {

using FrameId = std::uint32_t;  // 0 is "NO_PARENT"

// The parent of each sample. Nearly always all samples have the same one, which is stored once;
// only while they differ, each sample has its own.
class Parents {
 public:
  FrameId operator[](std::size_t i) const { return each_ ? (*each_)[i] : common_; }
  // How often the parent changes from one sample to the next.
  std::size_t changes() const { return changes_; }
  std::size_t bytes() const { return each_ ? size_ * sizeof(FrameId) : 0; }

  // Inserts `count` samples of one parent before sample `i`, or at the end.
  void insert(std::size_t i, std::size_t count, FrameId parent) {
    if (size_ == 0) common_ = parent;
    if (each_ || parent != common_) [[unlikely]]
      insert_each(i, count, parent);
    size_ += count;
  }

  void erase(std::size_t i) {
    if (each_) [[unlikely]]
      erase_each(i);
    --size_;
  }

 private:
  // 1 if the parent changes from the sample before `i` to sample `i`.
  std::size_t change(std::size_t i) const {
    return i > 0 && i < each_->size() && (*each_)[i - 1] != (*each_)[i];
  }

  void insert_each(std::size_t i, std::size_t count, FrameId parent) {
    if (!each_) each_ = std::make_unique<std::deque<FrameId>>(size_, common_);
    const std::size_t before = change(i);
    each_->insert(each_->begin() + static_cast<std::ptrdiff_t>(i), count, parent);
    changes_ += change(i) + change(i + count) - before;
  }

  void erase_each(std::size_t i) {
    const std::size_t before = change(i) + change(i + 1);
    each_->erase(each_->begin() + static_cast<std::ptrdiff_t>(i));
    changes_ -= before - change(i);
    if (changes_ > 0) return;
    common_ = each_->front();
    each_.reset();
  }

  std::size_t size_ = 0;
  std::size_t changes_ = 0;
  FrameId common_ = 0;
  std::unique_ptr<std::deque<FrameId>> each_;
};

}  // namespace turtlewire
