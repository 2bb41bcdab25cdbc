// Charts of a comparison: mean changes by tag with their intervals, and the values of all runs before and now.

import { Surface } from './canvas.js';
import { decimalsOf, scale, step, ticks } from './scale.js';
import { element, number, withUnit } from './words.js';

const rowHeight = 24, labelWidth = 150, edge = 14;

/// Formats a value, and a change as "+23.0 %" or in the unit of the figure; a positive change is worse.
export function valueWords(figure, value) {
  if (value === null || value === undefined) return '–';
  return withUnit(number(figure.shown_factor * value, figure.decimals), figure.unit);
}

const changeFactor = ({ by_ratio, shown_factor }) => (by_ratio ? 100 : shown_factor);
const changeUnit = ({ by_ratio, unit }) => (by_ratio ? '%' : unit);

export function changeWords(figure, change) {
  if (change === null || change === undefined) return '–';
  const size = number(changeFactor(figure) * change, figure.by_ratio ? 1 : figure.decimals);
  return withUnit(`${change > 0 ? '+' : ''}${size}`, changeUnit(figure));
}

const trendColour = { worse: 'lost', better: 'tracking', 'not judged': 'degraded', 'no longer measured': 'lost' };

function chartCard(title, words, draw) {
  const canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': title });
  const told = element('span', { class: 'faint number' }, words);
  const node = element('section', { class: 'card chart changes' },
    element('div', { class: 'head' }, element('h3', {}, title), told), canvas);
  return { canvas, told, node, surface: new Surface(canvas, draw) };
}

/// A chart with a row for each group: the mean change and its 95 % interval.
export class IntervalChart {
  constructor(groups) {
    this.groups = groups;
    const made = chartCard('Mean change by tag', 'with 95 %; to the right is worse', (context, width, height) => this.#draw(context, width, height));
    this.surface = made.surface, this.node = made.node, this.canvas = made.canvas;
  }

  show(figure) {
    this.figure = figure;
    this.rows = this.groups.filter(({ figures }) => figures[figure.key]?.change !== null && figures[figure.key] !== undefined);
    this.canvas.style.height = `${edge + rowHeight * this.rows.length}px`;
    this.node.hidden = this.rows.length === 0;
    this.surface.redraw();
  }

  #draw(context, width, height) {
    const { figure, rows, surface: { colours } } = this, factor = changeFactor(figure);
    const shown = rows.map(({ tag, figures }) => ({ tag: tag ?? 'all runs', ...figures[figure.key] }));
    const all = shown.flatMap(({ change, low, high }) => [change, low, high]).filter((value) => value !== null).map((value) => value * factor);
    const most = Math.max(figure.by_ratio ? 1 : 1e-3, ...all.map(Math.abs)) * 1.1;
    const x = scale(-most, most, labelWidth, width - edge), bottomEdge = height - edge - 4;
    const pitch = bottomEdge / Math.max(1, shown.length), by = step(2 * most, 6);
    context.textAlign = 'center';
    for (const tick of ticks(-most, most, 6)) {
      context.fillStyle = Math.abs(tick) < 1e-9 ? colours.axis : colours.grid;
      context.fillRect(x(tick), 0, 1, bottomEdge);
      context.fillStyle = colours.faint;
      context.fillText(number(tick, decimalsOf(by)), x(tick), height - 3);
    }
    shown.forEach(({ tag, change, low, high, trend, pairs }, i) => {
      const y = pitch * (i + 0.5), colour = colours[trendColour[trend] ?? 'estimate'];
      context.textAlign = 'left';
      context.fillStyle = colours.text;
      context.fillText(`${tag} (${pairs})`, 0, y + 4, labelWidth - 8);
      context.fillStyle = colour;
      if (low !== null) context.fillRect(x(low * factor), y - 1.5, Math.max(1, x(high * factor) - x(low * factor)), 3);
      context.beginPath();
      context.arc(x(change * factor), y, 4.5, 0, 2 * Math.PI);
      context.fill();
    });
  }
}

/// A chart with a column for each run: the value now, and the value before as a tick.
export class RunsChart {
  constructor(runs) {
    this.runs = runs;
    const made = chartCard('Run by run', '', (context, width, height) => this.#draw(context, width, height));
    this.surface = made.surface, this.node = made.node, this.told = made.told;
    made.canvas.addEventListener('pointermove', (event) => this.#point(event.offsetX / made.canvas.clientWidth));
  }

  show(figure) {
    this.figure = figure;
    this.shown = this.runs.filter(({ figures }) => typeof figures[figure.key]?.after === 'number');
    this.node.hidden = this.shown.length === 0;
    this.told.textContent = 'in the order of the table; bars: now, lines: before';
    this.surface.redraw();
  }

  #point(part) {
    const at = Math.floor(((part * this.surface.canvas.clientWidth - 46) / (this.surface.canvas.clientWidth - 46)) * this.shown.length);
    const run = this.shown[Math.max(0, Math.min(this.shown.length - 1, at))];
    const { before, after, trend } = run.figures[this.figure.key];
    const was = before === null ? '' : `, was ${valueWords(this.figure, before)}: ${trend}`;
    this.told.textContent = `${run.name}: ${valueWords(this.figure, after)}${was}`;
  }

  #draw(context, width, height) {
    const { figure, shown, surface: { colours } } = this, factor = figure.shown_factor;
    const values = shown.map(({ figures }) => figures[figure.key]);
    const most = Math.max(1e-9, ...values.flatMap(({ before, after }) => [before ?? 0, after]).map((value) => value * factor)) * 1.05;
    const y = scale(0, most, height - 6, 6), pitch = (width - 46) / Math.max(1, shown.length), by = step(most, 4);
    context.textAlign = 'right';
    for (const tick of ticks(0, most, 4)) {
      context.fillStyle = colours.grid;
      context.fillRect(46, y(tick), width - 46, 1);
      context.fillStyle = colours.faint;
      context.fillText(number(tick, decimalsOf(by)), 40, y(tick) + 4);
    }
    values.forEach(({ before, after, trend }, i) => {
      const x = 46 + pitch * i, wide = Math.max(1, pitch * 0.7);
      context.fillStyle = colours[trendColour[trend] ?? 'estimate'];
      context.fillRect(x, y(after * factor), wide, Math.max(1, y(0) - y(after * factor)));
      context.fillStyle = colours.text;
      if (before !== null) context.fillRect(x, y(before * factor) - 1, wide, 2);
    });
  }
}
