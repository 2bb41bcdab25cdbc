#include "tools/ros2/dds_output.hpp"

#include <cstdlib>
#include <memory>
#include <utility>

namespace azimuth {
namespace {

constexpr int kDepth = 10, kTransformDepth = 100;

using Qos = std::unique_ptr<dds_qos_t, decltype(&dds_delete_qos)>;

/// The quality of service of ROS 2's publishers, whose messages are encoded as CDR version 1.
Qos quality(int depth) {
  Qos qos(dds_create_qos(), &dds_delete_qos);
  dds_qset_reliability(qos.get(), DDS_RELIABILITY_RELIABLE, DDS_MSECS(100));
  dds_qset_durability(qos.get(), DDS_DURABILITY_VOLATILE);
  dds_qset_history(qos.get(), DDS_HISTORY_KEEP_LAST, depth);
  constexpr dds_data_representation_id_t kCdr = DDS_DATA_REPRESENTATION_XCDR1;
  dds_qset_data_representation(qos.get(), 1, &kCdr);
  return qos;
}

/// Appends the interface to the user's CYCLONEDDS_URI, so that it takes precedence.
void use_interface(const std::string& name) {
  const char* const before = std::getenv("CYCLONEDDS_URI");
  const std::string fragment =
      "<General><Interfaces><NetworkInterface name=\"" + name + "\" multicast=\"true\"/></Interfaces></General>";
  ::setenv("CYCLONEDDS_URI", (before && *before ? before + ("," + fragment) : fragment).c_str(), 1);
}

}  // namespace

DdsOutput::DdsOutput(unsigned domain, const std::string& interface, Tell tell) : tell_(std::move(tell)) {
  if (!interface.empty()) use_interface(interface);
  participant_ = dds_create_participant(domain, nullptr, nullptr);
  if (participant_ < 0) {
    trouble_ = std::string("DDS cannot begin (") + dds_strretcode(participant_) +
               "): is there a network interface, and does CYCLONEDDS_URI hold what Cyclone DDS understands?";
    return;
  }
  pose_ = make_writer(geometry_msgs_msg_dds__PoseWithCovarianceStamped__desc, "/azimuth/pose", kDepth);
  odometry_ = make_writer(nav_msgs_msg_dds__Odometry__desc, "/odom", kDepth);
  transforms_ = make_writer(tf2_msgs_msg_dds__TFMessage__desc, "/tf", kTransformDepth);
  path_ = make_writer(nav_msgs_msg_dds__Path__desc, "/azimuth/path", kDepth);
  landmarks_ = make_writer(visualization_msgs_msg_dds__MarkerArray__desc, "/azimuth/landmarks", kDepth);
  diagnostics_ = make_writer(diagnostic_msgs_msg_dds__DiagnosticArray__desc, "/diagnostics", kDepth);
}

DdsOutput::~DdsOutput() {
  if (participant_ > 0) dds_delete(participant_);
}

DdsOutput::Writer DdsOutput::make_writer(const dds_topic_descriptor_t& type, const char* topic, int depth) {
  const Qos qos = quality(depth);
  const std::string name = std::string("rt") + topic;  // ROS 2's prefix for the names of topics
  const dds_entity_t made = dds_create_topic(participant_, &type, name.c_str(), qos.get(), nullptr);
  Writer writer;
  writer.topic = topic;
  writer.entity = made < 0 ? made : dds_create_writer(participant_, made, qos.get(), nullptr);
  if (writer.entity < 0 && trouble_.empty()) trouble_ = name + " cannot be published: " + dds_strretcode(writer.entity);
  return writer;
}

std::array<DdsOutput::Writer*, 6> DdsOutput::writers() {
  return {&pose_, &odometry_, &transforms_, &path_, &landmarks_, &diagnostics_};
}

void DdsOutput::turn() {
  for (Writer* const writer : writers()) {
    dds_publication_matched_status_t status{};
    if (dds_get_publication_matched_status(writer->entity, &status) < 0) continue;
    const bool is_heard = status.current_count > 0;
    if (std::exchange(writer->is_heard, is_heard) == is_heard) continue;
    tell_(std::string(writer->topic) + (is_heard ? " has a subscriber" : " has no subscriber any more"));
  }
}

template <class Message>
void DdsOutput::write(Writer& writer, const Message& message) {
  const auto sample = dds_message(message, storage_);
  note(writer, dds_write(writer.entity, &sample));
}

void DdsOutput::note(Writer& writer, dds_return_t result) {
  if (result >= 0) {
    if (std::exchange(writer.is_failing, false))
      tell_(std::string(writer.topic) + " is sent again; " + std::to_string(writer.failures) + " messages were not");
    return;
  }
  ++writer.failures;
  writer.last_failure = dds_strretcode(result);
  if (!std::exchange(writer.is_failing, true))
    tell_(std::string(writer.topic) + " cannot be sent: " + writer.last_failure);
}

std::string DdsOutput::failures() {
  std::string text;
  for (const Writer* const writer : writers())
    if (writer->failures > 0)
      text.append(text.empty() ? "" : ", ")
          .append(writer->topic)
          .append(": " + std::to_string(writer->failures) + " (" + writer->last_failure + ')');
  return text;
}

void DdsOutput::send(const ros::PoseWithCovarianceStamped& message) { write(pose_, message); }
void DdsOutput::send(const ros::Odometry& message) { write(odometry_, message); }
void DdsOutput::send(const ros::TransformMessage& message) { write(transforms_, message); }
void DdsOutput::send(const ros::Path& message) { write(path_, message); }
void DdsOutput::send(const ros::MarkerArray& message) { write(landmarks_, message); }
void DdsOutput::send(const ros::DiagnosticArray& message) { write(diagnostics_, message); }

}  // namespace azimuth
