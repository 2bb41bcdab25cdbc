// The panorama of all directions: the bearings of the newest image and the expected bearings of landmarks.

import { Surface } from './canvas.js';
import { countFates, drawMark, fateOf, fates } from './fates.js';
import { LabelRoom } from './label_room.js';
import { healths } from './live_store.js';
import { Unrolled } from './unrolled.js';
import { element } from './words.js';

const side = 10, foot = 18, head = 27, strip = 96;
const nameHeight_px = 11;
/// With more bearings than this, names are not drawn because few would have room.
const mostNames = 60;
const sides = [[Math.PI, '±180°'], [Math.PI / 2, '90° left'], [0, 'ahead'], [-Math.PI / 2, '90° right'], [-Math.PI, '±180°']];

export class Panorama {
  constructor(store) {
    this.store = store;
    this.unrolled = new Unrolled();
    this.pictured = false;
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

  /// Shows the newest picture, or null. The panorama only contains the picture if the rig describes the image geometry.
  show(image, picture = null) {
    const { rig } = this.store.hello ?? {};
    this.pictured = image !== null && rig?.image
      ? this.unrolled.take(image, { ...rig.image, looksUp: rig.looks_up === true }, picture) : false;
    this.canvas.classList.toggle('pictured', this.pictured);
    this.surface.redraw();
  }

  #draw(context, width, height) {
    const { colours } = this.surface, { bearings = [], expected = [] } = this.store.bearings ?? {};
    this.x = (azimuth) => width / 2 - (azimuth / Math.PI) * (width / 2 - side);
    this.top = this.pictured ? strip + head : head;
    this.y = this.#heights(bearings, expected, height);
    this.room = new LabelRoom();
    if (this.pictured) this.#drawPicture(context, width, expected, bearings);
    this.#drawAxes(context, height, colours);
    for (const one of expected) this.#drawExpected(context, one, height, colours);
    if (expected.length <= mostNames) this.#nameExpected(context, expected, height, colours);
    for (const [azimuth, elevation, , , fate] of bearings)
      drawMark(context, this.x(azimuth), this.y(elevation), fateOf(fate), colours, bearings.length > 150 ? 2.5 : 4.5);
    if (bearings.length <= mostNames) this.#nameSeen(context, bearings, expected, height, colours);
    this.#tell(bearings, expected);
  }

  /// Names the bearings without an expectation, such as all bearings of a lost robot, below their marks: with their
  /// landmark or with the identity from the camera.
  #nameSeen(context, bearings, expected, height, colours) {
    const named = new Set(expected.map(([id]) => id));
    context.fillStyle = colours.faint;
    context.textAlign = 'center';
    for (const bearing of bearings)
      if (!named.has(bearing[5])) this.#write(context, this.seenName(bearing), this.x(bearing[0]), Math.min(height - foot - 2, this.y(bearing[1]) + 16), 1);
  }

  /// Names the expected bearings above their bands, in two rows.
  #nameExpected(context, expected, height, colours) {
    context.fillStyle = colours.faint;
    context.textAlign = 'center';
    for (const [id, azimuth, , elevation] of [...expected].sort(([, a], [, b]) => b - a))
      this.#write(context, this.#label(id), this.x(azimuth), this.#bandOf(elevation, height)[0] - 3, -1);
  }

  /// Writes a name centred on `x` above `y` if it touches no other name, else one row farther away, else not at all.
  #write(context, words, x, y, away) {
    if (words === '') return;
    const width = context.measureText(words).width + 3, rows = [y, y + away * nameHeight_px];
    const found = this.room.first(rows.map((row) => [x - width / 2, row - nameHeight_px + 1]), width, nameHeight_px);
    if (found) context.fillText(words, x, found[1] + nameHeight_px - 1);
  }

  seenName([, , identity, , , id]) {
    if (identity >= 0) return `${identity}`;
    return Number.isInteger(id) ? this.#label(id) : '';
  }

  #label(id) {
    return this.store.map.byId?.get(id)?.label ?? '';
  }

  /// The height of a mark by its elevation; without elevations, all marks are in the middle.
  #heights(bearings, expected, height) {
    const known = [...bearings.map((bearing) => bearing[1]), ...expected.map((one) => one[3])].filter(Number.isFinite);
    const middle = (this.top + height - foot) / 2;
    if (known.length === 0) return () => middle;
    const low = Math.min(...known) - 0.05, high = Math.max(...known) + 0.05;
    return (elevation) => (Number.isFinite(elevation)
      ? height - foot - ((elevation - low) / (high - low)) * (height - foot - this.top) : middle);
  }

  /// Draws the unrolled picture with the same directions. Expected and observed bearings are marked at its edges only.
  #drawPicture(context, width, expected, bearings) {
    const { colours } = this.surface;
    context.drawImage(this.unrolled.strip, side, 0, width - 2 * side, strip);
    const mark = (azimuth, from, to) => {
      const x = Math.round(this.x(azimuth)) + 0.5;
      context.moveTo(x, from), context.lineTo(x, to);
    };
    context.lineWidth = 2;
    context.strokeStyle = colours.estimate;
    context.beginPath();
    for (const [, azimuth] of expected) mark(azimuth, 0, 12);
    context.stroke();
    for (const [azimuth, , , , fate] of bearings) {
      context.strokeStyle = colours[fateOf(fate).colour];
      context.beginPath(), mark(azimuth, strip - 12, strip), context.stroke();
    }
  }

  #drawAxes(context, height, colours) {
    context.lineWidth = 1;
    for (const [azimuth, words] of sides) {
      const x = Math.round(this.x(azimuth)) + 0.5;
      context.strokeStyle = azimuth === 0 ? colours.axis : colours.grid;
      context.beginPath(), context.moveTo(x, this.top - 6), context.lineTo(x, height - foot), context.stroke();
      context.fillStyle = colours.faint;
      context.textAlign = azimuth > 3 ? 'left' : azimuth < -3 ? 'right' : 'center';
      context.fillText(words, azimuth > 3 ? x - 4 : azimuth < -3 ? x + 4 : x, height - 5);
    }
  }

  /// Draws an expected bearing: a band of two standard deviations to each side, and the gate as a bracket if it is
  /// known.
  #drawExpected(context, [, azimuth, sigma, elevation, gate], height, colours) {
    const x = this.x(azimuth), half = Math.max(1.5, Math.abs(this.x(2 * sigma) - this.x(0)));
    const [top, low] = this.#bandOf(elevation, height);
    context.fillStyle = colours.band;
    context.fillRect(x - half, top, 2 * half, low - top);
    context.fillStyle = colours.estimate;
    context.fillRect(x - 0.5, top, 1, low - top);
    if (Number.isFinite(gate)) this.#drawGate(context, x, Math.abs(this.x(Math.min(gate, Math.PI)) - this.x(0)), top, low, colours);
  }

  /// The upper and the lower end of the band.
  #bandOf(elevation, height) {
    if (!Number.isFinite(elevation)) return [this.top, height - foot];
    const y = this.y(elevation);
    return [Math.max(this.top - 4, y - 14), Math.min(height - foot, y + 14)];
  }

  #drawGate(context, x, half, top, low, colours) {
    context.strokeStyle = colours.axis;
    context.lineWidth = 1;
    context.beginPath();
    for (const side of [-1, 1]) {
      const at = Math.round(x + side * half) + 0.5;
      for (const end of [top, low]) context.moveTo(at - 3 * side, end), context.lineTo(at, end);
      context.moveTo(at, top), context.lineTo(at, low);
    }
    context.stroke();
  }

  #lostWords(bearings) {
    if (healths[this.store.pose?.health] !== 'lost') return '';
    const named = bearings.some((bearing) => this.seenName(bearing) !== '');
    return `Lost: the map cannot tell where landmarks should be.${named ? ' Numbers: what the camera calls what it sees.' : ''}`;
  }

  #tell(bearings, expected) {
    const about = expected.length === 0 ? this.#lostWords(bearings) : this.store.bearings.own ? 'Bands: where the estimator expected landmarks, 2σ; brackets: its gates.'
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
