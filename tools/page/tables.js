// Figures of runs: tiles for the most important ones, and a table of all, with several runs side by side.

import { element, number, withUnit } from './words.js';

const first = ['rmse', 'anees', 'hindsight', 'tracking', 'lost', 'landmarks', 'map_rmse', 'rejected', 'step'];

export function tiles(metrics) {
  const shown = first.map((key) => metrics.find((metric) => metric.key === key)).filter((metric) => metric !== undefined);
  return element('section', { class: 'tiles', 'aria-label': 'Summary' }, ...shown.map(({ label, unit, value, decimals, note }) =>
    element('div', { class: 'card tile', title: note || undefined },
      element('div', { class: 'value number' }, number(value, decimals), element('span', { class: 'unit' }, unit)),
      element('div', { class: 'label' }, label))));
}

/// A number that is lower for better values, rounded as in the table; nothing for figures without a better direction.
function badness({ value: exact, decimals, better }) {
  const value = Number(exact.toFixed(decimals));
  if (better === 'lower') return value;
  if (better === 'higher') return -value;
  if (better === 'nearer_to_three') return Math.abs(Math.log(value / 3));
  return null;
}

/// The best of several values; none if all are equal.
function bestOf(row) {
  const known = row.filter((metric) => metric !== undefined);
  const all = known.map(badness);
  if (known.length < 2 || all.includes(null) || Math.max(...all) - Math.min(...all) < 1e-9) return [];
  return known.filter((metric, i) => all[i] === Math.min(...all));
}

function cell(metric, isBest) {
  if (!metric) return element('td', { class: 'number' }, '–');
  return element('td', { class: isBest ? 'number best' : 'number', title: metric.note || undefined },
    withUnit(number(metric.value, metric.decimals), metric.unit));
}

/// `panels` has one element for each run, which the checkbox of the run shows or hides.
export function comparison(runs, panels, changed) {
  const keys = [...new Set(runs.flatMap((run) => run.metrics.map(({ key }) => key)))];
  const rows = keys.map((key) => {
    const row = runs.map((run) => run.metrics.find((metric) => metric.key === key));
    const best = bestOf(row), { label } = row.find((metric) => metric !== undefined);
    return element('tr', {}, element('th', { scope: 'row' }, label), ...row.map((metric) => cell(metric, best.includes(metric))));
  });
  const heads = runs.map((run, i) => {
    const onchange = () => {
      panels[i].hidden = !box.checked;
      changed();
    };
    const box = element('input', { type: 'checkbox', checked: true, onchange });
    return element('th', { scope: 'col', class: 'number' }, runs.length > 1 ? element('label', {}, box, ' ', run.name) : run.name);
  });
  const head = element('thead', {}, element('tr', {}, element('td'), ...heads));
  const table = element('table', {}, head, element('tbody', {}, ...rows));
  const several = runs.length > 1;
  return element('details', { class: several ? 'card compare' : 'card', open: several },
    element('summary', {}, several ? 'Side by side' : 'All numbers'),
    several ? table : element('div', { class: 'scroll', tabindex: '0' }, table));
}
