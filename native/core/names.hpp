// Names and the small numbers that stand for them: frames and senders.
#pragma once

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace turtlewire {

// Numbers are given in order of arrival, never reused. The strings stay where they are.
class Names {
 public:
  explicit Names(std::string_view zeroth) { intern(zeroth); }

  std::uint32_t size() const { return static_cast<std::uint32_t>(names_.size()); }
  std::string_view operator[](std::uint32_t id) const { return names_[id]; }

  std::optional<std::uint32_t> find(std::string_view name) const {
    const auto it = ids_.find(name);
    if (it == ids_.end()) return std::nullopt;
    return it->second;
  }

  std::uint32_t intern(std::string_view name) {
    if (const auto known = find(name)) return *known;
    names_.push_back(texts_.emplace_back(name));
    return ids_.emplace(names_.back(), size() - 1).first->second;
  }

  // What is called `name`, now or later, is shown as `shown` from now on.
  void rename(std::string_view name, std::string_view shown) {
    names_[intern(name)] = texts_.emplace_back(shown);
  }

 private:
  std::deque<std::string> texts_;  // a deque, because the two below point into it
  std::vector<std::string_view> names_;
  std::unordered_map<std::string_view, std::uint32_t> ids_;
};

// Whether the text can be a frame id: UTF-8, no NUL, not above 4096 bytes.
bool is_frame_name(std::string_view text);

}  // namespace turtlewire
