// A foreign peer on Debian's Fast DDS, with type support written on Fast CDR. It sends back what it
// receives on rt/to_fast/X on rt/from_fast/X, with 1 added to one number so that the test sees that
// the fields were understood, and latches one message of each type on rt/latched_fast/X. It reads
// rt/latched/X, transient local, in the same way. On rt/broken it latches payloads that are no
// messages, and a good one after them. With the name of a node it announces this node. It runs
// until it is terminated.

#include <fastcdr/Cdr.h>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastrtps/utils/IPLocator.h>

#include <condition_variable>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <memory>
#include <mutex>
#include <string>
#include <vector>

namespace fast = eprosima::fastdds::dds;
using eprosima::fastcdr::Cdr;
using eprosima::fastcdr::FastBuffer;
using eprosima::fastrtps::rtps::InstanceHandle_t;
using eprosima::fastrtps::rtps::Locator_t;
using eprosima::fastrtps::rtps::SerializedPayload_t;

struct TransformStamped {
  int32_t sec = 3;
  uint32_t nanosec = 4;
  std::string frame_id = "world", child_frame_id = "turtle1";
  double translation[3] = {1.5, 0, 0}, rotation[4] = {0, 0, 0, 1};

  template <typename Function>
  void each(Function&& function) {
    function(sec), function(nanosec), function(frame_id), function(child_frame_id);
    for (double& value : translation) function(value);
    for (double& value : rotation) function(value);
  }
};

struct TFMessage {
  static constexpr const char* name = "tf2_msgs::msg::dds_::TFMessage_";
  std::vector<TransformStamped> transforms{1};

  void write(Cdr& cdr) {
    cdr << static_cast<uint32_t>(transforms.size());
    for (TransformStamped& item : transforms) item.each([&](auto& value) { cdr << value; });
  }
  void read(Cdr& cdr) {
    uint32_t size = 0;
    cdr >> size;
    transforms.resize(size);
    for (TransformStamped& item : transforms) item.each([&](auto& value) { cdr >> value; });
  }
  void increment() {
    for (TransformStamped& item : transforms) item.translation[0] += 1;
  }
};

struct Pose {
  static constexpr const char* name = "turtlesim::msg::dds_::Pose_";
  float fields[5] = {1.5F, 0, 0.25F, 0, 0};

  void write(Cdr& cdr) {
    for (float& value : fields) cdr << value;
  }
  void read(Cdr& cdr) {
    for (float& value : fields) cdr >> value;
  }
  void increment() { fields[0] += 1; }
};

struct Twist {
  static constexpr const char* name = "geometry_msgs::msg::dds_::Twist_";
  double fields[6] = {1.5, 0, 0, 0, 0, 0.25};

  void write(Cdr& cdr) {
    for (double& value : fields) cdr << value;
  }
  void read(Cdr& cdr) {
    for (double& value : fields) cdr >> value;
  }
  void increment() { fields[0] += 1; }
};

// As rmw_fastrtps does it: no type information beside the name.
class RosType : public fast::TopicDataType {
 public:
  explicit RosType(const char* name) {
    setName(name);
    m_typeSize = 10000;
    m_isGetKeyDefined = false;
    auto_fill_type_object(false);
    auto_fill_type_information(false);
  }
  bool getKey(void*, InstanceHandle_t*, bool) override { return false; }
  std::function<uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 10000U; };
  }
};

template <typename Message>
class MessageType : public RosType {
 public:
  MessageType() : RosType(Message::name) {}
  bool serialize(void* data, SerializedPayload_t* payload) override {
    FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->max_size);
    Cdr cdr(buffer, Cdr::LITTLE_ENDIANNESS, Cdr::DDS_CDR);
    payload->encapsulation = CDR_LE;
    cdr.serialize_encapsulation();
    static_cast<Message*>(data)->write(cdr);
    payload->length = static_cast<uint32_t>(cdr.getSerializedDataLength());
    return true;
  }
  bool deserialize(SerializedPayload_t* payload, void* data) override {
    FastBuffer buffer(reinterpret_cast<char*>(payload->data), payload->length);
    Cdr cdr(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
    cdr.read_encapsulation();
    static_cast<Message*>(data)->read(cdr);
    return true;
  }
  void* createData() override { return new Message; }
  void deleteData(void* data) override { delete static_cast<Message*>(data); }
};

using Bytes = std::vector<uint8_t>;

class BytesType : public RosType {
 public:
  using RosType::RosType;
  bool serialize(void* data, SerializedPayload_t* payload) override {
    const Bytes& bytes = *static_cast<Bytes*>(data);
    payload->encapsulation = CDR_LE;
    payload->length = static_cast<uint32_t>(bytes.size());
    std::copy(bytes.begin(), bytes.end(), payload->data);
    return true;
  }
  bool deserialize(SerializedPayload_t*, void*) override { return false; }
  void* createData() override { return new Bytes; }
  void deleteData(void* data) override { delete static_cast<Bytes*>(data); }
};

struct Peer {
  fast::DomainParticipant* participant;
  fast::Publisher* publisher;
  fast::Subscriber* subscriber;

  fast::Topic* topic(const std::string& name, fast::TypeSupport type) {
    type.register_type(participant);
    return participant->create_topic(name, type.get_type_name(), fast::TOPIC_QOS_DEFAULT);
  }
  fast::DataWriter* writer(const std::string& name, fast::TypeSupport type,
                           fast::DurabilityQosPolicyKind durability) {
    fast::DataWriterQos qos;
    qos.durability().kind = durability;
    qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 100;
    return publisher->create_datawriter(topic(name, type), qos);
  }
  void reader(const std::string& name, fast::TypeSupport type,
              fast::DurabilityQosPolicyKind durability, fast::DataReaderListener* listener) {
    fast::DataReaderQos qos;
    qos.durability().kind = durability;
    qos.reliability().kind = fast::RELIABLE_RELIABILITY_QOS;
    qos.history().depth = 100;
    subscriber->create_datareader(topic(name, type), qos, listener);
  }
};

template <typename Message>
class Answer : public fast::DataReaderListener {
 public:
  explicit Answer(fast::DataWriter* writer) : writer_(writer) {}
  void on_data_available(fast::DataReader* reader) override {
    Message message;
    fast::SampleInfo info;
    while (reader->take_next_sample(&message, &info) == ReturnCode_t::RETCODE_OK) {
      if (!info.valid_data) continue;
      message.increment();
      writer_->write(&message);
    }
  }

 private:
  fast::DataWriter* writer_;
};

template <typename Message>
void serve(Peer& peer, const std::string& name) {
  fast::TypeSupport type(new MessageType<Message>);
  auto* answer = new Answer<Message>(
      peer.writer("rt/from_fast/" + name, type, fast::TRANSIENT_LOCAL_DURABILITY_QOS));
  peer.reader("rt/to_fast/" + name, type, fast::VOLATILE_DURABILITY_QOS, answer);
  peer.reader("rt/latched/" + name, type, fast::TRANSIENT_LOCAL_DURABILITY_QOS, answer);
  Message message;
  peer.writer("rt/latched_fast/" + name, type, fast::TRANSIENT_LOCAL_DURABILITY_QOS)
      ->write(&message);
}

void latch_broken(Peer& peer) {
  fast::DataWriter* writer =
      peer.writer("rt/broken", fast::TypeSupport(new BytesType("std_msgs::msg::dds_::String_")),
                  fast::TRANSIENT_LOCAL_DURABILITY_QOS);
  std::vector<Bytes> payloads = {
      {0, 3, 0, 0, 1, 0, 0, 0},                                  // a parameter list
      {0, 7, 0, 0, 2, 0, 0, 0, 'x', 0, 0, 0},                    // XCDR2
      {0, 1, 0, 0, 255, 255, 255, 127, 'x', 0, 0, 0},            // a string longer than the message
      {0, 0, 0, 0, 0, 0, 0, 5, 'd', 'u', 'b', 'i', 0, 0, 0, 0},  // big-endian
      {0, 1, 0, 0, 5, 0, 0, 0, 'g', 'o', 'o', 'd', 0, 0, 0, 0},  // good
  };
  for (Bytes& payload : payloads) writer->write(&payload);
}

// What rmw_fastrtps publishes of a participant, here one without endpoints of its nodes.
void announce_node(Peer& peer, const std::string& name) {
  fast::DataWriter* writer = peer.writer(
      "ros_discovery_info",
      fast::TypeSupport(new BytesType("rmw_dds_common::msg::dds_::ParticipantEntitiesInfo_")),
      fast::TRANSIENT_LOCAL_DURABILITY_QOS);
  const auto& guid = peer.participant->guid();
  Bytes info = {0, 1, 0, 0};
  info.insert(info.end(), guid.guidPrefix.value, guid.guidPrefix.value + 12);
  info.insert(info.end(), guid.entityId.value, guid.entityId.value + 4);
  const auto add_number = [&](size_t number) {
    info.resize((info.size() + 3) / 4 * 4);
    for (int shift = 0; shift < 32; shift += 8)
      info.push_back(static_cast<uint8_t>(number >> shift));
  };
  const auto add_text = [&](const std::string& text) {
    add_number(text.size() + 1);
    info.insert(info.end(), text.c_str(), text.c_str() + text.size() + 1);
  };
  add_number(1);
  add_text("/");
  add_text(name);
  add_number(0);
  add_number(0);
  writer->write(&info);
}

// The discovery of rmw_fastrtps in LOCALHOST range: no multicast, and 32 processes of this host are
// asked.
fast::DomainParticipantQos localhost_only(const std::string& user_data) {
  fast::DomainParticipantQos qos;
  auto& builtin = qos.wire_protocol().builtin;
  builtin.metatrafficUnicastLocatorList.push_back(Locator_t());
  Locator_t localhost;
  eprosima::fastrtps::rtps::IPLocator::setIPv4(localhost, 127, 0, 0, 1);
  builtin.initialPeersList.push_back(localhost);
  auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->maxInitialPeersRange = 32;
  qos.user_data().data_vec({user_data.begin(), user_data.end()});
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  return qos;
}

int main(int argc, char** argv) {
  if (argc != 2 && argc != 3) return 2;
  const auto domain = static_cast<uint32_t>(std::atoi(argv[1]));
  const auto qos = localhost_only(argc == 3 ? "enclave=/;" : "");
  auto* factory = fast::DomainParticipantFactory::get_instance();
  Peer peer{factory->create_participant(domain, qos), nullptr, nullptr};
  if (peer.participant == nullptr) return 1;
  peer.publisher = peer.participant->create_publisher(fast::PUBLISHER_QOS_DEFAULT);
  peer.subscriber = peer.participant->create_subscriber(fast::SUBSCRIBER_QOS_DEFAULT);
  serve<TFMessage>(peer, "tf");
  serve<Pose>(peer, "pose");
  serve<Twist>(peer, "twist");
  latch_broken(peer);
  if (argc == 3) announce_node(peer, argv[2]);
  std::mutex mutex;
  std::unique_lock lock(mutex);
  std::condition_variable().wait(lock, [] { return false; });
}
