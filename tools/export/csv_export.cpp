#include "tools/export/csv_export.hpp"

#include <initializer_list>

#include "drivers/wire/number_text.hpp"

namespace azimuth {
namespace {

constexpr const char* kColumns =
    "t_s,x_m,y_m,heading_rad,var_x_m2,var_y_m2,var_heading_rad2,cov_xy_m2,cov_x_heading_m_rad,cov_y_heading_m_rad,"
    "odom_x_m,odom_y_m,odom_heading_rad,health,reason\n";

void append_numbers(std::string& line, std::initializer_list<double> values) {
  for (const double value : values) {
    line += ',';
    append_double(line, value);
  }
}

std::string in_quotes(const std::string& text) {
  if (text.find_first_of(",\"\r\n") == std::string::npos) return text;
  std::string out = "\"";
  for (const char letter : text) out += letter == '"' ? "\"\"" : std::string(1, letter);
  return out + '"';
}

}  // namespace

std::string poses_csv(const Estimated& estimated) {
  std::string table = kColumns;
  for (const EstimatedPose& pose : estimated.poses) {
    const Pose2& T = pose.T_map_body;
    const Eigen::Matrix3d& P = pose.covariance;
    append_seconds(table, pose.stamp);
    append_numbers(table, {T.x_m, T.y_m, T.heading_rad, P(0, 0), P(1, 1), P(2, 2), P(1, 0), P(2, 0), P(2, 1)});
    if (const auto& odom = pose.T_odom_body)
      append_numbers(table, {odom->x_m, odom->y_m, odom->heading_rad});
    else
      table += ",,,";
    table += ',';
    if (pose.health) table += to_string(*pose.health);
    table += ',' + in_quotes(pose.reason) + '\n';
  }
  return table;
}

}  // namespace azimuth
