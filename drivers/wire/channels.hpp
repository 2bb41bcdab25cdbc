#pragma once
// The names of the project's LCM channels (without a prefix), and their message types.

#include <string_view>

namespace azimuth::channel {

inline constexpr std::string_view kOdometry = "AZIMUTH_ODOM";        ///< odometry_t
inline constexpr std::string_view kBearings = "AZIMUTH_BEARINGS";    ///< bearings_t
inline constexpr std::string_view kFeatures = "AZIMUTH_FEATURES";    ///< features_t
inline constexpr std::string_view kCamera = "CAMERA";                ///< image_t
inline constexpr std::string_view kPose = "AZIMUTH_POSE";            ///< pose_cov_t
inline constexpr std::string_view kBotPose = "POSE";                 ///< pose_t
inline constexpr std::string_view kMapChunk = "AZIMUTH_MAP_CHUNK";   ///< map_chunk_t
inline constexpr std::string_view kPath = "AZIMUTH_PATH";            ///< path_t
inline constexpr std::string_view kStatus = "AZIMUTH_STATUS";        ///< status_t
inline constexpr std::string_view kSightings = "AZIMUTH_SIGHTINGS";  ///< sightings_t
inline constexpr std::string_view kExpected = "AZIMUTH_EXPECTED";    ///< expectations_t
inline constexpr std::string_view kKept = "AZIMUTH_KEPT";            ///< kept_t
inline constexpr std::string_view kPicture = "AZIMUTH_PICTURE";      ///< image_t: picture of bearings
inline constexpr std::string_view kTruth = "AZIMUTH_TRUTH";          ///< odometry_t: T_world_body
inline constexpr std::string_view kTruthMap = "AZIMUTH_TRUTH_MAP";   ///< map_chunk_t
inline constexpr std::string_view kDocument = "AZIMUTH_DOCUMENT";    ///< document_t

}  // namespace azimuth::channel
