// A bar with the health over time. Colour and height show the health; a table has the reasons.

import { Surface } from './canvas.js';
import { scale, timeTicks } from './scale.js';
import { chartMargins, clock, drawCursor, steerTime } from './time_chart.js';
import { duration, element, number } from './words.js';

/// Filled share of the bar's height.
const heights = { starting: 0.25, tracking: 0.4, degraded: 0.7, lost: 1 };

export class HealthBar {
  /// `stretches` are consecutive [{ from, to, health, reason }], which may grow. `times()` returns the times of the
  /// steps.
  constructor(stretches, times, link, shown = stretches.map(({ health }) => health)) {
    this.stretches = stretches;
    this.link = link;
    this.state = element('b', { class: 'state' });
    this.reason = element('span', { class: 'faint' });
    this.canvas = element('canvas', { tabindex: '0', role: 'img', 'aria-label': this.#words() });
    const legend = Object.keys(heights).filter((health) => shown.includes(health))
      .map((health) => element('span', {}, element('i', { class: `swatch box s-${health}` }), health));
    const head = element('div', { class: 'head' }, element('h3', {}, 'Health'), this.state, this.reason,
      element('div', { class: 'legend' }, ...legend));
    this.node = element('section', { class: 'card chart health' }, head, this.canvas);
    this.surface = new Surface(this.canvas, (context, width, height) => this.#draw(context, width, height));
    steerTime(this.canvas, link, times);
    this.canvas.addEventListener('pointermove', (event) => {
      const wide = this.canvas.clientWidth - chartMargins.left - chartMargins.right;
      const stretch = this.at(link.from + ((event.offsetX - chartMargins.left) / wide) * link.span);
      if (stretch) this.canvas.title = `${stretch.health}, ${duration(stretch.to - stretch.from)}${stretch.reason ? `\n${stretch.reason}` : ''}`;
    });
    link.listen(() => this.surface.redraw());
  }

  at(seconds) {
    return this.stretches.find(({ to }) => seconds < to) ?? this.stretches.at(-1);
  }

  #words() {
    const worst = this.stretches.filter(({ health }) => health === 'lost' || health === 'degraded');
    return `Health over time: ${this.stretches.length} stretches, ${worst.length} of them degraded or lost; ` +
      'the table below lists them.';
  }

  #draw(context, width, height) {
    const { link } = this, { colours } = this.surface;
    const x = scale(link.from, link.to, chartMargins.left, width - chartMargins.right), foot = height - 16;
    context.fillStyle = colours.grid;
    context.fillRect(chartMargins.left, 2, width - chartMargins.left - chartMargins.right, foot - 2);
    // The worst health is drawn last, so that its neighbours do not hide a short stretch.
    for (const health of Object.keys(heights)) {
      context.fillStyle = colours[health];
      const top = foot - heights[health] * (foot - 2);
      for (const stretch of this.stretches) {
        if (stretch.health !== health || stretch.to < link.from || stretch.from > link.to) continue;
        const from = Math.max(chartMargins.left, x(stretch.from)), to = Math.min(width - chartMargins.right, x(stretch.to));
        context.fillRect(from, top, Math.max(1, to - from), foot - top);
      }
    }
    context.fillStyle = colours.faint;
    context.textAlign = 'center';
    const times = timeTicks(link.from, link.to, width / 90);
    for (const seconds of times) context.fillText(clock(seconds, times), Math.min(width - 18, x(seconds)), height - 3);
    drawCursor(context, x(link.cursor), foot, colours);
    const now = this.at(link.cursor);
    if (!now) return;
    this.state.className = `state ${now.health}`;
    this.state.textContent = now.health;
    this.reason.textContent = now.reason;
  }
}

/// A table of all stretches; a click on a time moves the cursor there.
export function healthTable(stretches, link) {
  const rows = stretches.map(({ from, to, health, reason }) => element('tr', {},
    element('td', { class: 'number' },
      element('button', { type: 'button', onclick: () => link.moveTo(from) }, `${number(from, 1)} s`)),
    element('td', { class: 'number' }, duration(to - from)),
    element('td', {}, element('span', { class: `state ${health}` }, health)),
    element('td', {}, reason)));
  const heads = ['from', 'for', 'health', 'reason'].map((words, i) =>
    element('th', { scope: 'col', class: i < 2 ? 'number' : undefined }, words));
  return element('details', { class: 'card' }, element('summary', {}, `Health and its reasons (${stretches.length})`),
    element('div', { class: 'scroll', tabindex: '0' }, element('table', {},
      element('thead', {}, element('tr', {}, ...heads)), element('tbody', {}, ...rows))));
}
