// The bar that controls the time: play, speed, single steps, jumps to changes.

import { steerByKey } from './time_chart.js';
import { indexAt } from './time_link.js';
import { element, number } from './words.js';

/// Approximate duration of playing a run, if no speed is chosen.
const playSeconds = 20;
const speeds = [0.5, 1, 2, 5, 10, 20, 50];

/// Moves the cursor from frame to frame; calls `told(playing)` at start and end.
class Player {
  #last = null;

  constructor(link, told) {
    this.link = link;
    this.told = told;
    this.speed = null;  // multiple of real time
  }

  toggle() {
    const { link } = this;
    if (this.#last !== null) return this.#stop();
    if (link.cursor >= link.to - 1e-6) link.moveTo(link.from);
    this.#last = performance.now();
    this.told(true);
    requestAnimationFrame((now) => this.#advance(now));
  }

  #advance(now) {
    if (this.#last === null) return;
    const { link } = this;
    link.moveTo(link.cursor + ((now - this.#last) / 1000) * (this.speed ?? link.span / playSeconds));
    this.#last = now;
    if (link.cursor >= link.to) this.#stop();
    else requestAnimationFrame((then) => this.#advance(then));
  }

  #stop() {
    this.#last = null;
    this.told(false);
  }
}

/// Moves the cursor to the next or previous one of `events` (sorted seconds).
function jump(link, events, forward) {
  const next = forward ? events.find((t) => t > link.cursor + 1e-3) : events.findLast((t) => t < link.cursor - 1e-3);
  if (next !== undefined) link.moveTo(next);
}

function tool(sign, title, onclick) {
  return element('button', { type: 'button', title, 'aria-label': title, onclick }, sign);
}

/// `times` are the times of the steps, `events` the instants for jumps.
export function timeBar(link, times, events) {
  const moments = [...new Set(events)].sort((a, b) => a - b);
  const button = element('button', { type: 'button', title: 'Play (space)', onclick: () => player.toggle() }, 'Play');
  const player = new Player(link, (playing) => { button.textContent = playing ? 'Pause' : 'Play'; });
  const step = (by) => link.moveTo(times[Math.min(times.length - 1, Math.max(0, indexAt(times, link.cursor) + by))]);
  const speed = element('select', { 'aria-label': 'Speed', onchange: () => { player.speed = Number(speed.value) || null; } },
    element('option', { value: '' }, `in ${playSeconds} s`),
      ...speeds.map((rate) => element('option', { value: rate }, `${rate}×`)));
  const range = element('input', { type: 'range', min: link.begin, max: link.end, step: 'any', value: link.cursor,
    'aria-label': 'Time in seconds' });
  const words = element('output', { class: 'number', 'aria-live': 'off' });
  range.addEventListener('input', () => link.moveTo(Number(range.value)));
  range.addEventListener('keydown', (event) => steerByKey(event, link, times));
  document.addEventListener('keydown', (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey) return;
    if (['BUTTON', 'SUMMARY', 'SELECT'].includes(event.target.tagName) || event.target.type === 'checkbox') return;
    if (event.key === ' ' && event.target.tagName !== 'INPUT') player.toggle();
    else if (event.key === 'n') jump(link, moments, true);
    else if (event.key === 'p') jump(link, moments, false);
    else return;
    event.preventDefault();
  });
  link.listen(() => {
    range.value = link.cursor;
    words.textContent = `${number(link.cursor, 2)} s of ${number(link.end, 1)} s`;
  });
  return element('div', { class: 'bar', role: 'toolbar', 'aria-label': 'Time' }, button, speed, tool('◂', 'A step back',
    () => step(-1)),
    tool('▸', 'A step on', () => step(1)), tool('|◂', 'Last change of health (P)', () => jump(link, moments, false)),
    tool('▸|', 'Next change of health (N)', () => jump(link, moments, true)), range, words,
    tool('+', 'Shorter stretch of time', () => link.zoom(0.5, link.cursor)),
    tool('−', 'Longer stretch of time', () => link.zoom(2, link.cursor)), tool('All', 'All of the run', () => link.reset()));
}
