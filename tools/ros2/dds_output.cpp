#include "tools/ros2/dds_output.hpp"

#include <algorithm>
#include <cstdlib>
#include <iterator>
#include <memory>
#include <utility>

#include "drivers/ros/serialize.hpp"

namespace azimuth {
namespace {

/// Writing does not change the text.
char* letters(const std::string& text) { return const_cast<char*>(text.c_str()); }
char* no_letters() {
  static char empty[] = "";
  return empty;
}

/// The sequence borrows elements that belong to the storage.
template <class Sequence, class Thing>
Sequence sequence_of(std::vector<Thing>& things) {
  const auto count = static_cast<std::uint32_t>(things.size());
  return {count, count, things.data(), false};
}

std_msgs_msg_dds__Header_ header_of(const ros::Header& header) {
  const ros::RosTime time = ros::message_time(header.stamp);
  return {{static_cast<std::int32_t>(time.seconds), time.nanoseconds}, letters(header.frame_id)};
}

geometry_msgs_msg_dds__Quaternion_ quaternion_of(const ros::Quaternion& q) { return {q.x, q.y, q.z, q.w}; }
geometry_msgs_msg_dds__Vector3_ vector_of(const ros::Vector3& v) { return {v.x, v.y, v.z}; }

geometry_msgs_msg_dds__Pose_ pose_of(const ros::Pose& pose) {
  return {{pose.position.x, pose.position.y, pose.position.z}, quaternion_of(pose.orientation)};
}

geometry_msgs_msg_dds__PoseWithCovariance_ pose_of(const ros::Pose& pose, const ros::Covariance& covariance) {
  geometry_msgs_msg_dds__PoseWithCovariance_ out{};
  out.pose_ = pose_of(pose);
  std::ranges::copy(covariance, std::begin(out.covariance_));
  return out;
}

visualization_msgs_msg_dds__Marker_ marker_of(const ros::Marker& marker) {
  visualization_msgs_msg_dds__Marker_ out{};
  out.header_ = header_of(marker.header);
  out.ns_ = letters(marker.ns);
  out.id_ = marker.id;
  out.type_ = marker.type;
  out.action_ = marker.action;
  out.pose_ = pose_of(marker.pose);
  out.scale_ = vector_of(marker.scale);
  out.color_ = {marker.color.r, marker.color.g, marker.color.b, marker.color.a};
  out.text_ = letters(marker.text);
  for (char** const text : {&out.texture_resource_, &out.texture_.header_.frame_id_, &out.texture_.format_,
                            &out.mesh_resource_, &out.mesh_file_.filename_})
    *text = no_letters();
  return out;
}

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

geometry_msgs_msg_dds__PoseWithCovarianceStamped_ dds_message(const ros::PoseWithCovarianceStamped& message,
                                                              DdsStorage&) {
  return {header_of(message.header), pose_of(message.pose, message.covariance)};
}

nav_msgs_msg_dds__Odometry_ dds_message(const ros::Odometry& message, DdsStorage&) {
  nav_msgs_msg_dds__Odometry_ out{};
  out.header_ = header_of(message.header);
  out.child_frame_id_ = letters(message.child_frame_id);
  out.pose_ = pose_of(message.pose, message.pose_covariance);
  out.twist_.twist_ = {vector_of(message.twist.linear), vector_of(message.twist.angular)};
  std::ranges::copy(message.twist_covariance, std::begin(out.twist_.covariance_));
  return out;
}

tf2_msgs_msg_dds__TFMessage_ dds_message(const ros::TransformMessage& message, DdsStorage& storage) {
  storage.transforms.clear();
  for (const ros::TransformStamped& each : message.transforms)
    storage.transforms.push_back({header_of(each.header),
                                  letters(each.child_frame_id),
                                  {vector_of(each.transform.position), quaternion_of(each.transform.orientation)}});
  return {sequence_of<decltype(tf2_msgs_msg_dds__TFMessage_::transforms_)>(storage.transforms)};
}

nav_msgs_msg_dds__Path_ dds_message(const ros::Path& message, DdsStorage& storage) {
  storage.poses.clear();
  for (const ros::PoseStamped& each : message.poses)
    storage.poses.push_back({header_of(each.header), pose_of(each.pose)});
  return {header_of(message.header), sequence_of<decltype(nav_msgs_msg_dds__Path_::poses_)>(storage.poses)};
}

visualization_msgs_msg_dds__MarkerArray_ dds_message(const ros::MarkerArray& message, DdsStorage& storage) {
  storage.markers.clear();
  for (const ros::Marker& each : message.markers) storage.markers.push_back(marker_of(each));
  return {sequence_of<decltype(visualization_msgs_msg_dds__MarkerArray_::markers_)>(storage.markers)};
}

diagnostic_msgs_msg_dds__DiagnosticArray_ dds_message(const ros::DiagnosticArray& message, DdsStorage& storage) {
  storage.statuses.clear();
  storage.values.resize(message.status.size());
  for (std::size_t i = 0; i < message.status.size(); ++i) {
    const ros::DiagnosticStatus& status = message.status[i];
    storage.values[i].clear();
    for (const ros::KeyValue& each : status.values)
      storage.values[i].push_back({letters(each.key), letters(each.value)});
    storage.statuses.push_back(
        {status.level, letters(status.name), letters(status.message), letters(status.hardware_id),
         sequence_of<decltype(diagnostic_msgs_msg_dds__DiagnosticStatus_::values_)>(storage.values[i])});
  }
  return {header_of(message.header),
          sequence_of<decltype(diagnostic_msgs_msg_dds__DiagnosticArray_::status_)>(storage.statuses)};
}

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
