// All directions round the robot, unrolled: what was seen in the newest image, and where landmarks were expected.

import { Surface } from './canvas.js';
import { countFates, drawMark, fateOf, fates } from './fates.js';
import { element } from './words.js';

const side = 10, foot = 18, head = 16;
const sides = [[Math.PI, '±180°'], [Math.PI / 2, '90° left'], [0, 'ahead'], [-Math.PI / 2, '90° right'], [-Math.PI, '±180°']];

export class Panorama {
  constructor(store) {
    this.store = store;
    this.canvas = element('canvas', { role: 'img', 'aria-label': 'Panorama of bearings' });
    this.about = element('p', { class: 'faint small' });
    this.legend = element('div', { class: 'legend' });
    this.node = element('div', { class: 'panorama' }, element('div', { class: 'head' }, element('h3', {}, 'Panorama'),
      this.legend), this.canvas,
      this.about);
    this.surface = new Surface(this.canvas, (context, width, height) => this.#draw(context, width, height));
    this.counts = new Map(Object.entries(fates).map(([name, { words, colour, sign }]) => {
      const count = element('b', { class: 'number' });
      const node = element('span', { hidden: true }, element('i', { class: `glyph c-${colour}`, 'aria-hidden': 'true' }, sign),
        words, count);
      this.legend.append(node);
      return [name, { node, count }];
    }));
  }

  #draw(context, width, height) {
    const { colours } = this.surface, { bearings = [], expected = [] } = this.store.bearings ?? {};
    this.x = (azimuth) => width / 2 - (azimuth / Math.PI) * (width / 2 - side);
    this.y = this.#heights(bearings, expected, height);
    this.#drawAxes(context, height, colours);
    for (const [id, azimuth, sigma, elevation] of expected) this.#drawGate(context, id, azimuth, sigma, elevation, height, colours);
    for (const [azimuth, elevation, , , fate] of bearings)
      drawMark(context, this.x(azimuth), this.y(elevation), fateOf(fate), colours, bearings.length > 150 ? 2.5 : 4.5);
    this.#tell(bearings, expected);
  }

  /// By elevation where there are any; else all in the middle.
  #heights(bearings, expected, height) {
    const known = [...bearings.map((bearing) => bearing[1]), ...expected.map((one) => one[3])].filter(Number.isFinite);
    const middle = (head + height - foot) / 2;
    if (known.length === 0) return () => middle;
    const low = Math.min(...known) - 0.05, high = Math.max(...known) + 0.05;
    return (elevation) => (Number.isFinite(elevation)
      ? height - foot - ((elevation - low) / (high - low)) * (height - foot - head) : middle);
  }

  #drawAxes(context, height, colours) {
    context.lineWidth = 1;
    for (const [azimuth, words] of sides) {
      const x = Math.round(this.x(azimuth)) + 0.5;
      context.strokeStyle = azimuth === 0 ? colours.axis : colours.grid;
      context.beginPath(), context.moveTo(x, head - 6), context.lineTo(x, height - foot), context.stroke();
      context.fillStyle = colours.faint;
      context.textAlign = azimuth > 3 ? 'left' : azimuth < -3 ? 'right' : 'center';
      context.fillText(words, azimuth > 3 ? x - 4 : azimuth < -3 ? x + 4 : x, height - 5);
    }
  }

  /// Two standard deviations to each side.
  #drawGate(context, id, azimuth, sigma, elevation, height, colours) {
    const x = this.x(azimuth), half = Math.max(1.5, Math.abs(this.x(2 * sigma) - this.x(0))), y = this.y(elevation);
    const top = Number.isFinite(elevation) ? Math.max(head - 4, y - 14) : head,
      low = Number.isFinite(elevation) ? Math.min(height - foot, y + 14) : height - foot;
    context.fillStyle = colours.band;
    context.fillRect(x - half, top, 2 * half, low - top);
    context.fillStyle = colours.estimate;
    context.fillRect(x - 0.5, top, 1, low - top);
    if (this.store.bearings.expected.length > 60) return;
    context.fillStyle = colours.faint;
    context.textAlign = 'center';
    context.fillText(this.store.map.byId?.get(id)?.label ?? `${id}`, x, top - 3);
  }

  #tell(bearings, expected) {
    const about = expected.length === 0 ? '' : this.store.bearings.own ? 'Bands: where the estimator expected landmarks, 2σ.'
      : 'Bands: where map and pose put the landmarks, 2σ at most.';
    if (this.about.textContent !== about) this.about.textContent = about;
    const counts = new Map(countFates(bearings));
    for (const [name, { node, count }] of this.counts) {
      node.hidden = !counts.has(name);
      count.textContent = counts.get(name) ?? 0;
    }
    this.canvas.setAttribute('aria-label', `Panorama: ${expected.length} landmarks expected; bearings: ` +
      ([...counts].map(([name, count]) => `${count} ${fateOf(name).words}`).join(', ') || 'none'));
  }
}
