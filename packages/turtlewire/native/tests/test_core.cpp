// Tests of the core for itself: run plain, and under the address, undefined-behaviour and thread
// sanitizers. test_core [number of mutated messages]
#include <atomic>
#include <cmath>
#include <condition_variable>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "../core/batch.hpp"
#include "../core/shared_buffer.hpp"
#include "../feeds/intake.hpp"
#include "../feeds/joints.hpp"
#include "../feeds/record_walk.hpp"
#include "../feeds/tf_message.hpp"

namespace {

using namespace turtlewire;

void check(bool truth, const std::string& what) {
  if (truth) return;
  std::fprintf(stderr, "failed: %s\n", what.c_str());
  std::exit(1);
}

using Random = std::mt19937_64;

double uniform(Random& random, double low, double high) {
  return std::uniform_real_distribution<double>(low, high)(random);
}
std::size_t below(Random& random, std::size_t n) { return random() % n; }

Pose random_pose(Random& random) {
  return {{uniform(random, -5, 5), uniform(random, -5, 5), uniform(random, -5, 5)},
          {uniform(random, -1, 1), uniform(random, -1, 1), uniform(random, -1, 1),
           uniform(random, -1, 1)}};
}

// ---------------------------------------------------------------- arithmetic

// The weights against the formula in long double, over all angles and places.
void test_slerp_weights() {
  Random random(1);
  double worst = 0.0;
  for (int i = 0; i < 400'000; ++i) {
    const long double angle = std::pow(10.0L, static_cast<long double>(uniform(random, -8, 0.19)));
    if (angle > 1.55L) continue;
    const double cosine = static_cast<double>(std::cos(angle));
    const long double exact_angle = std::acos(static_cast<long double>(cosine));
    if (exact_angle == 0.0L) continue;
    const double u = uniform(random, 0, 1);
    const auto [older, newer] = arc_weights(cosine, u);
    const long double sine = std::sin(exact_angle);
    worst = std::max(
        worst, static_cast<double>(std::fabs(std::sin((1.0L - u) * exact_angle) / sine - older)));
    worst =
        std::max(worst, static_cast<double>(std::fabs(std::sin(u * exact_angle) / sine - newer)));
  }
  std::printf("slerp weights: largest error %.2g\n", worst);
  check(worst <= 1e-15, "slerp weights are within 1e-15");
}

void test_canonical() {
  Random random(2);
  for (int i = 0; i < 200'000; ++i) {
    const Quat q = random_pose(random).rotation;
    const Quat a = through_matrix(q), b = canonical(a);
    const Quat doubled{2 * q.x, 2 * q.y, 2 * q.z, 2 * q.w};
    check(canonical(doubled) == canonical(q), "2q is stored as q is");
    check(canonical({-q.x, -q.y, -q.z, -q.w}) == canonical(q), "-q is stored as q is");
    check(std::fabs(dot(a, b)) > 1.0 - 1e-14, "canonical is the same rotation");
    check(std::fabs(dot(b, b) - 1.0) < 1e-15, "canonical is unit");
  }
  check(canonical({0, 0, 0, 1e200}) == Quat{},
        "an overflowing length gives the identity, as in tf2");
  check(has_nan(canonical({0, 0, 0, 0})), "a zero quaternion gives NaN");
}

void test_kernels_agree() {
  Random random(3);
  Lanes a, b, plain, result;
  double ratio[kLanes], cosine[kLanes];
  for (int round = 0; round < 200; ++round) {
    for (std::size_t i = 0; i < kLanes; ++i) {
      Pose p = random_pose(random);
      p.rotation = canonical(p.rotation);
      Pose q = p;
      q.rotation.x += uniform(random, -1e-3, 1e-3);
      q.rotation = canonical(q.rotation);
      a.set(i, p);
      b.set(i, q);
      ratio[i] = uniform(random, 0, 1);
    }
    for (const Kernels* kernels : all_kernels()) {
      kernels->interpolate(a, b, ratio, result, cosine);
      kernels->compose(a, result);
      kernels->between(b, result);
      kernels->canonicalize(result);
      if (kernels == all_kernels().front()) plain = result;
      for (std::size_t k = 0; k < 7; ++k) {
        for (std::size_t i = 0; i < kLanes; ++i) {
          check(std::fabs(result.v[k][i] - plain.v[k][i]) < 1e-12,
                std::string(kernels->name) + " equals plain");
        }
      }
    }
  }
}

// ---------------------------------------------------------------- the buffer

// `alone`: nobody else changes the buffer meanwhile, so answers can be compared.
void ask_everything(SharedBuffer& shared, Random& random, std::size_t frames, bool alone) {
  const std::string target = "f" + std::to_string(below(random, frames)),
                    source = "f" + std::to_string(below(random, frames));
  std::vector<Stamp> stamps(1 + below(random, 100));
  for (Stamp& t : stamps) t = static_cast<Stamp>(below(random, 2000));
  Lanes poses;
  Status statuses[kLanes];
  BatchLookup batch(shared, target, source);
  for (std::size_t begin = 0; begin < stamps.size(); begin += kLanes) {
    const std::size_t n = std::min(kLanes, stamps.size() - begin);
    batch.block({stamps.data() + begin, n}, poses, statuses);
    for (std::size_t i = 0; i < n; ++i) {
      Found found;
      Failure failure;
      const Status status =
          shared.lookup(Request{target, source, stamps[begin + i]}, found, failure);
      const Status can = shared.can_transform(Request{target, source, stamps[begin + i]}, failure);
      if (!alone) continue;
      check(status == statuses[i], "a batch says what a single lookup says");
      if (status == Status::ok && is_finite(found.target_from_source.translation)) {
        const Vec3 gap = found.target_from_source.translation - poses.pose(i).translation;
        check(std::fabs(gap.x) + std::fabs(gap.y) + std::fabs(gap.z) < 1e-9,
              "a batch gives what a single lookup gives");
      }
      check((status == Status::ok) == (can == Status::ok), "can_transform says what lookup does");
    }
  }
}

void test_random_operations() {
  for (unsigned seed = 0; seed < 60; ++seed) {
    Random random(seed);
    SharedBuffer shared(static_cast<Stamp>(below(random, 3) == 0 ? 100 : 1000));
    const std::size_t frames = 1 + below(random, 12);
    for (int i = 0; i < 300; ++i) {
      const std::string parent = "f" + std::to_string(below(random, frames)),
                        child = "f" + std::to_string(below(random, frames));
      const std::size_t kind = below(random, 100);
      if (kind < 80) {
        Pose pose = random_pose(random);
        if (kind == 0) pose.translation.x = INFINITY;
        if (kind == 1) pose.rotation.w = NAN;
        const Stamp stamp = static_cast<Stamp>(below(random, 2) ? i * 5 : below(random, 1500));
        const SharedBuffer::Access access(shared);
        access->set(parent, child, stamp, pose, access->sender(kind % 2 ? "x" : "y"),
                    kind % 10 == 0);
      } else if (kind < 95) {
        ask_everything(shared, random, frames, true);
      } else if (kind < 97) {
        SharedBuffer::Access(shared)->clear();
      } else {
        FrameId id = 0;
        const SharedBuffer::Access access(shared);
        if (access->resolve(child, id) == Status::ok) access->remove({&id, 1});
      }
      const std::string fault = SharedBuffer::Access(shared)->fault();
      check(fault.empty(), "invariants: " + fault);
    }
  }
}

void test_search() {
  Random random(5);
  for (int round = 0; round < 300; ++round) {
    Arena arena;
    Samples samples(arena);
    Stamp t = 0;
    std::vector<Stamp> known;
    for (std::size_t i = 0, n = 2 + below(random, 500); i < n; ++i) {
      t += static_cast<Stamp>(below(random, 4) == 0 ? below(random, 1000) : 10);
      samples.push_back({.stamp = t}, 1);
      known.push_back(t);
      if (below(random, 3) == 0 && known.size() > 2) {
        samples.pop_front();
        known.erase(known.begin());
      }
      if (below(random, 8) == 0) {
        const Stamp late =
            known.front() +
            static_cast<Stamp>(below(random, static_cast<std::size_t>(t - known.front() + 1)));
        const auto place = std::upper_bound(known.begin(), known.end(), late);
        samples.insert(static_cast<std::size_t>(place - known.begin()), {.stamp = late}, 1);
        known.insert(place, late);
      }
    }
    for (Stamp at = known.front(); at <= known.back() + 3; ++at) {
      const auto after = std::upper_bound(known.begin(), known.end(), at);
      const auto expected = static_cast<std::size_t>(after - known.begin()) - 1;
      check(samples.last_at_or_before(at) == expected, "search");
      check(samples.last_at_or_before(at, below(random, known.size())) == expected,
            "search with a hint");
    }
  }
}

// The time between two stamps may be twice what a stamp can hold.
void test_far_stamps() {
  constexpr Stamp first = kLatest + 1, last = kForever;
  for (const std::size_t size : {2U, 3U, 40U, 100U}) {
    Arena arena;
    Link link(arena);
    link.become(LinkKind::dynamic_link);
    for (std::size_t i = 0; i + 1 < size; ++i)
      link.insert({first + static_cast<Stamp>(i), {}}, 1, kForever);
    link.insert({last, {{2, 0, 0}, {}}}, 1, kForever);
    for (const Stamp t : {Stamp{0}, first + 200, last - 1, last}) {
      const double x = t == 0 ? 1.0 : t == first + 200 ? 0.0 : 2.0;
      const Reading reading = link.read(t);
      check(reading.status == ReadStatus::ok && std::fabs(reading.pose.translation.x - x) < 1e-9,
            "stamps at both ends of time");
    }
  }
  Arena arena;
  Link link(arena);
  link.become(LinkKind::dynamic_link);
  for (const Stamp t : {Stamp{0}, last / 2}) link.insert({t, {}}, 1, kForever);
  for (const Stamp t : {first, last}) {
    check(link.read_beyond(t, 1000).status != ReadStatus::ok, "too far to extrapolate");
    check(link.read_beyond(t, kForever).status == ReadStatus::ok, "as far as a stamp can be");
  }
}

void test_parents() {
  Random random(6);
  for (int round = 0; round < 300; ++round) {
    Parents parents;
    std::vector<FrameId> known;
    for (int step = 0; step < 200; ++step) {
      const std::size_t i = below(random, known.size() + 1);
      if (below(random, 3) == 0 && i < known.size()) {
        parents.erase(i);
        known.erase(known.begin() + static_cast<std::ptrdiff_t>(i));
      } else {
        const std::size_t count = 1 + below(random, 3);
        const auto parent = static_cast<FrameId>(1 + below(random, step < 100 ? 3 : 1));
        parents.insert(i, count, parent);
        known.insert(known.begin() + static_cast<std::ptrdiff_t>(i), count, parent);
      }
      if (step == 100) {  // all of one parent again, as after others were dropped
        for (std::size_t k = known.size(); k-- > 0;) {
          if (known[k] == 1) continue;
          parents.erase(k);
          known.erase(known.begin() + static_cast<std::ptrdiff_t>(k));
        }
      }
      std::size_t changes = 0;
      for (std::size_t k = 0; k < known.size(); ++k) {
        check(parents[k] == known[k], "the parent of a sample");
        changes += k > 0 && known[k - 1] != known[k];
      }
      check(parents.changes() == changes, "changes of the parent");
      check((parents.bytes() > 0) == (changes > 0), "one number for one parent");
    }
  }
}

void test_memory() {
  Tree buffer(10'000'000'000);
  const SourceId me = buffer.sender("me");
  for (Stamp i = 1; i <= 25'000; ++i) buffer.set("a", "b", i * 1'000'000, Pose{}, me, false);
  const Samples& samples = buffer.link(1).samples();
  const double bytes = static_cast<double>(samples.bytes()) / static_cast<double>(samples.size());
  std::printf("memory: %.1f bytes a sample in a full cache of %zu\n", bytes, samples.size());
  check(samples.size() == 10'002 || samples.size() == 10'001, "a full cache");
  check(bytes <= 70.0, "70 bytes a sample, slack included");
}

// ---------------------------------------------------------------- threads

class Sleeper final : public Waiter {
 public:
  void wake() noexcept override {
    const std::scoped_lock lock(mutex_);
    awake_ = true;
    woken_.notify_one();
  }
  void sleep() {
    std::unique_lock lock(mutex_);
    woken_.wait(lock, [this] { return awake_; });
    awake_ = false;
  }

 private:
  std::mutex mutex_;
  std::condition_variable woken_;
  bool awake_ = false;
};

void test_threads() {
  SharedBuffer shared(1'000'000);
  constexpr Stamp last = 3000;
  std::atomic<bool> done = false;
  std::vector<std::thread> threads;
  for (int reader = 0; reader < 3; ++reader) {
    threads.emplace_back([&, reader] {
      Random random(static_cast<unsigned>(reader));
      std::vector<FramePose> all;
      while (!done) {
        ask_everything(shared, random, 8, false);
        Failure failure;
        lookup_all(shared, "f1", 0, all, failure);
        const SharedBuffer::Access access(shared);
        check(!access->frames_as_yaml(1.0).empty(), "yaml");
      }
    });
  }
  threads.emplace_back([&] {  // waits for the last sample as a lookup with a timeout does
    Sleeper sleeper;
    const Waiting known(shared, sleeper);
    Found found;
    for (;;) {
      Failure failure;
      if (shared.lookup(Request{"f0", "f3", last}, found, failure) == Status::ok) return;
      sleeper.sleep();
    }
  });
  Random random(9);
  for (Stamp t = 1; t <= last; ++t) {
    const SharedBuffer::Access access(shared);
    const SourceId me = access->sender("me");
    access->set("f0", "f1", t, random_pose(random), me, false);
    access->set("f1", "f2", 0, Pose{}, me, true);
    access->set(t % 100 < 50 ? "f2" : "f1", "f3", t, random_pose(random), me, false);
    access.wake_waiters();
  }
  threads.back().join();
  threads.pop_back();
  done = true;
  for (std::thread& thread : threads) thread.join();
}

// ---------------------------------------------------------------- bytes

class Message {
 public:
  explicit Message(std::uint32_t count) {
    put(std::uint32_t{0x00000100});
    put(count);
  }
  void add(std::int32_t sec, const std::string& parent, const std::string& child,
           const Pose& pose) {
    align(4);
    put(sec);
    put(std::uint32_t{5});
    text(parent);
    text(child);
    align(8);
    put(pose);
  }
  std::vector<unsigned char> bytes;

 private:
  template <typename T>
  void put(const T& value) {
    const auto* p = reinterpret_cast<const unsigned char*>(&value);
    for (std::size_t i = 0; i < sizeof(T); ++i)
      bytes.push_back(p[i]);  // insert() trips GCC's -Wstringop-overflow
  }
  void align(std::size_t size) {
    while ((bytes.size() - 4) % size != 0) bytes.push_back(0);
  }
  void text(const std::string& value) {
    align(4);
    put(static_cast<std::uint32_t>(value.size() + 1));
    bytes.insert(bytes.end(), value.c_str(), value.c_str() + value.size() + 1);
  }
};

// Takes the bytes as a binding does; from memory of exactly their size, so that a sanitizer sees
// each step too far.
std::size_t ingest(SharedBuffer& shared, const std::vector<unsigned char>& bytes, bool& malformed) {
  static thread_local TfMessage message;
  const std::vector<unsigned char> exact(bytes);
  const std::string fault = message.decode(exact.data(), exact.size());
  malformed = !fault.empty();
  std::size_t accepted = 0;
  const SharedBuffer::Access access(shared);
  const SourceId me = access->sender("me");
  if (malformed) access->refuse_message(fault, me);
  for (const ReceivedTransform& r : message.transforms()) {
    accepted += access->set(r.parent, r.child, r.stamp, r.pose(), me, false) == Verdict::accepted;
  }
  return accepted;
}

std::vector<unsigned char> mutated(std::vector<unsigned char> bytes, Random& random) {
  for (std::size_t n = below(random, 5); n > 0; --n) {
    static constexpr unsigned char nasty[] = {0, 1, 4, 5, 0x7F, 0x80, 0xC0, 0xED, 0xF0, 0xF4, 0xFF};
    bytes[below(random, bytes.size())] = nasty[below(random, sizeof nasty)];
  }
  if (below(random, 3) == 0) bytes.resize(below(random, bytes.size() + 1));
  if (below(random, 20) == 0) bytes.resize(bytes.size() + below(random, 9));
  return bytes;
}

void test_malformed_messages(std::size_t rounds) {
  Random random(11);
  Message small(2), large(10'000), odd(5);
  small.add(1, "map", "base", random_pose(random));
  small.add(2, "base", "camera", random_pose(random));
  for (int i = 0; i < 10'000; ++i) large.add(i, "map", "x" + std::to_string(i), Pose{});
  odd.add(1, std::string(10'000, 'p'), "long", Pose{});
  odd.add(1, "map", "\xff\xfe", Pose{});
  odd.add(1, "map", "nan", Pose{{NAN, 0, 0}, {}});
  odd.add(1, "map", "zero", Pose{{}, {0, 0, 0, 0}});
  odd.add(1, "map", "good", Pose{});
  bool malformed = false;
  SharedBuffer whole(10'000'000'000);
  check(ingest(whole, large.bytes, malformed) == 10'000 && !malformed,
        "10,000 transforms in one message");
  check(ingest(whole, odd.bytes, malformed) == 1 && !malformed,
        "the good one among the odd ones is kept");
  check(SharedBuffer::Access(whole)->refusals().by_child().size() == 4, "each refusal is counted");
  std::size_t rejected = 0, counted = 0;
  auto shared = std::make_unique<SharedBuffer>(10'000'000'000);
  for (std::size_t i = 0; i < rounds; ++i) {
    ingest(*shared, mutated(below(random, 10) != 0 ? small.bytes : odd.bytes, random), malformed);
    rejected += malformed;
    if (i % 10'000 == 9999) {
      const std::string fault = SharedBuffer::Access(*shared)->fault();
      check(fault.empty(), "invariants after mutated messages: " + fault);
      check(ingest(*shared, small.bytes, malformed) <= 2 && !malformed,
            "a good message is taken among bad ones");
      check(!SharedBuffer::Access(*shared)->refusals().malformed().last.empty(),
            "what is malformed is explained");
      counted += SharedBuffer::Access(*shared)->refusals().malformed().count;
      shared = std::make_unique<SharedBuffer>(10'000'000'000);
    }
  }
  std::printf("mutated messages: %zu, of which %zu malformed\n", rounds, rejected);
  counted += SharedBuffer::Access(*shared)->refusals().malformed().count;
  check(rejected > rounds / 10, "many mutations are malformed");
  check(counted == rejected, "each malformed message is counted");
}

// ---------------------------------------------------------------- the chunks of a bag

void append_record(std::vector<unsigned char>& chunk, unsigned char opcode,
                   const std::vector<unsigned char>& content) {
  chunk.push_back(opcode);
  for (int i = 0; i < 8; ++i)
    chunk.push_back(static_cast<unsigned char>(std::uint64_t{content.size()} >> (8 * i)));
  chunk.insert(chunk.end(), content.begin(), content.end());
}

// Channel 1, sequence 0, log time `second`, publish time 0.
void append_message(std::vector<unsigned char>& chunk, std::int32_t second) {
  std::vector<unsigned char> content(22, 0);
  content[0] = 1;
  content[6] = static_cast<unsigned char>(second);
  Message message(1);
  message.add(second, "map", "base", Pose{});
  content.insert(content.end(), message.bytes.begin(), message.bytes.end());
  append_record(chunk, 5, content);
}

void test_record_walk(std::size_t rounds) {
  const std::vector<TfChannel> channels{{1, "/tf", false}};
  std::vector<unsigned char> chunk;
  append_record(chunk, 3, {1, 2, 3});
  for (std::int32_t second : {10, 11, 12, 5, 6}) append_message(chunk, second);
  SharedBuffer whole(kForever);
  RecordWalk walk(6, 12);
  check(walk.walk(whole, chunk, channels) == RecordWalk::kNoDamage, "a whole chunk");
  check(walk.messages() == 4, "the message outside of the window is passed over");
  check(walk.jumps().size() == 1 && walk.jumps()[0].by == 6'000'000'000, "the jump is told");
  const std::size_t end = chunk.size();
  chunk.resize(end - 1);
  check(RecordWalk(0, UINT64_MAX).walk(whole, chunk, channels) < end, "the cut is found");

  Random random(12);
  std::size_t damaged = 0;
  for (std::size_t i = 0; i < rounds; ++i) {
    const std::vector<unsigned char> exact = mutated(chunk, random);  // of exactly their size
    SharedBuffer shared(kForever);
    RecordWalk other(0, UINT64_MAX);
    damaged += other.walk(shared, exact, channels) != RecordWalk::kNoDamage;
    check(other.messages() <= 5, "no message is made up");
  }
  check(damaged > rounds / 10, "damage is found");
}

// ---------------------------------------------------------------- names

void test_same_name() {
  for (std::size_t size = 0; size < 20; ++size) {
    const std::string name(size, 'a');
    check(same_name(name, std::string(size, 'a')), "equal names");
    check(!same_name(name, name + "a"), "names of different lengths");
    for (std::size_t i = 0; i < size; ++i) {
      std::string other = name;
      other[i] = 'b';
      check(!same_name(name, other), "names that differ in one letter");
    }
  }
}

// ---------------------------------------------------------------- the intake

std::vector<unsigned char> message_at(std::int32_t second) {
  Message message(1);
  message.add(second, "map", "base", Pose{});
  return message.bytes;
}

// The stamps of what is kept back, as the reader thread takes it: until there is nothing.
std::vector<Stamp> take_rest(Intake& intake) {
  std::vector<Stamp> sent;
  for (auto kept = intake.take(); !kept.empty(); kept = intake.take()) {
    for (const WaitingMessage& message : kept) sent.push_back(message.sent);
  }
  return sent;
}

void test_intake() {
  SharedBuffer shared(10'000'000'000), other(10'000'000'000);
  Intake intake(false, 3);
  const auto newest = [](SharedBuffer& buffer) {
    FrameId base = 0;
    const SharedBuffer::Access access(buffer);
    return access->resolve("base", base) == Status::ok ? access->link(base).newest() / 1'000'000'000
                                                       : 0;
  };
  intake.feed({&shared, &other});
  check(intake.receive(7, 1, message_at(1)),
        "the reader thread is called for a publisher that is not known");
  check(!intake.receive(7, 2, message_at(2)), "it is called once");
  auto taken = intake.take();
  check(taken.size() == 2 && intake.needs_name(7), "both messages were kept back");
  check(intake.receive(7, 3, message_at(3)), "it is called again while it is busy with them");
  intake.introduce(7, "gid", "/talker");
  check(!intake.receive(7, 4, message_at(4)) && newest(shared) == 0,
        "what comes behind kept messages waits for them");
  check(intake.take(std::move(taken)).empty() && newest(shared) == 4 && !intake.needs_name(7),
        "those taken and those behind are stored when the publisher is known");
  check(intake.receive(8, 4, message_at(4)) && intake.take().size() == 1,
        "the reader thread takes a message");
  check(intake.receive(7, 5, message_at(5)) && newest(shared) == 4,
        "while it is busy with a message, nothing overtakes that");
  check(take_rest(intake).empty() && newest(shared) == 5, "it stores what waited");
  intake.name("another gid", "/new name");
  intake.introduce(9, "another gid", "/old name");
  check(!intake.receive(9, 6, message_at(6)) && newest(shared) == 6, "a second publisher");
  check(SharedBuffer::Access(shared)->sender_name(2) == "/new name",
        "a name told before the introduction counts");
  check(!intake.receive(7, 7, message_at(7)) && newest(shared) == 7, "then it is stored at once");
  check(newest(other) == 7, "in all buffers");
  check(SharedBuffer::Access(shared)->sender_name(1) == "/talker", "in the publisher's name");
  check(intake.receive(7, 8, {}) && take_rest(intake) == std::vector<Stamp>{8},
        "what is malformed is kept back");
  for (Stamp sent = 9; sent < 14; ++sent) intake.receive(8, sent, message_at(9));
  check(take_rest(intake) == std::vector<Stamp>{11, 12, 13}, "only the newest ones are kept back");
  check(!intake.take_news(), "no news while nobody listens");
  SharedBuffer::Access(shared).set_listeners(1);
  check(intake.receive(7, 14, message_at(14)) && intake.take_news() && !intake.take_news(),
        "news for a listener");
  intake.feed({});
  check(intake.receive(7, 15, message_at(15)) && newest(shared) == 14,
        "without buffers all is kept back");
}

// Publishers come, are introduced and named, buffers change and are asked, all at once: nothing is
// lost or comes twice.
void test_intake_threads() {
  constexpr int kMessages = 3000;
  SharedBuffer first(kForever), second(kForever);
  Intake intake(false, 0);
  intake.feed({&first});
  std::atomic<int> senders = 3;
  std::mutex mutex;
  std::condition_variable called;
  bool is_called = false;
  const auto call = [&] {
    const std::scoped_lock lock(mutex);
    is_called = true;
    called.notify_one();
  };
  std::vector<std::thread> threads;
  for (std::uint64_t publisher = 0; publisher < 3; ++publisher) {
    threads.emplace_back([&, publisher] {
      for (int i = 0; i < kMessages; ++i) {
        Message message(1);
        message.add(i + 1, "map", "f" + std::to_string(publisher), Pose{});
        if (intake.receive(publisher + (i > kMessages / 2 ? 10 : 0), i, message.bytes)) call();
      }
      if (--senders == 0) call();
    });
  }
  threads.emplace_back([&] {
    while (senders > 0) {
      intake.feed({&first, &second});
      intake.feed({&first});
    }
  });
  bool over = false;
  while (!over) {
    {
      std::unique_lock lock(mutex);
      called.wait(lock, [&] { return is_called; });
      is_called = false;
    }
    over = senders == 0;
    auto kept = intake.take();
    while (!kept.empty()) {
      const std::uint64_t publisher = kept.front().publisher;
      intake.introduce(publisher, std::to_string(publisher), "/talker" + std::to_string(publisher));
      kept = intake.take(std::move(kept));
    }
  }
  for (std::thread& thread : threads) thread.join();
  for (const char* frame : {"f0", "f1", "f2"}) {
    FrameId id = 0;
    const SharedBuffer::Access access(first);
    check(access->resolve(frame, id) == Status::ok && access->link(id).length() == kMessages,
          "all arrived");
  }
  check(SharedBuffer::Access(first)->refusals().by_child().empty(), "in order");
}

class Sent final : public Outlet {
 public:
  std::int32_t send(std::span<const unsigned char> bytes) override {
    if (refuses) return -1;
    messages.emplace_back(bytes.begin(), bytes.end());
    return 0;
  }
  bool refuses = false;
  std::vector<std::vector<unsigned char>> messages;
};

// A JointState with an empty frame_id and the name "a".
std::vector<unsigned char> joint_state(std::int32_t second, double position) {
  std::vector<unsigned char> bytes(48);
  bytes[1] = 1;
  std::memcpy(bytes.data() + 4, &second, sizeof second);
  bytes[12] = 1, bytes[20] = 1, bytes[24] = 2, bytes[28] = 'a', bytes[32] = 1;
  std::memcpy(bytes.data() + 36, &position, sizeof position);
  return bytes;
}

JointRelay::Layout layout_of(const std::vector<unsigned char>& bytes) {
  const JointFrame frame{{0, 0, 0, 1}, 0, 2., 0.5, 8, 16};
  return {{bytes.begin() + 12, bytes.begin() + 36},
          36,
          44,
          JointFrames(std::vector<unsigned char>(72), {frame}),
          {"a"},
          true};
}

void test_joint_relay() {
  Sent outlet;
  JointRelay relay(outlet, 2);
  const auto first = joint_state(1, 3.);
  check(relay.receive(7, 1, first) && !relay.receive(7, 2, first) && !relay.receive(7, 3, first),
        "Python is called once for a layout that is not known");
  auto kept = relay.take();
  check(kept && kept->sent == 2, "only the newest ones are kept back");
  relay.add_layout(layout_of(first));
  relay.set_rules({1'000'000'000, false, true});
  check(relay.receive(7, 4, joint_state(2, 3.)) && outlet.messages.empty(),
        "nothing overtakes what Python handles");
  while (relay.take()) {
  }
  check(!relay.receive(7, 5, joint_state(2, 3.)) && outlet.messages.size() == 1, "then it answers");
  double x = 0;
  std::memcpy(&x, outlet.messages[0].data() + 16, sizeof x);
  check(x == 6.5 && outlet.messages[0][8] == 2, "with a pose and the stamp");
  check(relay.receive(7, 6, joint_state(2, 3.)), "Python wants to see what is skipped");
  while (relay.take()) {
  }
  relay.set_rules({1'000'000'000, false, false});
  check(!relay.receive(7, 7, joint_state(2, 3.)) && outlet.messages.size() == 1, "or does not");
  outlet.refuses = true;
  check(relay.receive(7, 8, joint_state(9, 3.)) && relay.earliest({"a"}, 1) == 1,
        "what cannot be sent is kept back");
  check(relay.earliest({"a"}, 8'000'000'000) == 2'000'000'000, "and counts as not sent");
  while (relay.take()) {
  }
  outlet.refuses = false;
  relay.set_time(5);
  check(relay.receive(7, 9, joint_state(10, 3.)) && relay.moved_back(5) && !relay.moved_back(5),
        "a clock that was set back is for Python");
  while (relay.take()) {
  }
  relay.set_time({});
  for (std::size_t size = 0; size < first.size(); ++size) {
    const auto whole = joint_state(20 + static_cast<std::int32_t>(size), 1.);
    relay.receive(7, 1, {whole.data(), size});
    while (relay.take()) {
    }
  }
  check(outlet.messages.size() == 5, "shorter ones are not answered, but for missing padding");
}

}  // namespace

int main(int count, char** arguments) {
  const std::size_t messages = count > 1 ? std::strtoul(arguments[1], nullptr, 10) : 20'000;
  test_slerp_weights();
  test_canonical();
  test_kernels_agree();
  test_search();
  test_far_stamps();
  test_parents();
  test_random_operations();
  test_memory();
  test_threads();
  test_same_name();
  test_intake();
  test_intake_threads();
  test_joint_relay();
  test_malformed_messages(messages);
  test_record_walk(messages / 10);
  std::puts("all passed");
}
