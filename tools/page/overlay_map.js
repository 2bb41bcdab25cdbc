// Several runs in one map, each with its own colour and dashes.

import { Surface } from './canvas.js';
import { steerMap } from './map_hands.js';
import { drawGrid, drawLandmarks, drawPath, drawRobot } from './map_layers.js';
import { indexAt } from './time_link.js';
import { Viewpoint } from './viewpoint.js';
import { element, number } from './words.js';

/// The colours are distinguishable for colour-blind users. live.css has the same colours for the swatches.
const runStyles = [{ colour: '#1f6feb', dash: [] }, { colour: '#d55e00', dash: [9, 4] }, { colour: '#009e73', dash: [2, 3] },
  { colour: '#cc79a7', dash: [9, 3, 2, 3] }];

export class OverlayMap {
  /// `runs` are as in report.js, each in the frame of its own map. The view follows `link`.
  constructor(runs, link) {
    this.runs = runs.map((run, i) => ({ run, ...runStyles[i % runStyles.length] }));
    this.link = link;
    this.view = new Viewpoint();
    this.hidden = new Set();
    this.canvas = element('canvas', { tabindex: '0', role: 'img',
      'aria-label': `${runs.length} runs over each other. Arrow keys move the map, plus and minus zoom, R turns it.` });
    this.place = element('span', { class: 'faint number' });
    const fit = () => { this.view.scale = null, this.surface.redraw(); };
    this.node = element('section', { class: 'card map', 'aria-label': 'Over each other' }, element('div', { class: 'layers' },
      element('h2', {}, 'Over each other'),
      ...this.runs.map((one, i) => this.#chip(one, i)), element('span', { class: 'right-end' }, this.place,
        element('button', { type: 'button', onclick: fit, title: 'Show everything (0)' }, 'Fit'))), this.canvas);
    this.surface = new Surface(this.canvas, (context, width, height) => this.paint(context, width, height));
    const point = (x, y) => { this.place.textContent = x === undefined ? '' : `${number(x, 2)}, ${number(y, 2)} m`; };
    steerMap(this.canvas, this.view, () => this.surface.redraw(), { fit, point });
    link.listen(() => this.surface.redraw());
  }

  #chip({ run }, i) {
    const onclick = (event) => {
      if (!this.hidden.delete(run)) this.hidden.add(run);
      event.currentTarget.setAttribute('aria-pressed', !this.hidden.has(run));
      this.surface.redraw();
    };
    return element('button', { type: 'button', class: 'chip', 'aria-pressed': 'true', onclick },
      element('span', { class: `swatch s-run${i % runStyles.length}` }), run.name);
  }

  #frame() {
    const box = [Infinity, Infinity, -Infinity, -Infinity];
    const take = ([x, y]) => {
      if (x === null || y === null) return;
      box[0] = Math.min(box[0], x), box[1] = Math.min(box[1], y), box[2] = Math.max(box[2], x), box[3] = Math.max(box[3], y);
    };
    for (const { run: { series, map } } of this.runs) {
      series.x.forEach((x, i) => take([x, series.y[i]]));
      for (const { at, covariance, settled } of map.landmarks) if (settled && covariance[0] + covariance[2] < 1) take(at);
    }
    this.view.fit(box[0] <= box[2] ? box : [-5, -5, 5, 5]);
  }

  /// Draws the content of the canvas on any context of this size.
  paint(context, width, height) {
    const { view } = this, { colours } = this.surface;
    view.width = width, view.height = height;
    if (!view.scale) this.#frame();
    drawGrid(context, view, colours);
    const shown = this.runs.filter(({ run }) => !this.hidden.has(run));
    for (const { run: { map }, colour } of shown)
      drawLandmarks(context, view, { ...map, kinds: map.kinds.map((kind) => ({ ...kind, colour })) }, colours);
    for (const { run: { series: { x, y, t } }, colour, dash } of shown) drawPath(context, view, x, y, 0, t.length, colour, 2, dash);
    for (const { run: { series: { x, y, t, heading } }, colour } of shown) {
      const now = indexAt(t, this.link.cursor);
      if (t.length > 0) drawRobot(context, view, x[now], y[now], heading[now], colour, colours.card, 1.2);
    }
  }
}
