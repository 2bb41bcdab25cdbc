#include "tests/tools/ros2/dds_reader.hpp"

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <fastdds/dds/topic/TypeSupport.hpp>
#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <functional>
#include <mutex>
#include <stdexcept>

namespace azimuth::test {
namespace {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

/// A type whose samples are the received bytes.
class AnyType : public dds::TopicDataType {
 public:
  explicit AnyType(const std::string& name) {
    setName(name.c_str());
    m_typeSize = 1U << 20U;
    m_isGetKeyDefined = false;
  }
  bool serialize(void*, rtps::SerializedPayload_t*) override { return false; }
  bool deserialize(rtps::SerializedPayload_t* payload, void* sample) override {
    static_cast<std::string*>(sample)->assign(reinterpret_cast<const char*>(payload->data), payload->length);
    return true;
  }
  std::function<std::uint32_t()> getSerializedSizeProvider(void*) override {
    return [] { return 0U; };
  }
  void* createData() override { return new std::string; }
  void deleteData(void* sample) override { delete static_cast<std::string*>(sample); }
  bool getKey(void*, rtps::InstanceHandle_t*, bool) override { return false; }
};

dds::DomainParticipantQos on_loopback() {
  dds::DomainParticipantQos qos = dds::PARTICIPANT_QOS_DEFAULT;
  const auto udp = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
  udp->interfaceWhiteList.emplace_back("127.0.0.1");
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp);
  return qos;
}

/// The default of ROS 2 with a deeper history, so that no sample is lost when the test gets no processor time.
dds::DataReaderQos quality() {
  dds::DataReaderQos qos = dds::DATAREADER_QOS_DEFAULT;
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.durability().kind = dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = 2000;
  qos.resource_limits().max_samples = 4000;
  qos.resource_limits().max_samples_per_instance = 4000;
  qos.endpoint().history_memory_policy = rtps::DYNAMIC_RESERVE_MEMORY_MODE;
  return qos;
}

}  // namespace

struct DdsReader::Parts : public dds::DataReaderListener {
  void on_data_available(dds::DataReader* from) override {
    dds::SampleInfo info;
    for (std::string sample; from->take_next_sample(&sample, &info) == ReturnCode_t::RETCODE_OK;) {
      const std::lock_guard lock(mutex);
      if (info.valid_data) messages.push_back(sample);
    }
  }
  void on_subscription_matched(dds::DataReader*, const dds::SubscriptionMatchedStatus& status) override {
    const std::lock_guard lock(mutex);
    matched = status.current_count;
  }

  dds::DomainParticipant* participant = nullptr;
  mutable std::mutex mutex;
  std::vector<std::string> messages;
  int matched = 0;
};

DdsReader::DdsReader(const std::string& topic, const std::string& type, int domain)
    : parts_(std::make_unique<Parts>()) {
  auto* const factory = dds::DomainParticipantFactory::get_instance();
  parts_->participant = factory->create_participant(static_cast<std::uint32_t>(domain), on_loopback());
  if (parts_->participant == nullptr) throw std::runtime_error("no participant of Fast DDS");
  const dds::TypeSupport support(new AnyType(type));
  support.register_type(parts_->participant);
  dds::Topic* const made = parts_->participant->create_topic(topic, type, dds::TOPIC_QOS_DEFAULT);
  dds::Subscriber* const subscriber = parts_->participant->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  if (made == nullptr || subscriber == nullptr) throw std::runtime_error("no subscriber of Fast DDS");
  if (subscriber->create_datareader(made, quality(), parts_.get()) == nullptr)
    throw std::runtime_error("no reader of Fast DDS");
}

DdsReader::~DdsReader() {
  parts_->participant->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(parts_->participant);
}

bool DdsReader::is_matched() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->matched > 0;
}

std::vector<std::string> DdsReader::messages() const {
  const std::lock_guard lock(parts_->mutex);
  return parts_->messages;
}

ReadPose read_pose(const std::string& cdr) {
  using eprosima::fastcdr::Cdr;
  std::string bytes = cdr;
  eprosima::fastcdr::FastBuffer buffer(bytes.data(), bytes.size());
  Cdr reader(buffer, Cdr::DEFAULT_ENDIAN, Cdr::DDS_CDR);
  reader.read_encapsulation();
  ReadPose pose;
  reader >> pose.sec >> pose.nanosec >> pose.frame_id >> pose.position >> pose.orientation >> pose.covariance;
  if (reader.getSerializedDataLength() + 4 < bytes.size()) throw std::runtime_error("bytes are left over");
  return pose;
}

}  // namespace azimuth::test
