// The head line: health and pose of the robot, and state of the connection.

import { healths } from './live_store.js';
import { duration, element, number } from './words.js';

const connections = { connecting: ['…', 'Connecting'], open: ['●', 'Live'], silent: ['◌', 'Silent'],
  gone: ['✕', 'Not connected'], refused: ['✕', 'Refused'], troubled: ['◌', 'Connected'] };

/// An older pose is shown in another colour; normally there are several poses per second.
const old_s = 1.5;

/// Further facts of the robot beside its pose.
function factsOf(store) {
  const { robot, speed_m_per_s: speed, status } = store, facts = [];
  if (robot !== '') facts.push(robot);
  if (Number.isFinite(speed)) facts.push(`${number(speed, 2)} m/s`);
  if (Number.isFinite(status?.battery_v)) facts.push(`${number(status.battery_v, 1)} V`);
  return facts.join('   ');
}

export class LiveHead {
  constructor() {
    this.health = element('b', { class: 'state starting' }, 'waiting');
    this.reason = element('span', { class: 'reason' });
    this.pose = element('output', { class: 'number pose', 'aria-label': 'Pose', 'aria-live': 'off' });
    this.facts = element('output', { class: 'number facts', 'aria-label': 'Robot, speed and battery', 'aria-live': 'off' });
    this.age = element('output', { class: 'number age', 'aria-label': 'Age of the pose', 'aria-live': 'off' });
    this.connection = element('span', { class: 'connection connecting' });
    this.source = element('span', { class: 'faint source' });
    this.banner = element('div', { class: 'banner', role: 'alert', hidden: true });
    this.node = element('header', { class: 'live-head' }, element('h1', {}, 'Azimuth'),
      element('div', { class: 'now', role: 'status', 'aria-live': 'polite', 'aria-label': 'Health' }, this.health,
        this.reason), this.pose, this.facts, this.age,
      element('div', { class: 'right-end' }, this.source, this.connection));
    this.troubles = '';
    this.tell('connecting', '');
  }

  /// Receives the state of the stream with a description.
  tell(state, words) {
    this.state = state;
    this.words = words;
    this.#warn();
  }

  /// Receives a trouble of the robot while the stream itself works.
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

  /// Shows the connection; a stream without sensor data does not count as live.
  #connect(shown) {
    if (this.shown === shown) return;
    this.shown = shown;
    const [sign, name] = connections[shown];
    this.connection.replaceChildren(element('span', { 'aria-hidden': 'true' }, sign), ` ${name}`);
    this.connection.className = `connection ${shown}`;
  }

  #say(node, words) {
    if (node.textContent !== words) node.textContent = words;
  }

  update(store, shown) {
    const { status, health: newest, hello } = store, age_s = store.poseAge_s;
    this.#say(this.facts, factsOf(store));
    this.#say(this.age, Number.isFinite(age_s) ? `pose ${duration(age_s)} old` : '');
    this.age.classList.toggle('old', age_s > old_s);
    const known = newest !== null && !['silent', 'gone', 'refused'].includes(this.state);
    const health = known ? healths[newest] ?? 'waiting' : newest === null ? 'waiting' : 'unknown';
    const reason = known && status?.health === newest ? (status?.reason ?? '') : '';
    if (this.health.textContent !== health) this.health.textContent = health, this.health.className = `state ${health}`;
    this.#say(this.reason, reason);
    this.#say(this.source, hello ? `${hello.source ?? ''}` : '');
    if (!shown) return void (this.pose.textContent = '');
    const degrees = (shown.heading * 180) / Math.PI;
    this.pose.textContent = `x ${number(shown.x, 2)} m   y ${number(shown.y, 2)} m   ${number(degrees, 1)}°   ±${number(shown.two_sigma_m, 2)} m (2σ)`;
  }
}
