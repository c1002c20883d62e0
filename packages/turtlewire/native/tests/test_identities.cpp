// Tests of the identities of service messages, with datagrams and messages made up here: run plain,
// and under the address, undefined-behaviour and thread sanitizers. test_identities [mutations]
#include <atomic>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <random>
#include <string>
#include <thread>
#include <vector>

#include "../cyclone/service_identity.hpp"
#include "../cyclone/service_types.hpp"

namespace {

using namespace turtlewire::cyclone;
using Bytes = std::vector<unsigned char>;

void check(bool truth, const std::string& what) {
  if (truth) return;
  std::fprintf(stderr, "failed: %s\n", what.c_str());
  std::exit(1);
}

constexpr std::size_t kPacketHeader = 20;
const std::array<unsigned char, 16> kGuid = {1, 0xf, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 0, 0, 9, 4};

void put(Bytes& to, std::uint32_t value, std::size_t size, bool little) {
  for (std::size_t i = 0; i < size; ++i)
    to.push_back(static_cast<unsigned char>(value >> 8 * (little ? i : size - 1 - i)));
}

struct Packet {
  unsigned char vendor = 0x0f, kind = 0x15;
  bool little = true;
  Bytes parameters;

  void parameter(std::uint16_t name, std::int64_t number, std::uint16_t size = 24) {
    put(parameters, name, 2, little);
    put(parameters, size, 2, little);
    parameters.insert(parameters.end(), kGuid.begin(), kGuid.end());
    put(parameters, static_cast<std::uint32_t>(number >> 32), 4, little);
    put(parameters, static_cast<std::uint32_t>(number), 4, little);
  }
  // The datagram up to the payload; sample 7 of a writer.
  Bytes bytes() const {
    Bytes made = {'R', 'T', 'P', 'S', 2, 3, 1, vendor, 1, vendor, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1};
    const bool is_piece = kind == 0x16;
    made.push_back(kind);
    made.push_back(static_cast<unsigned char>((little ? 1 : 0) | (parameters.empty() ? 0 : 2)));
    put(made, 0, 2, little);
    put(made, 0, 2, little);
    put(made, is_piece ? 28 : 16, 2, little);
    put(made, 0, 4, false);
    for (unsigned char byte : {0, 0, 8, 3}) made.push_back(byte);
    put(made, 0, 4, little);
    put(made, 7, 4, little);
    if (is_piece)
      for (const auto& [value, size] : {std::pair{1u, 4}, {1u, 2}, {1024u, 2}, {5000u, 4}})
        put(made, value, static_cast<std::size_t>(size), little);
    made.insert(made.end(), parameters.begin(), parameters.end());
    return made;
  }
  std::optional<Identity> identity() const { return received_identity(bytes(), kPacketHeader); }
};

void test_received() {
  for (const bool little : {true, false})
    for (const unsigned char kind : {0x15, 0x16})
      for (const std::uint16_t name : {0x0083, 0x800f}) {
        Packet reply{0x10, kind, little, {}};
        reply.parameter(name, 1LL << 33 | 5);
        const auto answered = reply.identity();
        check(answered && answered->guid == kGuid && answered->number == (1LL << 33 | 5),
              "a reply");
        Packet request{0x0f, kind, little, {}};
        request.parameter(name, Identity::kOfSample);
        const auto asked = request.identity();
        check(asked && asked->guid == kGuid && asked->number == 7, "a request");
      }
  const auto plain = Packet{}.identity();
  check(plain && plain->number == 7 && plain->guid[15] == 3, "a request that names its writer");
  check(!Packet{0x10, 0x15, true, {}}.identity(), "a request of Cyclone");
  check(!Packet{0x0f, 0x07, true, {}}.identity(), "a heartbeat");
}

// A request of Fast DDS 2.6 (Humble), which names the client's reader in the parameter 0x800f only.
void test_humble() {
  const Bytes request = {'R', 'T', 'P', 'S', 2, 3, 1, 0x0f, 1, 0x0f, 0x5a, 0x10, 0x21, 0x43, 0x65,
                         0x87, 1, 0, 0, 0, 0x15, 7, 0x38, 0,  // DATA, little endian, inline
                                                              // QoS, payload
                         0, 0, 0x10, 0, 0, 0, 0x11, 4, 0, 0, 0x12, 3,  // to any reader, from a
                                                                       // writer
                         0, 0, 0, 0, 9, 0, 0, 0,                       // number 9
                         0x0f, 0x80, 24, 0,  // related sample identity, as it was called
                         1, 0x0f, 0x5a, 0x10, 0x21, 0x43, 0x65, 0x87, 1, 0, 0, 0, 0, 0, 0x13, 4,
                         0xff, 0xff, 0xff, 0xff, 0, 0, 0, 0,  // number unknown: the one of the
                                                              // sample
                         1, 0, 0, 0, 0, 1, 0, 0};
  const auto asked = received_identity(request, kPacketHeader);
  check(asked && asked->number == 9 && asked->guid[14] == 0x13 && asked->guid[15] == 4,
        "a request of Humble");
  // It takes the reply whose parameter 0x800f has the same GUID and number, and skips others.
  const auto qos = inline_qos(*asked);
  std::size_t at = 0;
  while (qos[at] != 0x0f || qos[at + 1] != 0x80) at += 4u + qos[at + 2];
  check(std::equal(qos.begin() + static_cast<std::ptrdiff_t>(at) + 4,
                   qos.begin() + static_cast<std::ptrdiff_t>(at) + 20, request.begin() + 48) &&
            qos[at + 20] == 0 && qos[at + 24] == 9,
        "Humble finds the reply");
}

void test_hostile() {
  Packet cyclone{0x10, 0x15, true, {}};
  cyclone.parameter(0x0083, 5, 16);  // too short for an identity
  check(!cyclone.identity(), "a short parameter");
  cyclone.parameters.clear();
  cyclone.parameter(0x0083, 5, 0xffff);  // beyond the end
  check(!cyclone.identity(), "a parameter that does not end");
  cyclone.parameters.clear();
  put(cyclone.parameters, 1, 4, true);  // the list has ended
  cyclone.parameter(0x0083, 5);
  check(!cyclone.identity(), "a parameter behind the end");
  cyclone.parameters.clear();
  cyclone.parameter(0x0083, 5);
  std::fill_n(cyclone.parameters.begin() + 4, 16, 0);
  check(!cyclone.identity(), "no GUID");

  const Bytes whole = cyclone.bytes();
  for (std::size_t size = 0; size < whole.size(); ++size) {
    const Bytes part(whole.begin(), whole.begin() + static_cast<std::ptrdiff_t>(size));
    received_identity(part, kPacketHeader);
  }
  for (std::size_t at :
       {std::size_t{0}, std::size_t{19}, whole.size() - 1, SIZE_MAX, SIZE_MAX - 20})
    check(!received_identity(whole, at), "a submessage elsewhere");
}

void test_mutated(long count) {
  std::mt19937_64 random(1);
  for (long i = 0; i < count; ++i) {
    Packet packet{static_cast<unsigned char>(random() % 2 ? 0x0f : 0x10),
                  static_cast<unsigned char>(random() % 2 ? 0x15 : 0x16),
                  random() % 2 == 0,
                  {}};
    packet.parameter(0x800f, static_cast<std::int64_t>(random()));
    packet.parameter(0x0083, Identity::kOfSample);
    Bytes bytes = packet.bytes();
    for (int n = 0; n < 4; ++n)
      bytes[random() % bytes.size()] = static_cast<unsigned char>(random());
    bytes.resize(bytes.size() - random() % 30);
    received_identity(bytes, random() % 4 == 0 ? random() % 100 : kPacketHeader);
  }
}

// ---------------------------------------------------------------- a Cyclone of our own

struct Sample {
  Bytes bytes;
};

void* from_blocks(const void*, int, BlockCount, const Block* blocks, std::size_t) {
  const auto* const start = static_cast<const unsigned char*>(blocks->start);
  return new Sample{Bytes(start, start + blocks->size)};
}
void* from_received(const void*, int, const void*, std::size_t) { return new Sample; }
void* to_block(const void* sample, std::size_t, std::size_t size, Block* reference) {
  *reference = block(static_cast<const Sample*>(sample)->bytes.data(), size);
  return nullptr;
}
void free_sample(void* sample) { delete static_cast<Sample*>(sample); }
void nothing() {}

using Table = std::array<void*, 17>;

Table table_of_cyclone() {
  Table table;
  table.fill(reinterpret_cast<void*>(nothing));
  table[2] = reinterpret_cast<void*>(from_received);
  table[3] = reinterpret_cast<void*>(from_blocks);
  table[7] = reinterpret_cast<void*>(to_block);
  table[12] = reinterpret_cast<void*>(free_sample);
  return table;
}

Table table = table_of_cyclone();

using TypeTable = std::array<void*, 14>;

TypeTable type_table_of_cyclone() {
  TypeTable table;
  table.fill(reinterpret_cast<void*>(nothing));
  table[1] = nullptr;
  return table;
}

TypeTable type_table = type_table_of_cyclone();

struct Type {
  TypeTable* functions = &type_table;
  Table* of_samples = &table;

  template <typename Function>
  Function function(std::size_t index) const {
    return reinterpret_cast<Function>((*of_samples)[index]);
  }
};
using FromReceived = void* (*)(const void*, int, const void*, std::size_t);
using ToBlock = void* (*)(const void*, std::size_t, std::size_t, Block*);
using Free = void (*)(void*);

Library library() {
  Addresses addresses{};
  addresses[5] = reinterpret_cast<std::uintptr_t>(from_blocks);
  return Library(addresses, {});
}

// A message with room for `room` bytes, to which one of its words points.
struct Message {
  struct {
    void* pool = nullptr;
    std::size_t room, size;
    int has_parameters = 0;
    void* payload = nullptr;
    Block reference = {};
    void* words[40] = {};
  } head;
  alignas(8) unsigned char bytes[40 + 128] = {};

  Message(unsigned char kind, std::size_t room, std::size_t word = 12) {
    Packet packet{0x10, kind, true, {}};
    const Bytes made = packet.bytes();
    head.room = room;
    head.size = made.size() - kPacketHeader;
    std::memcpy(bytes + 40, made.data() + kPacketHeader, head.size);
    head.words[word] = bytes;
  }
};

void test_types() {
  Table strange = table;
  strange[5] = reinterpret_cast<void*>(std::printf);
  Type other{nullptr, &strange}, type;
  check(!carry_identities(library(), reinterpret_cast<std::uintptr_t>(&other)),
        "functions of another library");
  check(!carry_identities(library(), 8), "no type");
  for (int i = 0; i < 2; ++i)
    check(carry_identities(library(), reinterpret_cast<std::uintptr_t>(&type)), "a type");
  check(type.of_samples != &table, "exchanged");
  Type copy, second;
  check(carry_identities(library(), reinterpret_cast<std::uintptr_t>(&copy),
                         reinterpret_cast<std::uintptr_t>(&type)) &&
            copy.of_samples == type.of_samples,
        "a copy has the table of its type");
  check(carry_identities(library(), reinterpret_cast<std::uintptr_t>(&second)) &&
            second.of_samples != type.of_samples,
        "another type has another table");
  check(!carry_identities(library(), reinterpret_cast<std::uintptr_t>(&other), 8), "no base");
  strange = table;
  strange[4] = reinterpret_cast<void*>(to_block);
  check(!carry_identities(library(), reinterpret_cast<std::uintptr_t>(&other)), "another table");
  check(other.of_samples == &strange, "unchanged");
}

void test_kept_types() {
  TypeTable strange = type_table;
  strange[11] = reinterpret_cast<void*>(std::printf);
  Type other{&strange}, type;
  check(!keep_type(library(), reinterpret_cast<std::uintptr_t>(&other)), "of another library");
  check(!keep_type(library(), 8), "no type");
  strange = type_table;
  strange[1] = &strange;
  check(!keep_type(library(), reinterpret_cast<std::uintptr_t>(&other)), "another version");
  check(other.functions == &strange, "unchanged");
  for (int i = 0; i < 2; ++i)
    check(keep_type(library(), reinterpret_cast<std::uintptr_t>(&type)), "a type");
  check((*type.functions)[11] == nullptr && type_table[11] != nullptr, "makes no copies");
  check((*type.functions)[13] == type_table[13], "all else is as before");
}

void test_receiving() {
  Type type;
  carry_identities(library(), reinterpret_cast<std::uintptr_t>(&type));
  struct Datagram {
    alignas(8) unsigned char header[48] = {};
    unsigned char bytes[400];
  } datagrams[2];
  struct Fragment {
    Datagram* datagram;
    Fragment* next;
    std::uint32_t begin, end;
    std::uint16_t submessage, payload;
  };
  Packet packet;
  packet.kind = 0x16;
  packet.parameter(0x0083, Identity::kOfSample);
  Bytes bytes = packet.bytes();
  const auto payload = static_cast<std::uint16_t>(bytes.size());
  const Bytes fields = {0, 1, 0, 0, 42, 43, 44, 45};
  bytes.insert(bytes.end(), fields.begin(), fields.end());
  for (auto& datagram : datagrams) std::memcpy(datagram.bytes, bytes.data(), bytes.size());
  Fragment second{
      &datagrams[1], nullptr, 6, 8, kPacketHeader, static_cast<std::uint16_t>(payload + 6)};
  Fragment first{&datagrams[0], &second, 0, 6, kPacketHeader, payload};
  const auto receive = type.function<FromReceived>(2);
  const auto free = type.function<Free>(12);
  auto* const sample = static_cast<Sample*>(receive(&type, 2, &first, fields.size()));
  check(sample != nullptr && sample->bytes.size() == fields.size() + kMarkedHeader, "a sample");
  check(std::memcmp(sample->bytes.data() + 4,
                    "\xfa"
                    "FastDDS",
                    8) == 0 &&
            std::memcmp(sample->bytes.data() + 12, kGuid.data(), 16) == 0 &&
            sample->bytes[28] == 7 &&
            std::memcmp(sample->bytes.data() + 36, fields.data() + 4, 4) == 0,
        "the identity is in front of the fields");
  free(sample);
  second.end = 9;
  check(receive(&type, 2, &first, fields.size()) == nullptr, "a piece beyond the end");
  datagrams[0].bytes[7] = 0x10;
  datagrams[0].bytes[kPacketHeader + 1] = 1;
  auto* const plain = static_cast<Sample*>(receive(&type, 2, &first, fields.size()));
  check(plain->bytes.empty(), "what Cyclone sent is left to Cyclone");
  free(plain);
}

void test_sending() {
  const Identity identity{kGuid, 1LL << 33 | 5};
  for (const unsigned char kind : {0x15, 0x16}) {
    Message message(kind, 128);
    const std::size_t size = message.head.size;
    check(append_identity(&message.head.reference, identity), "appended");
    check(message.head.size == size + kInlineQos && message.bytes[41] == 3, "flag and size");
    Bytes packet = Packet{0x10, kind, true, {}}.bytes();
    packet.resize(kPacketHeader);
    packet.insert(packet.end(), message.bytes + 40, message.bytes + 40 + message.head.size);
    const auto back = received_identity(packet, kPacketHeader);
    check(back && back->guid == kGuid && back->number == identity.number, "there and back");
    check(!append_identity(&message.head.reference, identity), "once");
  }
  Message full(0x15, 64), elsewhere(0x15, 128, 13), payload(0x15, 128), other(0x07, 128);
  payload.head.payload = &payload;
  for (Message* each : {&full, &elsewhere, &payload, &other}) {
    const Message before = *each;
    check(!append_identity(&each->head.reference, identity), "another layout");
    check(std::memcmp(&before, each, sizeof before) == 0, "nothing is changed");
  }
  check(!append_identity(reinterpret_cast<Block*>(64), identity), "no message");
}

void test_tags() {
  Type type;
  carry_identities(library(), reinterpret_cast<std::uintptr_t>(&type));
  std::vector<std::thread> threads;
  for (int t = 0; t < 4; ++t)
    threads.emplace_back([&type] {
      for (int i = 0; i < 500; ++i) {
        auto* const sample = new Sample{Bytes(8)};
        const auto sent = std::make_shared<Tag>(Identity{kGuid, i});
        tag(sample, sent);
        Message message(0x15, i % 2 == 0 ? 128 : 64);
        type.function<ToBlock>(7)(sample, 0, 8, &message.head.reference);
        check(sent->appended == (i % 2 == 0) && sent->refused == (i % 2 == 1), "told");
        type.function<Free>(12)(sample);
      }
    });
  for (auto& thread : threads) thread.join();
  check(tagged_samples() == 0, "no sample is remembered that is gone");
}

}  // namespace

int main(int count, char** arguments) {
  test_received();
  test_humble();
  test_hostile();
  test_mutated(count > 1 ? std::atol(arguments[1]) : 50'000);
  test_types();
  test_kept_types();
  test_receiving();
  test_sending();
  test_tags();
  std::puts("all passed");
}
