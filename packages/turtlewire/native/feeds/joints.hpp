// From the bytes of JointStates to those of TFMessages, for joints that were worked out before.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <unordered_map>
#include <vector>

#include "../core/fork.hpp"
#include "backlog.hpp"
#include "middleware.hpp"

namespace turtlewire {

// One joint: its transform is made of its position, which is factor * positions[source] + offset.
struct JointFrame {
  // Translation at 0 (3), its change by the position (3), the quaternion that cos(position / 2)
  // multiplies (4), the one that sin(position / 2) multiplies (4), 1 if the joint turns, else 0.
  std::array<double, 15> constants;
  std::size_t source;
  double factor, offset;
  std::size_t stamp_at, pose_at;  // where its stamp and its seven numbers are in the message
};

class JointFrames {
 public:
  static constexpr std::size_t kStampAt = 4;  // in a JointState

  // `message` is a TFMessage whose stamps and poses are rewritten each time. Throws
  // std::invalid_argument if they do not lie within it.
  JointFrames(std::vector<unsigned char> message, std::vector<JointFrame> joints);

  std::size_t size() const { return message_.size(); }
  // Writes size() bytes. `positions` is where the first position is in the JointState. False if the
  // JointState ends before the last position.
  bool write(std::span<const unsigned char> joint_state, std::size_t positions,
             unsigned char* out) const;

 private:
  std::vector<unsigned char> message_;
  std::vector<JointFrame> joints_;
  std::size_t sources_ = 0;  // how many positions a JointState must have
};

// Answers JointStates on the thread that receives them, and keeps back those that need Python.
//
// Python handles JointStates with names that are not known yet, malformed ones, those that find the
// clock set back, those whose skipping is worth a log line, and those whose answer cannot be sent
// at once. It asks for the same stamps, and reports the stamps of its own answers. The order of all
// messages is kept: until Python has found nothing left to take, further messages are kept back as
// well.
class JointRelay final : public ForkAware {
 public:
  using Nanoseconds = std::int64_t;
  static constexpr std::size_t kHeadAt = 12;  // behind the encapsulation and the stamp

  // JointStates with the same frame_id, names and number of positions.
  struct Layout {
    std::vector<unsigned char> head;  // their bytes from kHeadAt on, up to that number
    std::size_t positions, end;       // where the first position is, and where the last one ends
    JointFrames frames;
    std::vector<std::string> names;
    bool moves;  // whether a joint of the robot is among the names
  };
  struct Rules {
    Nanoseconds interval = 0;  // by which stamps must advance
    bool ignores_stamps = false;
    bool tells_of_skipping = true;  // Python wants to see what is skipped
  };

  // The outlet must not block, for the receiving thread would block. At most `most_kept` messages
  // are kept back, the newest ones.
  JointRelay(Outlet& outlet, std::size_t most_kept) : outlet_(outlet), backlog_(most_kept) {}

  // Answers or skips a message, or keeps it back. True if Python is to be woken, which was not told
  // to come before.
  bool receive(std::uint64_t publisher, Nanoseconds sent, std::span<const unsigned char> bytes);
  // For Python, which repeats it until there is nothing: the next message that was kept back.
  std::optional<WaitingMessage> take();

  void set_rules(Rules rules);
  // The time of a simulated clock; nothing: the system's time counts.
  void set_time(std::optional<Nanoseconds> now);
  // Answer such messages from now on; Python is done with the one that it took, which was such.
  void add_layout(Layout layout);
  void forget_layouts();

  // The smallest stamp of these joints, 0 for a new one; `now` if all are later.
  Nanoseconds earliest(const std::vector<std::string>& names, Nanoseconds now);
  // Python published a message of these joints.
  void published(const std::vector<std::string>& names, Nanoseconds stamp);
  // Notes the time of a message; whether it is before that of the last one.
  bool moved_back(Nanoseconds now);
  void forget_stamps();

  // How many messages were answered or skipped without Python.
  std::uint64_t relayed();

  void before_fork() override { mutex_.lock(); }
  void after_fork(bool) noexcept override { mutex_.unlock(); }

 private:
  static constexpr std::size_t kMostLayouts = 64, kMostNames = 10'000;
  struct Known {
    Layout layout;
    std::vector<std::size_t> joints;  // where their stamps are
  };

  bool relay(std::span<const unsigned char> bytes);
  Known* layout_of(std::span<const unsigned char> bytes);
  std::vector<std::size_t> joints_of(const std::vector<std::string>& names);
  Nanoseconds earliest(const std::vector<std::size_t>& joints, Nanoseconds now) const;

  Outlet& outlet_;
  std::mutex mutex_;  // guards all that follows
  Rules rules_;
  std::optional<Nanoseconds> time_;
  Nanoseconds last_call_ = 0;
  std::deque<Known> layouts_;
  std::unordered_map<std::string, std::size_t> joints_;
  std::vector<Nanoseconds> stamps_;  // when each was published last
  std::vector<unsigned char> message_;
  Backlog backlog_;
  std::uint64_t relayed_ = 0;
  const ForkRegistration registration_{*this, Order::outer};
};

}  // namespace turtlewire
