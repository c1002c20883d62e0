#include "joints.hpp"

#include <algorithm>
#include <bit>
#include <chrono>
#include <cmath>
#include <cstring>
#include <stdexcept>
#include <utility>

namespace turtlewire {
namespace {

static_assert(std::endian::native == std::endian::little, "CDR is copied as it is");

constexpr std::size_t kStampSize = 8, kPose = 7;

void write_pose(const std::array<double, 15>& c, double position, unsigned char* out) {
  const double half = 0.5 * position * c[14];
  const double cosine = std::cos(half), sine = std::sin(half);
  double pose[kPose];
  for (std::size_t i = 0; i < 3; ++i) pose[i] = c[i] + position * c[3 + i];
  for (std::size_t i = 0; i < 4; ++i) pose[3 + i] = cosine * c[6 + i] + sine * c[10 + i];
  std::memcpy(out, pose, sizeof pose);
}

JointRelay::Nanoseconds system_time() {
  const auto now = std::chrono::system_clock::now().time_since_epoch();
  return std::chrono::duration_cast<std::chrono::nanoseconds>(now).count();
}

JointRelay::Nanoseconds stamp_of(std::span<const unsigned char> bytes) {
  std::int32_t seconds;
  std::uint32_t nanoseconds;
  std::memcpy(&seconds, bytes.data() + JointFrames::kStampAt, sizeof seconds);
  std::memcpy(&nanoseconds, bytes.data() + JointFrames::kStampAt + 4, sizeof nanoseconds);
  return JointRelay::Nanoseconds{seconds} * 1'000'000'000 + nanoseconds;
}

}  // namespace

JointFrames::JointFrames(std::vector<unsigned char> message, std::vector<JointFrame> joints)
    : message_(std::move(message)), joints_(std::move(joints)) {
  const auto within = [this](std::size_t at, std::size_t size) {
    return size <= message_.size() && at <= message_.size() - size;
  };
  for (const JointFrame& joint : joints_) {
    if (!within(joint.stamp_at, kStampSize) || !within(joint.pose_at, kPose * sizeof(double)))
      throw std::invalid_argument("a stamp or a pose lies outside of the message");
    sources_ = std::max(sources_, joint.source + 1);
  }
}

bool JointFrames::write(std::span<const unsigned char> joint_state, std::size_t positions,
                        unsigned char* out) const {
  const std::size_t size = joint_state.size();
  if (size < kStampAt + kStampSize || positions > size ||
      (size - positions) / sizeof(double) < sources_)
    return false;
  std::memcpy(out, message_.data(), message_.size());
  for (const JointFrame& joint : joints_) {
    double given;
    std::memcpy(&given, joint_state.data() + positions + joint.source * sizeof given, sizeof given);
    std::memcpy(out + joint.stamp_at, joint_state.data() + kStampAt, kStampSize);
    write_pose(joint.constants, joint.factor * given + joint.offset, out + joint.pose_at);
  }
  return true;
}

bool JointRelay::receive(std::uint64_t publisher, Nanoseconds sent,
                         std::span<const unsigned char> bytes) {
  const std::scoped_lock lock(mutex_);
  if (backlog_.must_wait() || !relay(bytes)) {
    backlog_.add(publisher, sent, bytes);
  } else {
    ++relayed_;
  }
  return !backlog_.empty() && backlog_.call_python();
}

// Call with the lock held. False if the message needs Python; then nothing has changed.
bool JointRelay::relay(std::span<const unsigned char> bytes) {
  const Known* known = layout_of(bytes);
  if (known == nullptr) return false;
  const Nanoseconds now = time_ ? *time_ : system_time(), stamp = stamp_of(bytes);
  if (now < last_call_) return false;
  if (!rules_.ignores_stamps && stamp < earliest(known->joints, now) + rules_.interval) {
    if (rules_.tells_of_skipping && known->layout.moves) return false;
  } else {
    message_.resize(known->layout.frames.size());
    if (!known->layout.frames.write(bytes, known->layout.positions, message_.data())) return false;
    if (outlet_.send(message_) < 0) return false;
    for (const std::size_t joint : known->joints) stamps_[joint] = stamp;
  }
  last_call_ = now;
  return true;
}

std::optional<WaitingMessage> JointRelay::take() {
  const std::scoped_lock lock(mutex_);
  backlog_.python_came();
  backlog_.python_is_busy(!backlog_.empty());
  if (backlog_.empty()) return std::nullopt;
  return backlog_.take_front();
}

void JointRelay::set_rules(Rules rules) {
  const std::scoped_lock lock(mutex_);
  rules_ = rules;
}

void JointRelay::set_time(std::optional<Nanoseconds> now) {
  const std::scoped_lock lock(mutex_);
  time_ = now;
}

void JointRelay::add_layout(Layout layout) {
  const std::scoped_lock lock(mutex_);
  std::vector<std::size_t> joints = joints_of(layout.names);
  std::erase_if(layouts_, [&](const Known& known) { return known.layout.head == layout.head; });
  if (layouts_.size() >= kMostLayouts) layouts_.pop_back();
  layouts_.push_front({std::move(layout), std::move(joints)});
  backlog_.python_is_busy(false);
}

void JointRelay::forget_layouts() {
  const std::scoped_lock lock(mutex_);
  layouts_.clear();
}

// Call with the lock held. The layout goes to the front, where the next message finds it first.
JointRelay::Known* JointRelay::layout_of(std::span<const unsigned char> bytes) {
  if (bytes.size() < kHeadAt || bytes[0] != 0 || bytes[1] != 1) return nullptr;
  const auto rest = bytes.subspan(kHeadAt);
  const auto fits = [&](const Known& known) {
    const auto& head = known.layout.head;
    return bytes.size() >= known.layout.end && rest.size() >= head.size() &&
           std::memcmp(rest.data(), head.data(), head.size()) == 0;
  };
  const auto found = std::find_if(layouts_.begin(), layouts_.end(), fits);
  if (found == layouts_.end()) return nullptr;
  std::rotate(layouts_.begin(), found, found + 1);
  return &layouts_.front();
}

// Call with the lock held. Where the stamps of joints are; a new joint gets 0.
std::vector<std::size_t> JointRelay::joints_of(const std::vector<std::string>& names) {
  if (joints_.size() > kMostNames) {  // publishers invent names
    layouts_.clear();
    joints_.clear();
    stamps_.clear();
  }
  std::vector<std::size_t> joints;
  for (const std::string& name : names) {
    const auto [place, is_new] = joints_.try_emplace(name, stamps_.size());
    if (is_new) stamps_.push_back(0);
    joints.push_back(place->second);
  }
  return joints;
}

// Call with the lock held.
JointRelay::Nanoseconds JointRelay::earliest(const std::vector<std::size_t>& joints,
                                             Nanoseconds now) const {
  for (const std::size_t joint : joints) now = std::min(now, stamps_[joint]);
  return now;
}

JointRelay::Nanoseconds JointRelay::earliest(const std::vector<std::string>& names,
                                             Nanoseconds now) {
  const std::scoped_lock lock(mutex_);
  return earliest(joints_of(names), now);
}

void JointRelay::published(const std::vector<std::string>& names, Nanoseconds stamp) {
  const std::scoped_lock lock(mutex_);
  for (const std::size_t joint : joints_of(names)) stamps_[joint] = stamp;
}

bool JointRelay::moved_back(Nanoseconds now) {
  const std::scoped_lock lock(mutex_);
  return now < std::exchange(last_call_, now);
}

void JointRelay::forget_stamps() {
  const std::scoped_lock lock(mutex_);
  std::fill(stamps_.begin(), stamps_.end(), 0);
}

std::uint64_t JointRelay::relayed() {
  const std::scoped_lock lock(mutex_);
  return relayed_;
}

}  // namespace turtlewire
