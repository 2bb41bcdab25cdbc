// The data of the robot from the events of `azimuth view`. Malformed events are counted and ignored.

import { Columns } from './columns.js';
import { cameraAt, expectations } from './expectations.js';

export const healths = ['starting', 'tracking', 'degraded', 'lost'];

/// Limits: rows of the path, rows of statuses, stretches of health, lines of the journal.
const most = { poses: 100000, statuses: 20000, stretches: 2000, lines: 500 };

const figures = ['t', 'accepted', 'rejected', 'created', 'thinned', 'latency_ms', 'detect_ms', 'pose_hz', 'odometry_hz',
  'image_hz', 'battery_v', 'nis', 'nis_low', 'nis_high', 'landmarks'];

const finite = (...values) => values.every((value) => Number.isFinite(value));
const list = (value) => {
  if (!Array.isArray(value)) throw new TypeError('a list was expected');
  return value;
};

/// The 95 % interval of chi-squared divided by its degrees of freedom (Wilson and Hilferty).
export function meanBounds(degrees) {
  const spread = 2 / (9 * degrees), side = 1.96 * Math.sqrt(spread);
  return [Math.max(0, 1 - spread - side) ** 3, (1 - spread + side) ** 3];
}

/// Numbers for people. Ids may have three digits even in a small map, because deleted landmarks used up ids, so the
/// page numbers the landmarks of the map in the order of their ids. If the sensor gives identities, all ids stay
/// unchanged.
export function numbersOf(ids, haveNames) {
  if (haveNames) return new Map(ids.map((id) => [id, `${id}`]));
  return new Map([...ids].sort((a, b) => a - b).map((id, i) => [id, `${i + 1}`]));
}

/// The number of a landmark, with the height of a lamp.
function nameOf(id, z, sigma_z) {
  if (!finite(z)) return `${id}`;
  return `${id}: ${z.toFixed(2)}${finite(sigma_z) ? ` ± ${sigma_z.toFixed(2)}` : ''} m`;
}

export class LiveStore {
  unreadable = 0;
  missed = 0;

  constructor() {
    this.poses = new Columns(['t', 'x', 'y', 'heading', 'health', 'odom_x', 'odom_y', 'xx', 'xy', 'yy', 'two_sigma_m',
      'two_sigma_deg', 'way'], most.poses);
    this.truth = new Columns(['t', 'x', 'y', 'heading'], most.poses);
    this.figures = new Columns(figures, most.statuses);
    this.stretches = [];
    this.journal = [];
    this.clear();
  }

  /// Clears everything except the journal.
  clear() {
    for (const columns of [this.poses, this.truth, this.figures]) columns.clear();
    this.stretches.length = 0;
    this.hello = this.pose = this.status = this.bearings = this.picture = this.silent_s = this.health = null;
    this.map = { landmarks: [], more: 0, version: (this.map?.version ?? 0) + 1 };
    this.path = [];
    this.devices = new Map();
    this.T_map_odom = null;
  }

  get now() {
    return Math.max(this.poses.length > 0 ? this.poses.last('t') : -Infinity,
      this.figures.length > 0 ? this.figures.last('t') : -Infinity);
  }

  /// Age of the newest pose: the time since its arrival plus the known latency before. NaN without a pose.
  get poseAge_s() {
    if (!this.pose || !finite(this.poseHeard_ms)) return NaN;
    const onItsWay_s = this.status?.latency_s;
    return (performance.now() - this.poseHeard_ms) / 1e3 + (finite(onItsWay_s) ? Math.max(0, onItsWay_s) : 0);
  }

  /// Speed from odometry over the last second, because corrections make the estimate jump. NaN if unknown.
  get speed_m_per_s() {
    const { poses } = this, t = poses.get('t'), xs = poses.get('odom_x'), ys = poses.get('odom_y'), last = t.length - 1;
    let first = last;
    while (first > 0 && t[last] - t[first] < 1) --first;
    return first >= 0 && t[last] - t[first] > 0.3 ? Math.hypot(xs[last] - xs[first], ys[last] - ys[first]) / (t[last] - t[first]) : NaN;
  }

  /// The robot's name from the odometer's status, which has it in brackets after "running".
  get robot() {
    return /^running \((.+)\)$/.exec(this.status?.odometer ?? '')?.[1] ?? '';
  }

  /// True if no data of a robot have arrived.
  get isEmpty() {
    return this.poses.length === 0 && this.status === null && this.map.landmarks.length === 0;
  }

  /// Takes an event; returns whether it was well-formed.
  take(kind, data) {
    try {
      if (data === null || typeof data !== 'object') throw new TypeError('an object was expected');
      if (kind !== 'silence' && kind !== 'beat') this.silent_s = null;
      this[`take_${kind}`](data);
      return true;
    } catch {
      ++this.unreadable;
      return false;
    }
  }

  take_hello(data) {
    this.clear();
    this.hello = data;
  }

  take_trail(data) {
    const columns = ['t', 'x', 'y', 'heading', 'health', 'sigma_m', 'sigma_heading_rad', 'odom_x', 'odom_y',
      'odom_heading'].map((name) => data[name] ?? []);
    list(data.t).forEach((t, i) => {
      const [, x, y, heading, health, sigma, turn, ...odom] = columns.map((column) => column[i]);
      this.#add(t, x, y, heading, health ?? 1, odom, [sigma * sigma, 0, sigma * sigma], turn);
    });
  }

  take_pose(data) {
    const [xx, xy, , yy, , hh] = list(data.covariance);
    if (!finite(data.t, data.x, data.y, data.heading)) throw new TypeError('numbers were expected');
    this.#add(data.t, data.x, data.y, data.heading, data.health, list(data.odom), [xx, xy, yy], Math.sqrt(hh));
    if (!this.pose || data.t >= this.pose.t)
      this.pose = data, this.health = data.health, this.poseHeard_ms = performance.now();
  }

  /// Appends a pose. Poses older than the newest are ignored: they are steps that ended after a later prediction was
  /// sent.
  #add(t, x, y, heading, health, odom, [xx, xy, yy], sigma_heading_rad) {
    if (!finite(t, x, y) || t <= (this.poses.length > 0 ? this.poses.last('t') : -Infinity)) return;
    const [odomX, odomY] = this.#laidOverMap(odom, x, y, heading);
    const long = Math.sqrt(Math.max(0, (xx + yy) / 2 + Math.hypot((xx - yy) / 2, xy)));
    const way = this.poses.length > 0 ? this.poses.last('way') + Math.hypot(x - this.poses.last('x'), y - this.poses.last('y')) : 0;
    this.poses.push(t, x, y, heading, health, odomX, odomY, xx, xy, yy, 2 * long, (2 * sigma_heading_rad * 180) / Math.PI, way);
    this.#healthIs(t, healths[health] ?? 'starting');
  }

  /// Dead reckoning from the first pose on, in the map frame.
  #laidOverMap([ox, oy, turn], x, y, heading) {
    if (!finite(ox, oy)) return [NaN, NaN];
    if (!this.T_map_odom) {
      const by = finite(turn, heading) ? heading - turn : 0, cos = Math.cos(by), sin = Math.sin(by);
      this.T_map_odom = [cos, sin, x - cos * ox + sin * oy, y - sin * ox - cos * oy];
    }
    const [cos, sin, dx, dy] = this.T_map_odom;
    return [dx + cos * ox - sin * oy, dy + sin * ox + cos * oy];
  }

  #healthIs(t, health, reason = null) {
    const last = this.stretches.at(-1);
    if (last) last.to = Math.max(last.to, t);
    if (last && last.health === health && (reason === null || reason === last.reason)) return;
    if (last && last.health === health && last.reason === '') return void (last.reason = reason);
    this.stretches.push({ from: t, to: t, health, reason: reason ?? '' });
    if (this.stretches.length > most.stretches) this.stretches.shift();
  }

  take_truth({ t, x, y, heading }) {
    if (!finite(t, x, y)) throw new TypeError('numbers were expected');
    if (this.truth.length === 0 || t > this.truth.last('t')) this.truth.push(t, x, y, heading);
  }

  take_truth_trail({ t, x, y, heading }) {
    list(t).forEach((seconds, i) => this.take_truth({ t: seconds, x: x[i], y: y[i], heading: heading[i] }));
  }

  take_map(data) {
    const rows = list(data.landmarks), numbers = numbersOf(rows.map(([id]) => id), rows.some(([, identity]) => identity >= 0));
    const labelOf = (id, identity) => (identity >= 0 ? `${identity}` : numbers.get(id));
    const landmarks = rows.map(([id, identity, x, y, xx, xy, yy, z, sigma_z, last_seen, state]) => ({
      id, at: [x, y], covariance: [xx, xy, yy], z, last_seen, state, label: labelOf(id, identity),
      name: nameOf(labelOf(id, identity), z, sigma_z), kind: Math.max(0, ['confirmed', 'new', 'doubted'].indexOf(state)), settled: state !== 'unseen' }))
      .filter(({ at, covariance }) => finite(...at, ...covariance));
    this.map = { landmarks, more: data.more ?? 0, version: this.map.version + 1,
      byId: new Map(landmarks.map((one) => [one.id, one])) };
  }

  take_path(data) {
    this.path = list(data.points).filter((point) => finite(point[1], point[2]));
  }

  /// If the daemon does not send its expected bearings, they are computed from map and pose, unless the robot is lost.
  take_bearings({ t, bearings, expected }) {
    if (!finite(t) || !list(bearings).every(Array.isArray)
      || !list(expected).every(Array.isArray)) throw new TypeError('numbers were expected');
    const own = expected.length > 0;
    this.bearings = { t, bearings, expected: own ? expected : this.#expectations(bearings), own };
  }

  #expectations(bearings) {
    return healths[this.pose?.health] === 'lost' ? [] : expectations(
      cameraAt(this.pose, this.hello?.rig?.position_m), this.map.landmarks, bearings);
  }

  take_status(data) {
    const t = finite(data.t) ? data.t : this.now;  // not finite before the first event with a time
    if (!finite(data.health)) throw new TypeError('a number was expected');
    const { rates = {}, nis = null } = data;
    const [low, high] = nis && nis.degrees > 0 ? meanBounds(nis.degrees) : [NaN, NaN];
    const ms = (value, factor) => (finite(value) ? value * factor : NaN);
    if (finite(t) && (this.figures.length === 0 || t > this.figures.last('t')))
      this.figures.push(t, data.accepted, data.rejected, data.created, data.thinned, ms(data.latency_s, 1e3),
        ms(data.detect_mean_us, 1e-3), rates?.pose_hz, rates?.odometry_hz, rates?.image_hz, data.battery_v,
        nis ? nis.value / nis.degrees : NaN, low, high, data.landmarks);
    for (const device of ['odometer', 'camera', 'recorder', 'realtime']) this.#deviceIs(device, `${data[device] ?? ''}`, finite(t) ? t : 0);
    if (finite(t)) this.#healthIs(t, healths[data.health] ?? 'starting', `${data.reason ?? ''}`);
    this.status = data;
    this.health = data.health;  // valid even if no further pose arrives
  }

  #deviceIs(name, text, t) {
    const known = this.devices.get(name);
    const worked = known?.worked || text.startsWith('running');
    if (known?.text !== text) this.devices.set(name, { text, since: t, atLeast: known === undefined, worked });
  }

  take_picture(data) {
    if (!Number.isInteger(data.seq)) throw new TypeError('a number was expected');
    this.picture = data;
  }

  /// Takes a journal line; a new stream repeats the older lines.
  take_journal({ t, text, level, sent_us }) {
    if (typeof text !== 'string') throw new TypeError('a text was expected');
    const key = finite(sent_us) ? `${sent_us} ${text}` : null;
    if (key !== null && this.journal.some((line) => line.key === key)) return;
    this.note(text, ['info', 'warning', 'error'].includes(level) ? level : 'info', t, key);
  }

  note(text, level, t = this.now, key = null) {
    this.journal.push({ t, text, level, key, at: new Date() });
    if (this.journal.length > most.lines) this.journal.shift();
  }

  /// A sign of life of the server.
  take_beat() {}

  take_silence({ since_s, trouble = '' }) {
    this.silent_s = finite(since_s) ? since_s : 0;
    this.silent_why = `${trouble}`;
  }

  take_restarted() {
    this.clear();
  }

  take_missed({ n }) {
    this.missed += finite(n) ? n : 1;
  }
}
