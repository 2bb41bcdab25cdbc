// The map with the path and the robot at the linked instant; it can be panned and zoomed.

import { Surface } from './canvas.js';
import { drawGrid, drawLandmarks, drawPath, drawRobot, drawTrueLandmarks, ellipse, landmarkWords, nearestLandmark } from './map_layers.js';
import { indexAt } from './time_link.js';
import { steerMap } from './map_hands.js';
import { Viewpoint } from './viewpoint.js';
import { element, number } from './words.js';

/// Layers with their switches: key, words, class of the swatch.
const layers = [['estimate', 'estimate', 's-estimate'], ['truth', 'truth', 's-truth'],
  ['odometry', 'odometry alone', 's-odometry'], ['hindsight', 'in hindsight', 's-hindsight'],
  ['landmarks', 'landmarks, 2σ', 's-landmarks'], ['true_landmarks', 'true landmarks', 's-truth'],
  ['whole', 'whole way', 's-band']];

export class MapView {
  /// `run` is { series, map, health } as in report.js. The view follows `link`.
  constructor(run, link) {
    this.run = run;
    this.link = link;
    this.view = new Viewpoint();
    this.shown = new Set(layers.map(([key]) => key).filter((key) => key !== 'odometry' || !this.#strays()));
    this.canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': this.#words() });
    this.place = element('span', { class: 'faint number' });
    this.node = element('section', { class: 'card map' }, element('div', { class: 'layers' }, ...this.#switches(),
      element('span', { class: 'right-end' }, this.place,
        element('button', { type: 'button', onclick: () => this.fit(), title: 'Show everything (0)' }, 'Fit'))), this.canvas);
    this.surface = new Surface(this.canvas, (context, width, height) => this.paint(context, width, height));
    this.#listen();
    link.listen(() => this.surface.redraw());
  }

  fit() {
    this.view.scale = null;
    this.surface.redraw();
  }

  #has(key) {
    const { series, map } = this.run;
    if (key !== 'landmarks' && key !== 'true_landmarks' && series.t.length === 0) return false;
    if (key === 'truth') return series.truth_x !== undefined;
    if (key === 'hindsight' || key === 'landmarks' || key === 'true_landmarks') return map[key].length > 0;
    return true;
  }

  /// True if the odometry leads so far away that showing it would make everything else small.
  #strays() {
    const { series } = this.run;
    const reach = (values) => values.reduce((most, value) => Math.max(most, Math.abs(value ?? 0)), 0);
    return reach([...series.odometry_x, ...series.odometry_y]) > 3 * reach([...series.x, ...series.y]) + 5;
  }

  #words() {
    const { map, series } = this.run;
    return `Map with ${map.all} ${map.word}s` + (series.t.length > 0
      ? ` and the way of the robot over ${number(series.t.at(-1), 0)} seconds. ` : '. ') +
      'Arrow keys move it, plus and minus zoom, R turns it.';
  }

  #switches() {
    const { word, true_words } = this.run.map;
    const own = { landmarks: `${word}s, 2σ`, true_landmarks: true_words };
    return layers.filter(([key]) => this.#has(key)).map(([key, words, swatch]) => {
      const onclick = (event) => this.#toggle(key, event.currentTarget);
      return element('button', { type: 'button', class: 'chip', 'aria-pressed': this.shown.has(key), onclick },
        element('span', { class: `swatch ${swatch}` }), own[key] ?? words);
    });
  }

  #toggle(key, button) {
    if (!this.shown.delete(key)) this.shown.add(key);
    button.setAttribute('aria-pressed', this.shown.has(key));
    this.surface.redraw();
  }

  #listen() {
    steerMap(this.canvas, this.view, () => this.surface.redraw(), {
      fit: () => this.fit(),
      point: (x, y) => {
        this.place.textContent = x === undefined ? '' : `${this.#landmarkAt(x, y)}${number(x, 2)}, ${number(y, 2)} m`;
      },
    });
  }

  /// The name of the landmark at the pointer.
  #landmarkAt(x, y) {
    const found = nearestLandmark(this.run.map.landmarks, x, y, this.view.scale);
    return found && this.shown.has('landmarks') ? `${landmarkWords(this.run.map.word, found.name, found.id)} · ` : '';
  }

  #frame() {
    const { series, map } = this.run;
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const take = (x, y) => {
      if (x === null || y === null) return;
      box[0] = Math.min(box[0], x), box[1] = Math.min(box[1], y), box[2] = Math.max(box[2], x), box[3] = Math.max(box[3], y);
    };
    series.x.forEach((x, i) => take(x, series.y[i]));
    if (series.truth_x) series.truth_x.forEach((x, i) => take(x, series.truth_y[i]));
    if (this.shown.has('odometry')) series.odometry_x.forEach((x, i) => take(x, series.odometry_y[i]));
    map.true_landmarks.forEach(([x, y]) => take(x, y));
    for (const { at, covariance, settled } of map.landmarks) if (settled && covariance[0] + covariance[2] < 1) take(...at);
    if (box[0] > box[2]) for (const { at } of map.landmarks) take(...at);
    this.view.fit(box[0] <= box[2] ? box : [-5, -5, 5, 5]);
  }

  /// Draws the content of the canvas on any context of this size.
  paint(context, width, height) {
    const { view } = this;
    view.width = width, view.height = height;
    if (!view.scale) this.#frame();
    const { series, map } = this.run, { colours } = this.surface;
    const now = indexAt(series.t, this.link.cursor);
    const whole = this.shown.has('whole');
    const begin = whole ? 0 : indexAt(series.t, this.link.from);
    drawGrid(context, view, colours);
    if (this.shown.has('true_landmarks')) drawTrueLandmarks(context, view, map.true_landmarks, colours);
    const way = (x, y, colour, thick, dash) => {
      context.globalAlpha = 0.28;
      if (whole) drawPath(context, view, x, y, now, series.t.length, colour, thick, dash);
      context.globalAlpha = 1;
      drawPath(context, view, x, y, begin, now + 1, colour, thick, dash);
    };
    if (this.shown.has('odometry')) way(series.odometry_x, series.odometry_y, colours.odometry, 1.3, [5, 4]);
    if (this.shown.has('truth') && series.truth_x) way(series.truth_x, series.truth_y, colours.truth, 1.3, []);
    if (this.shown.has('hindsight')) {
      const [xs, ys] = [0, 1].map((axis) => map.hindsight.map((point) => point[axis]));
      drawPath(context, view, xs, ys, 0, xs.length, colours.hindsight, 1.4, [2, 3]);
    }
    if (this.shown.has('estimate')) way(series.x, series.y, colours.estimate, 2, []);
    if (this.shown.has('landmarks')) drawLandmarks(context, view, map, colours);
    if (series.t.length === 0) return;
    if (series.truth_x && series.truth_x[now] !== null && series.truth_heading[now] !== null)
      drawRobot(context, view, series.truth_x[now], series.truth_y[now], series.truth_heading[now], 'transparent', colours.truth);
    this.#drawNow(context, now, colours);
  }

  #drawNow(context, now, colours) {
    const { series, health } = this.run;
    const state = health.find(({ to }) => this.link.cursor < to) ?? health.at(-1);
    const colour = state?.health === 'tracking' ? colours.estimate : colours[state?.health] ?? colours.estimate;
    context.fillStyle = context.strokeStyle = colour;
    if (ellipse(context, this.view, series.x[now], series.y[now], [series.xx[now], series.xy[now], series.yy[now]])) {
      context.globalAlpha = 0.22;
      context.fill();
      context.globalAlpha = 1;
      context.lineWidth = 1.4;
      context.stroke();
    }
    drawRobot(context, this.view, series.x[now], series.y[now], series.heading[now], colour, colours.card);
  }
}
