// The line on top: how the robot is, where it is, and whether anything comes.

import { healths } from './live_store.js';
import { element, number } from './words.js';

const connections = { connecting: ['…', 'Connecting'], open: ['●', 'Live'], silent: ['◌', 'Silent'],
  gone: ['✕', 'Not connected'], refused: ['✕', 'Refused'], troubled: ['◌', 'Connected'] };

export class LiveHead {
  constructor() {
    this.health = element('b', { class: 'state starting' }, 'waiting');
    this.reason = element('span', { class: 'reason' });
    this.pose = element('output', { class: 'number pose', 'aria-label': 'Pose', 'aria-live': 'off' });
    this.connection = element('span', { class: 'connection connecting' });
    this.source = element('span', { class: 'faint source' });
    this.banner = element('div', { class: 'banner', role: 'alert', hidden: true });
    this.node = element('header', { class: 'live-head' }, element('h1', {}, 'Azimuth'),
      element('div', { class: 'now', role: 'status', 'aria-live': 'polite', 'aria-label': 'Health' }, this.health,
        this.reason), this.pose,
      element('div', { class: 'right-end' }, this.source, this.connection));
    this.troubles = '';
    this.tell('connecting', '');
  }

  /// How the stream is, and what there is to say about it.
  tell(state, words) {
    this.state = state;
    this.words = words;
    this.#warn();
  }

  /// What is wrong behind a stream that comes as it should.
  trouble(words) {
    this.troubles = words;
    this.#warn();
  }

  #warn() {
    const words = this.words || this.troubles;
    this.banner.hidden = words === '';
    if (this.banner.textContent !== words) this.banner.textContent = words;
    this.#connect(this.state === 'open' && words !== '' ? 'troubled' : this.state);
  }

  /// A stream without what the robot senses is not live.
  #connect(shown) {
    if (this.shown === shown) return;
    this.shown = shown;
    const [sign, name] = connections[shown];
    this.connection.replaceChildren(element('span', { 'aria-hidden': 'true' }, sign), ` ${name}`);
    this.connection.className = `connection ${shown}`;
  }

  update({ status, health: newest, hello }, shown) {
    const known = newest !== null && !['silent', 'gone', 'refused'].includes(this.state);
    const health = known ? healths[newest] ?? 'waiting' : newest === null ? 'waiting' : 'unknown';
    const reason = known && status?.health === newest ? (status?.reason ?? '') : '';
    if (this.health.textContent !== health) this.health.textContent = health, this.health.className = `state ${health}`;
    if (this.reason.textContent !== reason) this.reason.textContent = reason;
    const source = hello ? `${hello.source ?? ''}` : '';
    if (this.source.textContent !== source) this.source.textContent = source;
    if (!shown) return void (this.pose.textContent = '');
    const degrees = (shown.heading * 180) / Math.PI;
    this.pose.textContent = `x ${number(shown.x, 2)} m   y ${number(shown.y, 2)} m   ${number(degrees, 1)}°   ±${number(shown.two_sigma_m, 2)} m (2σ)`;
  }
}
