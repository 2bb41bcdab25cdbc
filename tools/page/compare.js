// The page of a comparison. The element #data has the output of `azimuth report compare --json`, see docs/compare.md.

import { IntervalChart, RunsChart, changeWords, valueWords } from './change_charts.js';
import { element } from './words.js';

const counted = (count, word) => `${count} ${word}${count === 1 ? '' : 's'}`;
const hasTrend = (run, trend) => Object.values(run.figures).some((figure) => figure.trend === trend);

function comparedHead({ runs, baseline, versions, versions_before, made_by }) {
  const versionWords = versions.join(', ') + (baseline ? `, before ${versions_before.join(', ') || 'unknown'}` : '');
  return element('header', { class: 'top' }, element('h1', {}, `${counted(runs.length, 'run')} compared`),
    element('span', { class: 'faint' }, `${versionWords || 'versions unknown'} · ${made_by}`));
}

function comparedTiles({ runs, baseline, absent }) {
  const tile = (value, label) => element('div', { class: 'card tile' }, element('div', { class: 'value number' }, `${value}`),
    element('div', { class: 'label' }, label));
  const withTrend = (trend) => runs.filter((run) => hasTrend(run, trend)).length;
  const told = baseline ? [tile(withTrend('worse'), 'worse'), tile(withTrend('better'), 'better'), tile(absent.missing.length, 'missing'),
    tile(absent.new.length, 'new')] : [];
  return element('section', { class: 'tiles', 'aria-label': 'Summary' }, tile(runs.length, 'runs'), ...told,
    tile(absent.failed.length, 'failed'), tile(absent.unreadable.length, 'unreadable'), tile(absent.twice.length, 'twice'));
}

/// A card with the names of the runs that the tables lack, so that they are not taken for good ones.
function absentCard({ absent, past_limits }) {
  const lists = [
    ['Past their limits', past_limits],
    ['Missing, in the baseline alone', absent.missing],
    ['Failed', absent.failed.map(({ name, why }) => `${name}: ${why}`)],
    ['Failed in the baseline', absent.failed_before.map(({ name, why }) => `${name}: ${why}`)],
    ['Incomplete: cut, damaged or of another version', absent.incomplete.map(({ name, why }) => `${name}: ${why}`)],
    ['Unreadable', absent.unreadable.map(({ file, why }) => `${file}: ${why}`)],
    ['Twice', absent.twice.map(({ name, used, left_out }) => `${name}: ${left_out} left out, ${used} used`)],
    ['New, not in the baseline', absent.new],
    ['Older reports, without name and tags', absent.older],
  ].filter(([, rows]) => rows.length > 0);
  if (lists.length === 0) return '';
  return element('section', { class: 'card trouble', role: 'note', id: 'absent' }, ...lists.map(([title, rows]) =>
    element('details', { open: rows.length <= 20 }, element('summary', {}, `${title} (${rows.length})`),
      element('ul', {}, ...rows.map((row) => element('li', {}, row))))));
}

function changeCells(figure, change, baseline) {
  if (!change) return [element('td', { class: 'number' }, '–'), ...(baseline ? [element('td')] : [])];
  const trend = change.trend.replaceAll(' ', '-');
  const title = baseline ? `was ${valueWords(figure, change.before)}: ${change.trend}` : undefined;
  const cells = [element('td', { class: 'number', title }, valueWords(figure, change.after))];
  if (baseline) cells.push(element('td', { class: `number is-${trend}`, title }, changeWords(figure, change.change)));
  return cells;
}

function runsTable(data, figures, chosen) {
  const { runs, baseline } = data;
  const table = element('table', {});
  const row = (run) => element('tr', {}, element('th', { scope: 'row' }, run.name, ' ',
    element('span', { class: 'faint' }, run.tags.join(', '))), ...figures.flatMap((figure) => changeCells(figure, run.figures[figure.key], baseline)));
  const fill = (rows) => table.tBodies[0].replaceChildren(...rows.map(row));
  const order = (figure) => {
    const measure = ({ figures: { [figure.key]: found } }) => (baseline ? found?.change : found?.after) ?? -Infinity;
    fill(runs.toSorted((a, b) => measure(b) - measure(a)));
    chosen(figure);
  };
  const heads = figures.map((figure) => element('th', { scope: 'col', class: 'number', colspan: baseline ? 2 : 1 },
    element('button', { type: 'button', title: 'Sort by this, and draw it', onclick: () => order(figure) }, figure.label)));
  table.append(element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'run'), ...heads)), element('tbody'));
  fill(runs);
  return element('section', { class: 'card' }, element('h2', {}, 'Runs'), element('p', { class: 'faint' },
    baseline ? 'What got worse comes first. Changes are of how bad a number is: plus is worse.' : 'The least accurate first.'),
    element('div', { class: 'scroll tall', tabindex: '0' }, table));
}

function groupsTable({ groups, baseline }, figures) {
  const cells = (group) => figures.flatMap((figure) => {
    const mean = group.figures[figure.key];
    const interval = mean && mean.low !== null ? `95 %: ${changeWords(figure, mean.low)} to ${changeWords(figure, mean.high)}` : undefined;
    const [value, change] = changeCells(figure, mean && { ...mean, after: mean.after }, baseline);
    if (change && interval) change.setAttribute('title', interval);
    return change ? [value, change] : [value];
  });
  const heads = figures.map(({ label }) => element('th', { scope: 'col', class: 'number', colspan: baseline ? 2 : 1 }, label));
  return element('section', { class: 'card' }, element('h2', {}, 'By tag'), element('div', { class: 'scroll', tabindex: '0' }, element('table', {},
    element('thead', {}, element('tr', {}, element('th', { scope: 'col' }, 'tag'), ...heads)),
    element('tbody', {}, ...groups.map((group) => element('tr', {}, element('th', { scope: 'row' },
      group.tag ?? 'all runs', ' ', element('span', { class: 'faint' }, counted(group.runs, 'run'))), ...cells(group)))))));
}

/// Fills `page` with the comparison.
export function showComparison(data, page) {
  const figures = data.figures.filter(({ key }) => data.runs.some((run) => run.figures[key]));
  const intervals = new IntervalChart(data.baseline ? data.groups : []), byRun = new RunsChart(data.runs);
  const title = element('h2', {});
  const chosen = (figure) => {
    title.textContent = figure.label;
    for (const chart of [intervals, byRun]) chart.show(figure);
  };
  page.append(comparedHead(data), comparedTiles(data), absentCard(data), title,
    element('div', { class: 'right' }, intervals.node, byRun.node, groupsTable(data, figures), runsTable(data, figures, chosen)));
  if (figures.length > 0) chosen(figures[0]);
}

const compared = document.getElementById('data');
if (compared) showComparison(JSON.parse(compared.textContent), document.querySelector('main'));
