// A chart over time with bands, lines and stacked rates, and the common cursor of the page.

import { strokeDense, strokeLine, Surface } from './canvas.js';
import { decimalsOf, logTicks, scale, ticks, timeTicks } from './scale.js';
import { indexAt } from './time_link.js';
import { element, number, short } from './words.js';

const left = 46, right = 8, top = 8, bottom = 18;

/// Moves the cursor and the time range of `link` by mouse, touch and keys on a canvas with a horizontal time axis.
/// `times()` returns the times of the steps.
export function steerTime(canvas, link, times) {
  const at = (event) => link.from + ((event.offsetX - left) / Math.max(1, canvas.clientWidth - left - right)) * link.span;
  let pressed = null;
  canvas.addEventListener('pointerdown', (event) => {
    pressed = event.shiftKey ? { at: event.clientX, from: link.from, to: link.to } : null;
    link.moveTo(at(event));
  });
  canvas.addEventListener('pointermove', (event) => {
    if (event.buttons === 0 && !link.hovers) return;
    if (!pressed || event.buttons === 0) return link.moveTo(at(event));
    const by = ((pressed.at - event.clientX) / Math.max(1, canvas.clientWidth - left - right)) * (pressed.to - pressed.from);
    link.show(pressed.from + by, pressed.to + by);
  });
  canvas.addEventListener('wheel', (event) => {
    if (!event.ctrlKey && Math.abs(event.deltaX) > Math.abs(event.deltaY)) {
      event.preventDefault();
      const by = 0.001 * event.deltaX * link.span;
      link.show(link.from + by, link.to + by);
    } else if (event.ctrlKey || event.altKey) {
      event.preventDefault();
      link.zoom(Math.exp(0.002 * event.deltaY), at(event));
    }
  }, { passive: false });
  canvas.addEventListener('dblclick', () => link.reset());
  canvas.addEventListener('keydown', (event) => steerByKey(event, link, times()));
}

/// Arrows move by a step, with Shift by a twentieth of the shown range; + and - zoom about the cursor, 0 shows
/// everything.
export function steerByKey(event, link, times) {
  const now = indexAt(times, link.cursor), far = event.shiftKey ? link.span / 20 : 0;
  if (event.key === 'ArrowLeft') link.moveTo(far ? link.cursor - far : times[Math.max(0, now - 1)]);
  else if (event.key === 'ArrowRight') link.moveTo(far ? link.cursor + far : times[Math.min(times.length - 1, now + 1)]);
  else if (event.key === 'Home') link.moveTo(link.begin);
  else if (event.key === 'End') link.moveTo(link.end);
  else if (event.key === '+' || event.key === '=') link.zoom(0.7, link.cursor);
  else if (event.key === '-') link.zoom(1 / 0.7, link.cursor);
  else if (event.key === '0' || event.key === 'Escape') link.reset();
  else return;
  event.preventDefault();
}

export class TimeChart {
  /// `spec` is { key, title, unit, times, parts, symmetric, logarithmic, least, near }. With `near` the axis may start
  /// above zero. A part is one of
  ///   { line: values, words, colour, width, dash, opacity }
  ///   { low, high: values, words, mirrored }                  a band; both may be numbers; `mirrored`: low = -high
  ///   { counts: values, words, colour }                       counters since the start; their rates are stacked
  ///   { level: number, colour }                               a horizontal line
  /// Charts with the same key in `group` (a Map) share an axis, so that runs side by side can be compared.
  constructor(spec, link, group = new Map()) {
    this.spec = spec;
    this.link = link;
    this.group = group.get(spec.key) ?? group.set(spec.key, []).get(spec.key);
    this.group.push(this);
    this.values = new Map();
    this.canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': `${spec.title} over time` });
    this.node = element('section', { class: 'card chart' }, element('div', { class: 'head' },
      element('h3', {}, spec.title, ' ', element('span', { class: 'unit' }, spec.unit)), this.#legend()), this.canvas);
    this.surface = new Surface(this.canvas, (context, width, height) => this.#draw(context, width, height));
    steerTime(this.canvas, link, () => spec.times);
    link.listen(() => this.surface.redraw());
  }

  #legend() {
    const legend = element('div', { class: 'legend' });
    for (const part of this.spec.parts) {
      if (!part.words) continue;
      const value = element('b', { class: 'number' });
      this.values.set(part, value);
      const swatch = element('i', { class: `swatch s-${part.colour ?? 'band'} ${part.line ? '' : 'box'}` });
      legend.append(element('span', {}, swatch, part.words, value));
    }
    return legend;
  }

  /// Smallest and largest value of this chart in the shown range, if it has any.
  ownRange() {
    const { spec, link } = this;
    const from = indexAt(spec.times, link.from), to = Math.min(spec.times.length, indexAt(spec.times, link.to) + 2);
    let low = spec.least ?? Infinity, high = spec.least ?? -Infinity;
    const take = (value) => {
      if (value === null || !Number.isFinite(value) || (spec.logarithmic && value <= 0)) return;
      low = Math.min(low, value), high = Math.max(high, value);
    };
    for (const part of spec.parts) {
      if (part.level !== undefined) take(part.level);
      const { line } = part;
      if (line) for (let i = from; i < to; ++i) take(line[i]);
      if (!part.high) continue;
      for (const side of [part.low, part.high])
        (typeof side === 'number' ? [side] : this.#most(side, from, to)).forEach(take);
    }
    const rates = spec.parts.filter((part) => part.counts);
    if (rates.length === 0 || spec.times.length === 0) return [low, high];
    for (const bin of this.#bins(40)) take(rates.reduce((sum, part) => sum + this.#rate(part.counts, bin.from, bin.to), 0));
    return [low, high];
  }

  /// The extent of a band is that of its inner 90 %, because a band without bounds for a while would make all else
  /// small.
  #most(side, from, to) {
    const sorted = side.slice(from, to).filter((value) => value !== null && Number.isFinite(value)).sort((a, b) => a - b);
    const last = sorted.length - 1;
    return last < 0 ? [] : [sorted[Math.floor(0.05 * last)], sorted[Math.ceil(0.95 * last)]];
  }

  #range() {
    const { symmetric, logarithmic, near } = this.spec;
    let low = Infinity, high = -Infinity;
    for (const chart of this.group) {
      if (!chart.node.isConnected) continue;
      const [least, greatest] = chart.ownRange();
      low = Math.min(low, least), high = Math.max(high, greatest);
    }
    if (!(low <= high)) return logarithmic ? [0.1, 10] : [0, 1];
    if (logarithmic) return [low / 1.3, high * 1.3];
    if (symmetric) return [-1.12 * (Math.max(-low, high) || 1), 1.12 * (Math.max(-low, high) || 1)];
    const room = 0.08 * Math.max(high - low, near ? 0.02 * high : 0) || 0.08 * (Math.abs(high) || 1);
    return [low >= 0 && !near ? 0 : low - room, high + room];
  }

  #bins(count) {
    const by = this.link.span / count;
    return Array.from({ length: count }, (_, k) => ({ from: this.link.from + k * by, to: this.link.from + (k + 1) * by }));
  }

  /// The rate between two steps, as if the counter grew evenly.
  #rate(counts, from, to) {
    const { times } = this.spec;
    const by = (seconds) => {
      const i = indexAt(times, seconds), next = Math.min(i + 1, times.length - 1);
      const part = times[next] > times[i] ? Math.min(1, Math.max(0, (seconds - times[i]) / (times[next] - times[i]))) : 0;
      return counts[i] + part * (counts[next] - counts[i]);
    };
    return (by(to) - by(from)) / (to - from);
  }

  #draw(context, width, height) {
    const { spec, link } = this, { colours } = this.surface;
    const [low, high] = this.#range();
    this.x = scale(link.from, link.to, left, width - right);
    this.y = scale(low, high, height - bottom, top, spec.logarithmic);
    drawAxes(context, this, { low, high, width, height, colours, link, logarithmic: spec.logarithmic });
    context.save();
    context.beginPath();
    context.rect(left, top - 4, width - left - right, height - top - bottom + 8);
    context.clip();
    this.#drawRates(context, width);
    for (const part of spec.parts) if (part.high) this.#drawBand(context, part);
    for (const part of spec.parts) if (part.line || part.level !== undefined) this.#drawLine(context, part, width);
    context.restore();
    drawCursor(context, this.x(link.cursor), height - bottom, colours);
    this.#tellValues();
  }

  #drawBand(context, part) {
    const { times } = this.spec, { colours } = this.surface;
    const side = (values, i) => (typeof values === 'number' ? values : values[i]);
    const from = indexAt(times, this.link.from), to = Math.min(times.length, indexAt(times, this.link.to) + 2);
    const known = (value) => value !== null && Number.isFinite(value);
    const whole = (i) => known(side(part.low, i)) && known(side(part.high, i));
    context.fillStyle = colours.band;
    for (let begin = from; begin < to; ++begin) {
      if (!whole(begin)) continue;
      let end = begin;
      while (end + 1 < to && whole(end + 1)) ++end;
      context.beginPath();
      for (let i = begin; i <= end; ++i) context.lineTo(this.x(times[i]), this.y(side(part.high, i)));
      for (let i = end; i >= begin; --i) context.lineTo(this.x(times[i]), this.y(side(part.low, i)));
      context.fill();
      begin = end;
    }
  }

  #drawLine(context, part, width) {
    const { times } = this.spec, { colours } = this.surface;
    context.strokeStyle = colours[part.colour];
    context.lineWidth = part.width ?? 1.4;
    context.globalAlpha = part.opacity ?? 1;
    context.lineJoin = 'round';
    context.setLineDash(part.dash ?? []);
    if (part.level !== undefined) strokeLine(context, 2, (i) => (i ? width - right : left), () => this.y(part.level));
    else {
      const from = indexAt(times, this.link.from), to = Math.min(times.length, indexAt(times, this.link.to) + 2);
      const { line } = part, stroke = to - from > 3 * width ? strokeDense : strokeLine;
      stroke(context, to - from, (i) => this.x(times[from + i]), (i) => this.y(line[from + i]));
    }
    context.setLineDash([]);
    context.globalAlpha = 1;
  }

  #drawRates(context, width) {
    const rates = this.spec.parts.filter((part) => part.counts);
    if (rates.length === 0 || this.spec.times.length === 0) return;
    for (const { from, to } of this.#bins(Math.max(10, Math.floor((width - left - right) / 5)))) {
      let below = 0;
      for (const part of rates) {
        const above = below + this.#rate(part.counts, from, to);
        context.fillStyle = this.surface.colours[part.colour];
        context.fillRect(this.x(from), this.y(above), Math.max(1, this.x(to) - this.x(from) - 1), this.y(below) - this.y(above));
        below = above;
      }
    }
  }

  #tellValues() {
    const { times } = this.spec;
    const now = indexAt(times, this.link.cursor);
    for (const [part, node] of this.values) {
      if (part.line) node.textContent = short(part.line[now]);
      else if (part.counts) node.textContent = number(part.counts[now], 0);
      else if (part.mirrored) node.textContent = `±${short(part.high[now])}`;
      else node.textContent = [part.low, part.high].map((side) => short(typeof side === 'number' ? side : side[now])).join(' … ');
    }
  }
}

function drawAxes(context, { x, y }, { low, high, width, height, colours, link, logarithmic }) {
  context.lineWidth = 1;
  context.fillStyle = colours.faint;
  context.textAlign = 'right';
  context.textBaseline = 'middle';
  const values = logarithmic ? logTicks(low, high) : ticks(low, high, Math.max(2, height / 36));
  const decimals = decimalsOf(values.length > 1 ? Math.abs(values[1] - values[0]) : 1);
  for (const value of values) {
    const at = Math.round(y(value)) + 0.5;
    context.strokeStyle = value === 0 ? colours.axis : colours.grid;
    context.beginPath(), context.moveTo(left, at), context.lineTo(width - right, at), context.stroke();
    context.fillText(logarithmic ? String(Number(value.toPrecision(1))) : number(value, decimals), left - 6, at);
  }
  context.textAlign = 'center';
  context.textBaseline = 'alphabetic';
  const times = timeTicks(link.from, link.to, width / 90);
  for (const seconds of times) context.fillText(clock(seconds, times), Math.min(width - 18, x(seconds)), height - 4);
}

/// Formats seconds, or minutes for long ranges.
export function clock(seconds, all) {
  if (all.at(-1) < 180) return `${Number(seconds.toFixed(1))} s`;
  return `${Math.floor(seconds / 60)}:${String(Math.round(seconds % 60)).padStart(2, '0')}`;
}

export function drawCursor(context, x, height, colours) {
  context.strokeStyle = colours.text;
  context.lineWidth = 1;
  context.globalAlpha = 0.75;
  context.beginPath(), context.moveTo(Math.round(x) + 0.5, 2), context.lineTo(Math.round(x) + 0.5, height), context.stroke();
  context.globalAlpha = 1;
}

export const chartMargins = { left, right };
