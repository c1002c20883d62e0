#include "first_requests.hpp"

#include <algorithm>
#include <cstddef>
#include <cstring>
#include <exception>
#include <initializer_list>

#if defined(__linux__)
#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>
#endif

namespace turtlewire::cyclone {
namespace {

using namespace std::chrono_literals;

constexpr std::size_t kPrefix = 12, kEntityId = 4;
constexpr std::array<unsigned char, 2> kFastDds = {0x01, 0x0f};
// When the heartbeats are sent. Cyclone calls the listener before it connects the writer with the
// reader, and drops what arrives in between, so they are repeated. Repetitions have the same count,
// which makes Cyclone ignore them once it has taken one.
constexpr std::array<std::chrono::milliseconds, 4> kDelays{{0ms, 1ms, 3ms, 9ms}};
constexpr unsigned char kHeartbeat = 0x07, kIsLittleEndian = 1, kHeartbeatSize = 28;

class Packet {
 public:
  void add(const void* bytes, std::size_t size) {
    std::memcpy(bytes_.data() + size_, bytes, size);
    size_ += size;
  }
  // In little endian, whatever this machine has.
  void add_number(std::uint32_t number) {
    for (int shift = 0; shift < 32; shift += 8)
      bytes_[size_++] = static_cast<unsigned char>(number >> shift);
  }
  void add_bytes(std::initializer_list<unsigned char> bytes) { add(bytes.begin(), bytes.size()); }

  const unsigned char* data() const { return bytes_.data(); }
  std::size_t size() const { return size_; }

 private:
  std::array<unsigned char, 128> bytes_;
  std::size_t size_ = 0;
};

// The first heartbeat lists no sample, the second lists one, which Cyclone then requests.
Packet heartbeats(const FirstRequests::Guid& writer, const FirstRequests::Guid& reader) {
  Packet made;
  made.add("RTPS", 4);
  made.add_bytes({2, 1});
  made.add(kFastDds.data(), kFastDds.size());
  made.add(writer.data(), kPrefix);
  for (const std::uint32_t last : {0U, 1U}) {
    made.add_bytes({kHeartbeat, kIsLittleEndian, kHeartbeatSize, 0});
    made.add(reader.data() + kPrefix, kEntityId);
    made.add(writer.data() + kPrefix, kEntityId);
    // The first and the last number, of which the high half comes first, and a count.
    for (const std::uint32_t number : {0U, 1U, 0U, last, last}) made.add_number(number);
  }
  return made;
}

long process_id() {
#if defined(__linux__)
  return getpid();
#else
  return 0;
#endif
}

}  // namespace

FirstRequests::FirstRequests(const Functions& at, const Guid& reader, Targets targets)
    : endpoint_of_(reinterpret_cast<decltype(endpoint_of_)>(at[0])),
      free_endpoint_(reinterpret_cast<decltype(free_endpoint_)>(at[1])),
      reader_(reader),
      targets_(std::move(targets)),
      process_(process_id()) {}

FirstRequests::~FirstRequests() {
  close();
#if defined(__linux__)
  if (socket_ >= 0) ::close(socket_);
#endif
}

void FirstRequests::ask(const Guid& writer) {
  if (!std::equal(kFastDds.begin(), kFastDds.end(), writer.begin())) return;
  const Clock::time_point now = Clock::now();
  const std::lock_guard lock(mutex_);
  if (closed_) return;
  for (const auto delay : kDelays) due_.emplace(now + delay, writer);
  if (!sender_.joinable()) start();
  changed_.notify_one();
}

// Call with the lock held. Most servers have no client on Fast DDS, and need no socket.
void FirstRequests::start() {
#if defined(__linux__)
  if (socket_ < 0) socket_ = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
#endif
  sender_ = std::thread(&FirstRequests::send_when_due, this);
}

void FirstRequests::send_when_due() {
  std::unique_lock lock(mutex_);
  while (!closed_) {
    if (due_.empty()) {
      changed_.wait(lock);
    } else if (const auto next = due_.begin(); next->first > Clock::now()) {
      const Clock::time_point when = next->first;  // another thread may add one
      changed_.wait_until(lock, when);
    } else {
      const Guid writer = next->second;
      due_.erase(next);
      lock.unlock();
      send(writer);
      lock.lock();
    }
  }
}

void FirstRequests::send(const Guid& writer) const noexcept {
#if defined(__linux__)
  const Packet datagram = heartbeats(writer, reader_);
  for (const auto& [address, port] : targets_) {
    sockaddr_in to = {};
    to.sin_family = AF_INET;
    to.sin_port = htons(port);
    to.sin_addr.s_addr = htonl(address);
    // Like any datagram it may be lost; so may the request.
    sendto(socket_, datagram.data(), datagram.size(), MSG_DONTWAIT,
           reinterpret_cast<const sockaddr*>(&to), sizeof to);
  }
#else
  static_cast<void>(writer);
#endif
}

void FirstRequests::close() noexcept {
  if (process_id() != process_) {
    if (sender_.joinable()) sender_.detach();
    return;
  }
  {
    const std::lock_guard lock(mutex_);
    closed_ = true;
  }
  changed_.notify_one();
  if (sender_.joinable()) sender_.join();
}

void FirstRequests::on_matched(Entity reader, MatchedStatus status, void* self) noexcept try {
  auto& requests = *static_cast<FirstRequests*>(self);
  void* const endpoint = requests.endpoint_of_(reader, status.publisher);
  if (endpoint == nullptr) return;  // it has left
  Guid writer;
  std::memcpy(writer.data(), endpoint, writer.size());  // the first member is the key
  requests.free_endpoint_(endpoint);
  requests.ask(writer);
} catch (const std::exception&) {
  return;  // without memory or a thread, the first request may be lost
}

}  // namespace turtlewire::cyclone
