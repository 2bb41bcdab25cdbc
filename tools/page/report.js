// The page of replayed runs. Its data are one JSON object, which a page in a single file has in the element #data, and
// which recorded.js fetches from `azimuth view`:
//
//   { made_by, runs: [{ name, estimator, front_end, digest, trouble, unread, steps, starts_at_us, nees_bounds: [low, high],
//       metrics: [{ key, label, unit, value, decimals, better, note }], series: { step, t, x, y, ... },
//       health: [{ from, to, health, reason }], map: { word, true_words, all, kinds, landmarks, true_landmarks, hindsight },
//       pictures: [{ t, why, src }] }] }
//
// All columns of `series` have the same length, with null for missing numbers; tools/replay_page/page_series.hpp
// describes them.

import { chartsOf } from './run_charts.js';
import { headingOf, runPanel } from './run_panel.js';
import { comparison, tiles } from './tables.js';
import { timeBar } from './time_bar.js';
import { TimeLink } from './time_link.js';
import { element } from './words.js';

function keys(inTime) {
  const key = (name) => element('kbd', {}, name);
  const zoomKeys = () => [key('+'), ' ', key('−'), ' ', key('0')];
  if (!inTime) return element('p', { class: 'faint keys' }, 'In the map: wheel, drag, arrows, ', ...zoomKeys(), '; ', key('R'),
    ' turns it.');
  return element('p', { class: 'faint keys' }, 'Point at a chart to move the cursor of all; ', key('Ctrl'),
    ' + wheel zooms in time, ', key('Shift'), ' + drag moves it. In a chart: ', key('←'), ' ', key('→'), ' a step, with ',
    key('Shift'), ' farther, ', ...zoomKeys(), ' zoom. In the map: wheel, drag, arrows, ', ...zoomKeys(), '. ',
    key('Space'), ' plays, ', key('N'), ' and ', key('P'), ' go to the next and the last change of health. ', key('R'),
      ' turns the map.');
}

/// The unusable samples and the unreadable parts of the recordings.
function troubles(runs) {
  return runs.flatMap(({ name, trouble, unread }) => [trouble, unread].filter((words) => words).map((words) =>
    element('section', { class: 'card trouble', role: 'note' }, element('b', {}, 'Trouble '),
      runs.length > 1 ? `${name}: ${words}` : words)));
}

/// False for a map file, which has no time and therefore neither bar nor charts.
const lasts = ({ series }) => series.t.length > 0;
const endOf = (run) => run.series.t.at(-1) ?? 0;

/// Fills the element; returns the time link and the views of the maps.
export function showReport({ made_by, runs }, root) {
  const link = new TimeLink(0, Math.max(...runs.map(endOf)));
  const alone = runs.length === 1, axes = new Map();
  const most = runs.map(chartsOf).reduce((a, b) => (b.length > a.length ? b : a));
  const all = [...most, ...runs.flatMap(chartsOf)];
  const panels = runs.map((run) => runPanel(run, link, alone, axes, all));
  const nodes = panels.map(({ node }) => node);
  const head = element('header', { class: 'top' }, element('h1', {}, alone ? runs[0].name : `${runs.length} runs`),
    element('span', { class: 'faint' }, `${alone ? `${headingOf(runs[0])} · ` : ''}${made_by}`));
  const longest = runs.reduce((a, b) => (endOf(a) >= endOf(b) ? a : b));
  const events = runs.flatMap(({ health }) => health.map(({ from }) => from));
  root.append(head, ...troubles(runs),
    alone ? (runs[0].metrics.length > 0 ? tiles(runs[0].metrics) : '') : comparison(runs, nodes, () => link.changed()),
    ...(lasts(longest) ? [timeBar(link, longest.series.t, events)] : []),
    alone ? nodes[0] : element('div', { class: 'panels' }, ...nodes), keys(lasts(longest)));
  link.changed();
  return { link, maps: panels.map(({ map }) => map) };
}

const embedded = document.getElementById('data');
if (embedded) showReport(JSON.parse(embedded.textContent), document.querySelector('main'));
