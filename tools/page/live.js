// The page of a live robot, which shows the events of `azimuth view`.
//
// `window.azimuthView` gives tests and the browser's developer tools the store, the map, the link and the frame times.

import { CameraCard } from './camera_card.js';
import { paceSurfaces } from './canvas.js';
import { deviceTroubles, DevicesCard } from './devices_card.js';
import { FrameMeter } from './frame_meter.js';
import { HealthBar } from './health_bar.js';
import { JournalCard } from './journal_card.js';
import { liveCharts, showMeasured } from './live_charts.js';
import { LiveFeed } from './live_feed.js';
import { LiveHead } from './live_head.js';
import { LiveLink } from './live_link.js';
import { LiveMap } from './live_map.js';
import { LiveStore, healths } from './live_store.js';
import { momentWanted } from './map_export.js';
import { MapTools } from './map_tools.js';
import { element, number } from './words.js';

/// Number of charts drawn in a frame beside the map, interval of text updates, and duration of a message.
const chartsInAFrame = 1, wordsEvery_ms = 200, saidFor_ms = 6000;

/// The hints that replace the map while no robot has been received.
function emptyMap() {
  const line = (words, ...commands) => [element('p', {}, words), ...commands.map((command) => element('code', {}, command))];
  return element('div', { class: 'empty', role: 'note', hidden: true }, element('h2', {}, 'No robot yet'),
    ...line('This page shows what azimuthd sends. Start it on the robot, or let it play a recording:', 'sudo systemctl start azimuthd',
      'azimuthd --play RUN'),
    ...line('Does it run, and nothing comes? It and azimuth view need the same LCM address and prefix; this tells what is wrong here:',
      'azimuth doctor'));
}

/// A heading for screen readers.
const unseen = (words) => element('h2', { class: 'unseen' }, words);

class LivePage {
  #said_ms = -Infinity;
  #delays_ms = [];
  #drawnPose = null;

  constructor(root) {
    paceSurfaces(chartsInAFrame);
    this.store = new LiveStore();
    this.link = new LiveLink();
    this.frames = new FrameMeter();
    this.head = new LiveHead();
    this.map = new LiveMap(this.store, this.link);
    this.map.drawn = () => this.#tellDelay();
    this.tools = new MapTools(this.map, (words) => this.say(words));
    this.camera = new CameraCard(this.store);
    this.devices = new DevicesCard(this.store);
    this.journal = new JournalCard(this.store, this.link);
    this.health = new HealthBar(this.store.stretches, () => this.store.poses.get('t'), this.link, healths);
    this.charts = liveCharts(this.store, this.link);
    this.wanted = momentWanted();
    this.#layOut(root);
    this.#listen();
    this.feed = new LiveFeed('events', (kind, data) => this.#take(kind, data), (state, words) => this.#tell(state, words));
    setInterval(() => this.#words(), wordsEvery_ms);
  }

  #layOut(root) {
    this.said = element('div', { class: 'said', role: 'status' });
    this.empty = emptyMap();
    this.nowButton = element('button', { type: 'button', class: 'now-button', title: 'Back to now (L)',
      onclick: () => this.link.follow() }, 'Now');
    const span = (words, seconds) => element('button', { type: 'button', title: `Show ${words} of time`,
      onclick: () => this.#span(seconds) }, words);
    this.clock = element('output', { class: 'number clock', 'aria-label': 'Time shown', 'aria-live': 'off' });
    const bar = element('div', { class: 'time-tools', role: 'toolbar', 'aria-label': 'Time' }, this.nowButton, this.clock,
      span('30 s', 30), span('2 min', 120),
      span('10 min', 600), element('button', { type: 'button', title: 'Show all of it', onclick: () => this.link.reset() }, 'All'));
    const map = element('section', { class: 'card map', id: 'map', 'aria-label': 'Map' },
      unseen('Map'), element('div', { class: 'map-head' }, this.tools.layers, this.tools.tools),
      element('div', { class: 'map-body' }, this.map.canvas, this.empty, this.map.place));
    const time = element('section', { class: 'times', id: 'time', 'aria-label': 'Time' }, unseen('Time'),
      ...this.charts.map(({ node }) => node));
    const skip = ['map', 'camera', 'time', 'devices', 'journal'].map((name) => element('a', { href: `#${name}` }, name));
    const timeline = element('div', { class: 'timeline' }, unseen('Health over time'), bar, this.health.node);
    root.append(element('div', { class: 'left' }, map, timeline),
      element('div', { class: 'right', tabindex: '0', role: 'group', 'aria-label': 'Camera, charts, devices and journal' },
        this.camera.node, time, this.devices.node, this.journal.node));
    root.before(this.head.node, this.head.banner, this.said);
    root.after(element('nav', { class: 'jumps', 'aria-label': 'Parts of the page' }, ...skip));
  }

  #span(seconds) {
    this.link.show(this.link.cursor - seconds, this.link.cursor);
  }

  #listen() {
    document.addEventListener('keydown', (event) => {
      if (event.ctrlKey || event.metaKey || event.altKey || ['INPUT', 'SELECT'].includes(event.target.tagName)) return;
      if (event.key === 'f') this.tools.toggleFollow();
      else if (event.key === 'm' || (event.key === 'Escape' && this.map.ruler.on)) this.tools.toggleRuler();
      else if (event.key === 'l') this.link.follow();
      else return;
      event.preventDefault();
    });
    addEventListener('hashchange', () => {
      this.wanted = momentWanted();
      this.#seek();
    });
    document.addEventListener('visibilitychange', () => this.link.changed());
  }

  #take(kind, data) {
    const { store } = this;
    if (!store.take(kind, data)) return;
    if (kind === 'beat') return;
    if (kind === 'hello' || kind === 'restarted') this.#clear();
    if (kind === 'restarted') this.say('The daemon was started again: a new map begins.');
    if (kind === 'trail' && store.poses.length > 0) this.link.grow(store.poses.get('t')[0]), this.#seek();
    if (kind === 'silence' || kind === 'status') this.#words();
    if (kind === 'bearings' || kind === 'picture') this.camera.update();
    if (Number.isFinite(store.now)) this.link.grow(store.now);
    this.map.surface.redraw();
  }

  /// Measures the time from sending a pose to drawing it; both ends must have the same clock.
  #tellDelay() {
    const { pose } = this.store;
    if (!pose || pose === this.#drawnPose || !Number.isFinite(pose.sent_us)) return;
    this.#drawnPose = pose;
    this.#delays_ms.push(Date.now() - pose.sent_us / 1e3);
    if (this.#delays_ms.length > 300) this.#delays_ms.shift();
  }

  /// The median of the last delays in milliseconds; NaN without a delay.
  get delay_ms() {
    const sorted = [...this.#delays_ms].sort((a, b) => a - b);
    return sorted[sorted.length >> 1] ?? NaN;
  }

  #clear() {
    this.link.clear();
    this.camera.clear();
    this.camera.update();
    this.map.become(this.map.mode === 'follow' ? 'follow' : 'all');
    this.map.view.scale = null;
  }

  /// Moves the cursor to the moment in the page's address when its data have arrived.
  #seek() {
    if (this.wanted === null || !(this.wanted <= this.store.now)) return;
    this.link.grow(this.store.now);
    this.link.moveTo(this.wanted);
    this.wanted = null;
  }

  #tell(state, words) {
    if (state !== this.head.state && (state === 'gone' || this.head.state === 'gone'))
      this.store.note(state === 'gone' ? words : 'azimuth view answers again.', state === 'gone' ? 'error' : 'info', NaN);
    if (state === 'open' && this.store.silent_s !== null) return;
    this.head.tell(state, words);
  }

  /// Shows a message for a short time.
  say(words) {
    this.said.textContent = words;
    this.#said_ms = performance.now();
  }

  #words() {
    const { store, link } = this;
    if (store.silent_s !== null && ['open', 'silent'].includes(this.head.state))
      this.head.tell('silent', `Nothing has come from the daemon for ${number(store.silent_s, 0)} s. ${store.silent_why || 'Is it running?'}`);
    if (performance.now() - this.#said_ms > saidFor_ms && this.said.textContent) this.said.textContent = '';
    this.head.trouble(deviceTroubles(store).join(' '));
    this.head.update(store, this.map.shownPose());
    this.tools.update();
    this.empty.hidden = !store.isEmpty;
    showMeasured(this.charts);
    this.journal.update();
    this.devices.update(this.#figures());
    this.nowButton.setAttribute('aria-pressed', link.following);
    this.clock.textContent = link.any ? `${number(link.cursor, 1)} s${link.following ? '' : ` (${number(link.end - link.cursor, 1)} s ago)`}` : '';
    this.map.canvas.setAttribute('aria-label', this.#mapWords());
  }

  #mapWords() {
    const { map, poses } = this.store, unseen = map.landmarks.filter(({ state }) => state === 'unseen').length;
    const counted = `${map.landmarks.length + map.more} landmarks${unseen > 0 ? `, ${unseen} not seen lately` : ''}`;
    return `Map with ${counted} and ${poses.length} poses. Arrow keys move it, plus and minus zoom, R turns, F follows the robot, M measures.`;
  }

  #figures() {
    const { fps, p95 } = this.frames.figures(), { store, delay_ms } = this;
    const parts = [`This page: ${number(fps, 0)} frames/s, 95 % within ${number(p95, 0)} ms`];
    if (Number.isFinite(delay_ms)) parts.push(`a pose is drawn ${number(delay_ms, 0)} ms after it was sent`);
    if (store.missed > 0) parts.push(`${store.missed} events missed because this browser is slow`);
    if (store.unreadable + this.feed.unreadable > 0) parts.push(`${store.unreadable + this.feed.unreadable} events could not be read`);
    return `${parts.join('; ')}.`;
  }
}

/// Fills the element and sets up the page.
export function showLive(root) {
  document.title = 'Azimuth, live';
  document.body.className = 'live';
  window.azimuthView = new LivePage(root);
}
