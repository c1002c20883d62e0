// Names of frames and senders, and their ids, small numbers.
#pragma once

#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

namespace turtlewire {

// Whether two names are equal; without a call for those of 8 to 16 bytes, as most names are.
inline bool same_name(std::string_view a, std::string_view b) {
  if (a.size() != b.size()) return false;
  if (a.size() < 8 || a.size() > 16) return a == b;
  std::uint64_t a_first, a_last, b_first, b_last;
  std::memcpy(&a_first, a.data(), 8);
  std::memcpy(&b_first, b.data(), 8);
  std::memcpy(&a_last, a.data() + a.size() - 8, 8);
  std::memcpy(&b_last, b.data() + b.size() - 8, 8);
  return a_first == b_first && a_last == b_last;
}

// Numbers are given in order of arrival; those of freed names are given again.
class Names {
 public:
  explicit Names(std::string_view zeroth) { intern(zeroth); }

  // All numbers that were ever given are below it.
  std::uint32_t size() const { return static_cast<std::uint32_t>(names_.size()); }
  std::string_view operator[](std::uint32_t id) const { return shown_[id]; }

  std::optional<std::uint32_t> find(std::string_view name) const {
    const auto it = ids_.find(name);
    if (it == ids_.end()) return std::nullopt;
    return it->second;
  }

  std::uint32_t intern(std::string_view name) {
    if (const auto known = find(name)) return *known;
    std::uint32_t id = size();
    if (free_.empty()) {
      shown_.push_back(names_.emplace_back(name));
    } else {
      id = free_.back();
      free_.pop_back();
      shown_[id] = names_[id] = name;
    }
    return ids_.emplace(names_[id], id).first->second;
  }

  // What is called `name`, now or later, is shown as `shown` from now on.
  void rename(std::string_view name, std::string_view shown) {
    shown_[intern(name)] = renamed_.emplace_back(shown);
  }

  // Forgets a name; its number means the empty text until it is reused.
  void free(std::uint32_t id) {
    free_.push_back(id);
    ids_.erase(names_[id]);
    names_[id] = {};
    shown_[id] = {};
  }

 private:
  std::deque<std::string> names_, renamed_;  // deques, because the two below point into them
  std::vector<std::string_view> shown_;
  std::unordered_map<std::string_view, std::uint32_t> ids_;
  std::vector<std::uint32_t> free_;
};

// Whether the text can be a frame id: UTF-8, no NUL, not above 4096 bytes.
bool is_frame_name(std::string_view text);

}  // namespace turtlewire
