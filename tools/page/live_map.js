// The map of a live robot: older parts are cached as pictures, and new parts are drawn on top.

import { Surface } from './canvas.js';
import { cameraAt } from './expectations.js';
import { drawRays } from './fates.js';
import { MapCache } from './map_cache.js';
import { steerMap } from './map_hands.js';
import { drawGrid, drawPath, drawRobot, ellipse, landmarkWords, nearestLandmark, paintLandmarks } from './map_layers.js';
import { Ruler } from './map_ruler.js';
import { indexAt } from './time_link.js';
import { healthStyles, trailPainter } from './trail_layer.js';
import { Viewpoint } from './viewpoint.js';
import { element, number } from './words.js';

/// Layers with their switches: key, words, class of the swatch.
export const liveLayers = [['estimate', 'estimate', 's-estimate'], ['truth', 'truth', 's-truth'],
  ['odometry', 'odometry alone', 's-odometry'],
  ['hindsight', 'in hindsight', 's-hindsight'], ['landmarks', 'landmarks, 2σ', 's-landmarks'], ['rays', 'rays', 's-used']];

/// Kinds of landmarks for map_layers.js: confirmed, new and doubted ones, and lamps.
const kinds = [{ name: 'confirmed', colour: '#009e73', marker: 'disc' }, { name: 'new', colour: '#cc79a7', marker: 'diamond' },
  { name: 'doubted', colour: '#d55e00', marker: 'wedge' }];
const lamp = { name: 'lamp', colour: '#d99a00', marker: 'square' };

const glide_ms = 300, lookAgain_ms = 700;

export class LiveMap {
  /// `moded(mode)` receives the mode of the view: "all" shows everything, "follow" follows the robot, "free" is set by
  /// the user.
  constructor(store, link, moded = () => {}) {
    this.store = store;
    this.link = link;
    this.moded = moded;
    this.drawn = () => {};  // called after each frame
    this.mode = 'all';
    this.view = new Viewpoint();
    this.ruler = new Ruler();
    this.shown = new Set(liveLayers.map(([key]) => key));
    this.canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': 'Map' });
    this.place = element('span', { class: 'place number' });
    this.surface = new Surface(this.canvas, (context, width, height) => this.#frame(context, width, height), true);
    this.ways = this.#ways();
    this.landmarks = new MapCache((context, view, colours) => this.#paintMap(context, view, colours));
    this.#listen();
    link.listen(() => this.surface.redraw());
  }

  #ways() {
    const { store } = this;
    const all = [['odometry', trailPainter(store.poses, ['odom_x', 'odom_y'], [{ colour: 'odometry', width: 1.3, dash: [5, 4] }])],
      ['truth', trailPainter(store.truth, ['x', 'y'], [{ colour: 'truth', width: 1.2, dash: [] }])],
      ['estimate', trailPainter(store.poses, ['x', 'y'], healthStyles)]];
    return new MapCache(
      function* paint(context, view, colours) {
        const ends = [];
        for (const [key, [paintWay]] of all) ends.push(this.shown.has(key) ? yield* paintWay(context, view, colours) : null);
        return ends;
      }.bind(this),
      (context, view, colours, ends) => all.map(([, [, append]], i) => 
        (ends[i] === null ? null : append(context, view, colours, ends[i]))));
  }

  *#paintMap(context, view, colours) {
    const { path, map, hello } = this.store;
    if (this.shown.has('hindsight') && path.length > 0)
      drawPath(context, view, path.map(([, x]) => x), path.map(([, , y]) => y), 0, path.length, colours.hindsight, 1.4, [2, 3]);
    if (!this.shown.has('landmarks')) return;
    const up = hello?.rig?.looks_up === true;
    yield* paintLandmarks(context, view, { kinds: up ? [lamp, ...kinds.slice(1)] : kinds, landmarks: map.landmarks }, colours);
  }

  #listen() {
    steerMap(this.canvas, this.view, () => this.become('free'), {
      fit: () => this.become('all'),
      point: (x, y) => {
        this.place.textContent = x === undefined ? '' : `${this.#landmarkAt(x, y)}${number(x, 2)}, ${number(y, 2)} m`;
      },
      press: (x, y, phase) => {
        if (this.ruler.on) this.surface.redraw();
        return this.ruler.press(x, y, phase);
      },
    });
  }

  /// The tooltip of the landmark at the pointer.
  #landmarkAt(x, y) {
    const { map: { landmarks }, now } = this.store, nearest = nearestLandmark(landmarks, x, y, this.view.scale);
    if (nearest === null || !this.shown.has('landmarks')) return '';
    const { id, label, covariance: [xx, xy, yy], last_seen, state } = nearest;
    const two_sigma_m = 2 * Math.sqrt(Math.max(0, (xx + yy) / 2 + Math.hypot((xx - yy) / 2, xy)));
    const seen = Number.isFinite(last_seen) ? `, last seen ${number(Math.max(0, now - last_seen), 0)} s ago` : '';
    return `${landmarkWords('landmark', label, id)}${state && state !== 'confirmed' ? `, ${state}` : ''}, ±${number(two_sigma_m, 2)} m${seen} · `;
  }

  become(mode) {
    this.mode = mode;
    this.aim = null;
    this.looked_ms = 0;
    this.moded(mode);
    this.surface.redraw();
  }

  toggle(key) {
    if (!this.shown.delete(key)) this.shown.add(key);
    this.surface.redraw();
    return this.shown.has(key);
  }

  /// The pose at the cursor: { x, y, heading, covariance, health }, or null.
  poseAt(seconds) {
    const { poses } = this.store;
    if (poses.length === 0) return null;
    const i = indexAt(poses.get('t'), seconds), of = (name) => poses.get(name)[i];
    return { t: of('t'), x: of('x'), y: of('y'), heading: of('heading'), covariance: [of('xx'), of('xy'), of('yy')],
      health: of('health'), two_sigma_m: of('two_sigma_m') };
  }

  shownPose() {
    return this.poseAt(this.link.cursor);
  }

  #bounds() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const take = (x, y) => {
      box[0] = Math.min(box[0], x), box[1] = Math.min(box[1], y), box[2] = Math.max(box[2], x), box[3] = Math.max(box[3], y);
    };
    const xs = this.store.poses.get('x'), ys = this.store.poses.get('y');
    for (let i = 0; i < xs.length; ++i) take(xs[i], ys[i]);
    for (const { at, covariance } of this.store.map.landmarks) if (covariance[0] + covariance[2] < 1) take(...at);
    return box[0] <= box[2] ? box : [-3, -3, 3, 3];
  }

  /// Keeps everything in sight. The view only moves when the content exceeds it or has become small in it.
  #keepAll(now_ms) {
    if (now_ms - (this.looked_ms ?? 0) < lookAgain_ms && this.view.scale) return;
    this.looked_ms = now_ms;
    const wanted = this.view.copy();
    wanted.fit(this.#bounds());
    if (!this.view.scale) return void Object.assign(this.view, { scale: wanted.scale, centre: wanted.centre });
    const off_px = Math.hypot(wanted.centre[0] - this.view.centre[0], wanted.centre[1] - this.view.centre[1]) * wanted.scale;
    if (Math.abs(Math.log(wanted.scale / this.view.scale)) < 0.02 && off_px < 8) return;
    this.aim = { from: this.view.copy(), to: wanted, since: now_ms };
  }

  #move(now_ms) {
    if (this.mode === 'all') this.#keepAll(now_ms);
    if (!this.view.scale) this.view.fit(this.#bounds());
    const pose = this.mode === 'follow' ? this.poseAt(this.link.cursor) : null;
    if (pose) this.view.centre = [pose.x, pose.y];
    if (!this.aim) return;
    const glide = matchMedia('(prefers-reduced-motion: reduce)').matches ? 1 : glide_ms;
    const { from, to, since } = this.aim, part = Math.min(1, (now_ms - since) / glide), eased = part * part * (3 - 2 * part);
    this.view.scale = from.scale * (to.scale / from.scale) ** eased;
    this.view.centre = [0, 1].map((axis) => from.centre[axis] + eased * (to.centre[axis] - from.centre[axis]));
    if (part === 1) this.aim = null;
  }

  #frame(context, width, height) {
    this.view.width = width, this.view.height = height;
    this.#move(performance.now());
    const { view, store } = this, { colours } = this.surface, ratio = window.devicePixelRatio || 1;
    drawGrid(context, view, colours);
    const shown = `${[...this.shown].sort()} ${colours.text}`;
    const waysDue = this.ways.draw(context, view, ratio, colours, `${store.poses.generation} ${store.truth.generation} ${shown}`);
    const mapDue = this.landmarks.draw(context, view, ratio, colours, `${store.map.version} ${store.path.length} ${shown}`);
    this.#drawNow(context, view, colours);
    if (waysDue || mapDue || this.aim) this.surface.redraw();
    this.drawn();
  }

  /// Draws the same content on any context, in one go.
  paint(context, width, height) {
    const view = this.view.copy(), { colours } = this.surface;
    view.width = width, view.height = height;
    drawGrid(context, view, colours);
    for (const cache of [this.ways, this.landmarks]) for (const part of cache.paint(context, view, colours)) void part;
    this.#drawNow(context, view, colours);
  }

  #drawNow(context, view, colours) {
    const { store, link } = this, pose = this.poseAt(link.cursor);
    if (this.shown.has('truth') && store.truth.length > 0) {
      const i = indexAt(store.truth.get('t'), link.cursor);
      drawRobot(context, view, ...['x', 'y', 'heading'].map((name) => store.truth.get(name)[i]), 'transparent', colours.truth);
    }
    if (pose) {
      if (this.shown.has('rays') && link.following && store.bearings)
        drawRays(context, view, cameraAt(this.poseAt(store.bearings.t) ?? pose, store.hello?.rig?.position_m),
          store.bearings.bearings, store.map.byId, colours);
      this.#drawRobot(context, view, pose, colours);
    }
    this.ruler.draw(context, view, colours);
  }

  #drawRobot(context, view, pose, colours) {
    const colour = colours[healthStyles[pose.health]?.colour ?? 'estimate'];
    context.fillStyle = context.strokeStyle = colour;
    if (ellipse(context, view, pose.x, pose.y, pose.covariance)) {
      context.globalAlpha = 0.22;
      context.fill();
      context.globalAlpha = 1;
      context.lineWidth = 1.4;
      context.stroke();
    }
    drawRobot(context, view, pose.x, pose.y, pose.heading, colour, colours.card, 1.3);
  }
}
