// Requests that clients on Fast DDS send before Cyclone expects them.
#pragma once

#include <array>
#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <map>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

#include "library.hpp"
#include "service_identity.hpp"

namespace turtlewire::cyclone {

// dds_subscription_matched_status_t
struct MatchedStatus {
  std::uint32_t total;
  std::int32_t total_change;
  std::uint32_t current;
  std::int32_t current_change;
  std::uint64_t publisher;
};

// Asks each new client of one server for its first request, with heartbeats in the client's name.
// A separate thread sends them; it and its socket begin with the first client on Fast DDS.
class FirstRequests {
 public:
  using Guid = decltype(Identity::guid);
  // Of dds_get_matched_publication_data and dds_builtintopic_free_endpoint.
  using Functions = std::array<std::uintptr_t, 2>;
  // The addresses (IPv4, as numbers) and ports at which Cyclone receives.
  using Targets = std::vector<std::pair<std::uint32_t, std::uint16_t>>;

  // `reader` reads the requests.
  FirstRequests(const Functions& at, const Guid& reader, Targets targets);
  FirstRequests(const FirstRequests&) = delete;
  FirstRequests& operator=(const FirstRequests&) = delete;
  ~FirstRequests();

  // Asks no more clients, and joins the thread. Not on the thread of a listener.
  void close() noexcept;

  // The dds_on_subscription_matched_fn, on the thread that discovered the client. It does not take
  // the GIL: the client's own heartbeat comes within milliseconds.
  static void on_matched(Entity reader, MatchedStatus status, void* self) noexcept;

 private:
  using Clock = std::chrono::steady_clock;

  // Asks a client, unless the writer of requests is not one on Fast DDS.
  void ask(const Guid& writer);
  void start();
  void send_when_due();
  void send(const Guid& writer) const noexcept;

  void* (*endpoint_of_)(Entity reader, std::uint64_t publisher);
  void (*free_endpoint_)(void* endpoint);
  Guid reader_;
  Targets targets_;
  int socket_ = -1;
  long process_;  // a forked child has no thread to join
  std::mutex mutex_;
  std::condition_variable changed_;
  std::multimap<Clock::time_point, Guid> due_;
  bool closed_ = false;
  std::thread sender_;
};

}  // namespace turtlewire::cyclone
