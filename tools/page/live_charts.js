// Charts of a live robot, drawn from the growing columns of the store.

import { TimeChart } from './time_chart.js';

/// A part of a chart specification that reads the column at each drawing.
function line(columns, name, words, colour, more = {}) {
  return { get line() { return columns.get(name); }, words, colour, ...more };
}

function spec(columns, key, title, unit, parts, more = {}) {
  return { key, title, unit, get times() { return columns.get('t'); }, parts, ...more };
}

export function liveCharts(store, link) {
  const { poses, figures } = store;
  const band = { get low() { return figures.get('nis_low'); }, get high() { return figures.get('nis_high'); }, words: '95 %',
    colour: 'band' };
  const counts = (name, words) => ({ get counts() { return figures.get(name); }, words, colour: words });
  const specs = [
    spec(poses, 'position', 'Position, 2σ', 'm, longer axis', [line(poses, 'two_sigma_m', '', 'estimate')], { least: 0 }),
    spec(poses, 'heading', 'Heading, 2σ', '°', [line(poses, 'two_sigma_deg', '', 'hindsight')], { least: 0 }),
    spec(figures, 'nis', 'NIS, mean of used bearings', '1 is ideal', [band, { level: 1, colour: 'axis', dash: [4, 3] },
      line(figures, 'nis', 'step', 'nis', { width: 1.6 })], { least: 0 }),
    spec(figures, 'bearings', 'Bearings', '1/s; numbers: so far', [counts('accepted', 'used'), counts('created', 'new'),
      counts('thinned', 'thinned'), counts('rejected', 'refused')], { least: 0 }),
    spec(figures, 'latency', 'Delays', 'ms', [line(figures, 'latency_ms', 'pose after its instant', 'estimate'),
      line(figures, 'detect_ms', 'looking at an image', 'time', { dash: [4, 3] })], { least: 0 }),
    spec(figures, 'rates', 'Rates', 'Hz', [line(figures, 'odometry_hz', 'odometry', 'odometry'), line(figures, 'image_hz',
      'images', 'used', { dash: [5, 3] }),
      line(figures, 'pose_hz', 'poses', 'tracking', { dash: [2, 3] })], { least: 0 }),
    spec(figures, 'battery', 'Battery', 'V', [line(figures, 'battery_v', '', 'time', { width: 1.8 })], { near: true }),
    spec(figures, 'landmarks', 'Landmarks in the map', '', [line(figures, 'landmarks', '', 'tracking', { width: 1.8 })],
      { least: 0 }),
  ];
  return specs.map((one) => new TimeChart(one, link));
}

/// Hides charts without measurements.
export function showMeasured(charts) {
  for (const { spec: { parts }, node } of charts) {
    const columns = parts.map((part) => part.line ?? part.counts).filter((column) => column !== undefined);
    const measured = columns.some((column) => column.findLastIndex(Number.isFinite) >= 0);
    if (node.hidden === measured) node.hidden = !measured;
  }
}
