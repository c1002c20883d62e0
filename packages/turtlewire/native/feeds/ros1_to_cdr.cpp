#include "ros1_to_cdr.hpp"

#include <algorithm>

#include "bag_records.hpp"

namespace turtlewire {
namespace {

using Bytes = std::span<const unsigned char>;

class Conversion {
 public:
  Conversion(Bytes message, std::vector<unsigned char>& cdr) : rest_(message), cdr_(cdr) {
    cdr_.reserve(message.size() + message.size() / 8 + 64);
    cdr_.assign({0, 1, 0, 0});
  }

  bool run(std::span<const ConversionStep> steps) {
    for (std::size_t i = 0; i < steps.size(); ++i) {
      const ConversionStep& step = steps[i];
      if (step.kind != ConversionStep::Kind::kLoop && step.kind != ConversionStep::Kind::kRepeat) {
        if (!take(step)) return false;
        continue;
      }
      std::uint32_t count = step.size;
      if (step.kind == ConversionStep::Kind::kLoop && !take_count(count)) return false;
      const auto body = steps.subspan(i + 1, step.body);
      for (; count > 0; --count)
        if (!run(body)) return false;
      i += step.body;
    }
    return true;
  }

  bool is_finished() const { return rest_.empty(); }

 private:
  bool take(const ConversionStep& step) {
    switch (step.kind) {
      case ConversionStep::Kind::kNumbers:
        return take_numbers(step.size, step.align);
      case ConversionStep::Kind::kBooleans:
        return std::ranges::all_of(rest_.first(std::min<std::size_t>(step.size, rest_.size())),
                                   [](unsigned char flag) { return flag < 2; }) &&
               take_numbers(step.size, 1);
      case ConversionStep::Kind::kSkip:
        if (step.size > rest_.size()) return false;
        rest_ = rest_.subspan(step.size);
        return true;
      case ConversionStep::Kind::kText:
      case ConversionStep::Kind::kFrame:
        return take_text(step.kind == ConversionStep::Kind::kFrame);
      case ConversionStep::Kind::kSequence: {
        std::uint32_t count = 0;
        return take_count(count) &&
               (count == 0 || take_numbers(std::size_t{count} * step.size, step.align));
      }
      case ConversionStep::Kind::kZeros:
        align(step.align);
        cdr_.insert(cdr_.end(), step.size, 0);
        return true;
      case ConversionStep::Kind::kEmptyText:
        write_text({});
        return true;
      default:
        return false;
    }
  }

  void align(std::size_t size) { cdr_.resize(cdr_.size() + (4 - cdr_.size()) % size); }

  bool take_numbers(std::size_t size, std::size_t alignment) {
    if (size > rest_.size()) return false;
    align(alignment);
    cdr_.insert(cdr_.end(), rest_.begin(), rest_.begin() + static_cast<std::ptrdiff_t>(size));
    rest_ = rest_.subspan(size);
    return true;
  }

  // A count of elements, of which none has less than no byte: more than there are bytes is wrong.
  bool take_count(std::uint32_t& count) {
    if (rest_.size() < 4) return false;
    count = little<std::uint32_t>(rest_.data());
    return count <= rest_.size() && take_numbers(4, 4);
  }

  bool take_text(bool is_frame) {
    if (rest_.size() < 4) return false;
    const std::size_t size = little<std::uint32_t>(rest_.data());
    if (size > rest_.size() - 4) return false;
    Bytes text = rest_.subspan(4, size);
    rest_ = rest_.subspan(4 + size);
    if (std::ranges::any_of(text, [](unsigned char byte) { return byte >= 0x80; })) return false;
    while (is_frame && !text.empty() && text.front() == '/') text = text.subspan(1);
    write_text(text);
    return true;
  }

  void write_text(Bytes text) {
    align(4);
    const auto size = static_cast<std::uint32_t>(text.size() + 1);
    for (int shift = 0; shift < 32; shift += 8)
      cdr_.push_back(static_cast<unsigned char>(size >> shift));
    cdr_.insert(cdr_.end(), text.begin(), text.end());
    cdr_.push_back(0);
  }

  Bytes rest_;
  std::vector<unsigned char>& cdr_;
};

}  // namespace

bool Ros1ToCdr::convert(std::span<const unsigned char> message,
                        std::vector<unsigned char>& cdr) const {
  Conversion conversion(message, cdr);
  return conversion.run(steps_) && conversion.is_finished();
}

}  // namespace turtlewire
