// Expected bearings of the landmarks of the map, seen from a pose.

/// In a map with at most this many landmarks all are expected, in a larger one only those that were seen.
const all = 60;

/// Returns [[id, azimuth_rad, sigma_rad, elevation_rad or null]], as in the events. The correlation between pose and
/// landmark is unknown here, so sigma is an upper bound from their separate covariances.
export function expectations(pose, landmarks, bearings) {
  if (!pose) return [];
  const seen = new Set(bearings.map((bearing) => bearing[5]).filter((id) => id !== null));
  return landmarks.filter(({ id }) => landmarks.length <= all || seen.has(id)).map((one) => expectation(pose, one));
}

/// The pose of the camera with the robot's heading. `position` is the camera's position in the rig ([forward, left]);
/// null means over the axle.
export function cameraAt(pose, position) {
  if (!pose || !position) return pose;
  const [ahead, left] = position, c = Math.cos(pose.heading), s = Math.sin(pose.heading);
  return { ...pose, x: pose.x + c * ahead - s * left, y: pose.y + s * ahead + c * left };
}

/// azimuth = atan2(dy, dx) - heading; the derivative with respect to the position is (-dy, dx) / r^2.
function expectation({ x, y, heading, covariance: [xx, xy, , yy, , hh] }, { id, at, covariance, z }) {
  const dx = at[0] - x, dy = at[1] - y, r = Math.max(0.05, Math.hypot(dx, dy));
  const [a, b] = [-dy / r ** 2, dx / r ** 2];
  const variance = a * a * (covariance[0] + xx) + 2 * a * b * (covariance[1] + xy) + b * b * (covariance[2] + yy) + hh;
  const azimuth = Math.atan2(dy, dx) - heading;
  return [id, Math.atan2(Math.sin(azimuth), Math.cos(azimuth)), Math.min(Math.PI / 2, Math.sqrt(Math.max(0, variance))),
    Number.isFinite(z) ? Math.atan2(z, r) : null];
}
