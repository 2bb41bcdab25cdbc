// In which directions the map puts its landmarks, seen from a pose.

/// In a small map all of them, in a large one those that were seen.
const all = 60;

/// [[id, azimuth_rad, sigma_rad, elevation_rad or null]], as events have them. What pose and landmark have in common is not known
/// here: sigma is what it is at most, of the landmark's place and the robot's beside it.
export function expectations(pose, landmarks, bearings) {
  if (!pose) return [];
  const seen = new Set(bearings.map((bearing) => bearing[5]).filter((id) => id !== null));
  return landmarks.filter(({ id }) => landmarks.length <= all || seen.has(id)).map((one) => expectation(pose, one));
}

/// Where a robot's camera is, which stands at `position` on it ([forward, left], as the rig has it; null: over the axle),
/// with the robot's heading.
export function cameraAt(pose, position) {
  if (!pose || !position) return pose;
  const [ahead, left] = position, c = Math.cos(pose.heading), s = Math.sin(pose.heading);
  return { ...pose, x: pose.x + c * ahead - s * left, y: pose.y + s * ahead + c * left };
}

/// azimuth = atan2(dy, dx) - heading; its derivative after the place is (-dy, dx) / r^2.
function expectation({ x, y, heading, covariance: [xx, xy, , yy, , hh] }, { id, at, covariance, z }) {
  const dx = at[0] - x, dy = at[1] - y, r = Math.max(0.05, Math.hypot(dx, dy));
  const [a, b] = [-dy / r ** 2, dx / r ** 2];
  const variance = a * a * (covariance[0] + xx) + 2 * a * b * (covariance[1] + xy) + b * b * (covariance[2] + yy) + hh;
  const azimuth = Math.atan2(dy, dx) - heading;
  return [id, Math.atan2(Math.sin(azimuth), Math.cos(azimuth)), Math.min(Math.PI / 2, Math.sqrt(Math.max(0, variance))),
    Number.isFinite(z) ? Math.atan2(z, r) : null];
}
