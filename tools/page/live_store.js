// What is known of the robot from the events of `azimuth view`. Events that are not as agreed are counted and left out.

import { Columns } from './columns.js';
import { cameraAt, expectations } from './expectations.js';

export const healths = ['starting', 'tracking', 'degraded', 'lost'];

/// Kept at most: rows of the way, of statuses, stretches of health, lines of the journal.
const most = { poses: 100000, statuses: 20000, stretches: 2000, lines: 500 };

const figures = ['t', 'accepted', 'rejected', 'created', 'thinned', 'latency_ms', 'detect_ms', 'pose_hz', 'odometry_hz',
  'image_hz', 'battery_v', 'nis', 'nis_low', 'nis_high', 'landmarks'];

const finite = (...values) => values.every((value) => Number.isFinite(value));
const list = (value) => {
  if (!Array.isArray(value)) throw new TypeError('a list was expected');
  return value;
};

/// Where 95 % of chi-square over its degrees of freedom is (Wilson and Hilferty).
export function meanBounds(degrees) {
  const spread = 2 / (9 * degrees), side = 1.96 * Math.sqrt(spread);
  return [Math.max(0, 1 - spread - side) ** 3, (1 - spread + side) ** 3];
}

/// Of a few dozen landmarks ids may have three digits, as those that did not stay had some too: people get a number that counts
/// those of the map in the order of their ids. Names that the sensor gives stay as they are, and so does what stands beside them.
export function numbersOf(ids, haveNames) {
  if (haveNames) return new Map(ids.map((id) => [id, `${id}`]));
  return new Map([...ids].sort((a, b) => a - b).map((id, i) => [id, `${i + 1}`]));
}

/// A lamp's height beside its number.
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

  /// Everything but the journal, which goes on.
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

  /// How old the newest pose is, as far as that is known: since it came here, and before that on its way. NaN: there is none.
  get poseAge_s() {
    if (!this.pose || !finite(this.poseHeard_ms)) return NaN;
    const onItsWay_s = this.status?.latency_s;
    return (performance.now() - this.poseHeard_ms) / 1e3 + (finite(onItsWay_s) ? Math.max(0, onItsWay_s) : 0);
  }

  /// By odometry, over the last second: an estimate that is corrected jumps. NaN: too little is known.
  get speed_m_per_s() {
    const { poses } = this, t = poses.get('t'), xs = poses.get('odom_x'), ys = poses.get('odom_y'), last = t.length - 1;
    let first = last;
    while (first > 0 && t[last] - t[first] < 1) --first;
    return first >= 0 && t[last] - t[first] > 0.3 ? Math.hypot(xs[last] - xs[first], ys[last] - ys[first]) / (t[last] - t[first]) : NaN;
  }

  /// What the odometer calls its robot: what stands in brackets behind "running".
  get robot() {
    return /^running \((.+)\)$/.exec(this.status?.odometer ?? '')?.[1] ?? '';
  }

  /// Whether anything of a robot has come.
  get isEmpty() {
    return this.poses.length === 0 && this.status === null && this.map.landmarks.length === 0;
  }

  /// Whether it was understood.
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

  /// Those before the newest are left out: steps that end after a prediction was sent.
  #add(t, x, y, heading, health, odom, [xx, xy, yy], sigma_heading_rad) {
    if (!finite(t, x, y) || t <= (this.poses.length > 0 ? this.poses.last('t') : -Infinity)) return;
    const [odomX, odomY] = this.#laidOverMap(odom, x, y, heading);
    const long = Math.sqrt(Math.max(0, (xx + yy) / 2 + Math.hypot((xx - yy) / 2, xy)));
    const way = this.poses.length > 0 ? this.poses.last('way') + Math.hypot(x - this.poses.last('x'), y - this.poses.last('y')) : 0;
    this.poses.push(t, x, y, heading, health, odomX, odomY, xx, xy, yy, 2 * long, (2 * sigma_heading_rad * 180) / Math.PI, way);
    this.#healthIs(t, healths[health] ?? 'starting');
  }

  /// Odometry alone, as if it had gone on from the first pose.
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

  /// Where the daemon does not say what it expected, the map and the pose do, unless the robot is lost.
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
    const t = finite(data.t) ? data.t : this.now;  // not finite before there is anything that has a time
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
    this.health = data.health;  // also when no pose comes any more
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

  /// A stream that begins anew tells again what was told before.
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

  /// Somebody is there.
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
