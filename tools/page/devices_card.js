// The card with the daemon's status of its devices, its log and itself.

import { duration, element, number } from './words.js';

const flags = [[1, 'motors on'], [2, 'emergency stop'], [4, 'left wheel stalls'], [8, 'right wheel stalls'], [16, 'bumper'],
  [32, 'charging']];

const troubleHeads = { input_trouble: 'Input', map_trouble: 'Map file', image_trouble: 'Images', picture_trouble: 'Pictures',
  configuration: 'Configuration' };

/// Counters since the start of the daemon; those that are zero are not shown.
const counters = {
  odometer_reconnects: 'odometer came back', camera_reconnects: 'camera came back',
  odometer_resets: 'odometer’s port reset', camera_resets: 'camera’s port reset',
  camera_missing: 'images missing', camera_corrupt: 'images damaged', frames_unusable: 'images of no use',
  odometry_gaps: 'odometry missing', bearing_gaps: 'bearings missing',
  odometry_out_of_order: 'odometry out of order', bearings_out_of_order: 'bearings out of order',
  bearings_without_odometry: 'bearings without odometry', values_not_finite: 'values that are no numbers',
  odometry_refused: 'odometry refused', bearings_refused: 'bearings refused',
  frames_replaced: 'images replaced by newer ones', publish_failures: 'messages not sent',
  record_losses: 'events not in the field log', deleted: 'landmarks removed', recovered: 'landmarks begun anew',
};

/// Guesses the state from a text for people; it selects the colour of the lamp beside the text.
function stateOf(text) {
  if (text === '') return 'none';
  return /^(running|SCHED|replay|playing|writing|\/?[\w./-]+$)/.test(text) ? 'good' : 'bad';
}

/// A sentence for each device that should send samples and does not. The status text of a working device begins with
/// one of the words below; a device that starts is in trouble only if it has worked before.
export function deviceTroubles({ devices }) {
  const isWell = ({ text, worked }) => text === '' || /^(running|replay|playing)/.test(text) || (!worked && text.startsWith('starting'));
  return [['odometer', 'Odometer'], ['camera', 'Camera']].map(([key, head]) => [head, devices.get(key)])
    .filter(([, device]) => device && !isWell(device)).map(([head, { text }]) => `${head}: ${text}.`);
}

/// Formats a size, e.g. 12 MB or 1.2 GB.
const size = (bytes) => (bytes < 1e9 ? `${number(bytes / 1e6, bytes < 1e7 ? 1 : 0)} MB` : `${number(bytes / 1e9, bytes < 1e10 ? 1 : 0)} GB`);

export class DevicesCard {
  constructor(store) {
    this.store = store;
    this.body = element('tbody');
    this.figures = element('p', { class: 'faint small number' });
    this.node = element('section', { class: 'card devices', id: 'devices', 'aria-label': 'Devices' },
      element('div', { class: 'head' }, element('h2', {}, 'Devices and log')), element('table', {}, this.body), this.figures);
  }

  update(pageWords) {
    const { store } = this, { status } = store;
    const rows = status ? [...this.#devices(), ...this.#kept(status), ...this.#robot(status), ...this.#troubles(status), ...this.#counters(status)] : [];
    const fresh = JSON.stringify(rows);
    if (fresh !== this.told) this.body.replaceChildren(...rows.map(([head, text, state, since]) => element('tr', {},
      element('th', { scope: 'row' }, head), element('td', {}, element('span', { class: `lamp ${state}` }), text,
        since ? element('span', { class: 'faint' }, ` ${since}`) : null))));
    this.told = fresh;
    this.figures.textContent = pageWords;
  }

  #devices() {
    const words = { odometer: 'Odometer', camera: 'Camera', recorder: 'Field log', realtime: 'Realtime' };
    return Object.entries(words).map(([key, head]) => {
      const { text, since, atLeast } = this.store.devices.get(key) ?? { text: '' };
      if (text === '') return null;
      return [head, text, stateOf(text), `since ${duration(Math.max(0, since))}${atLeast ? ' or before' : ''}`];
    }).filter((row) => row !== null);
  }

  /// The field log and the map file on the disk.
  #kept({ kept }) {
    const { log_bytes, log_quota_bytes, disk_free_bytes, map_age_s } = kept ?? {}, rows = [];
    if (Number.isFinite(log_bytes)) {
      const of = Number.isFinite(log_quota_bytes) ? ` of ${size(log_quota_bytes)}` : ', no quota';
      const free = Number.isFinite(disk_free_bytes) ? `; ${size(disk_free_bytes)} free on the disk` : '';
      rows.push(['All field logs', `${size(log_bytes)}${of}${free}`, 'good']);
    }
    if (Number.isFinite(map_age_s)) rows.push(['Map file', `written ${duration(map_age_s)} ago`, 'good']);
    return rows;
  }

  #robot({ battery_v, robot_flags = 0 }) {
    const set = flags.filter(([bit]) => robot_flags & bit).map(([, words]) => words);
    const rows = [];
    if (Number.isFinite(battery_v)) rows.push(['Battery', `${number(battery_v, 1)} V`, 'good']);
    if (set.length > 0) rows.push(['Robot', set.join(', '), robot_flags & 30 ? 'bad' : 'good']);
    return rows;
  }

  #troubles(status) {
    return Object.entries(troubleHeads).filter(([key]) => status[key]).map(([key, head]) => [head, `${status[key]}`, 'bad']);
  }

  #counters(status) {
    const counted = Object.entries(counters).filter(([key]) => status[key] > 0).map(([key, words]) => `${status[key]} ${words}`);
    return counted.length > 0 ? [['Counted', counted.join(', '), 'none']] : [];
  }
}
