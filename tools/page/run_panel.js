// The panel of one run.

import { HealthBar, healthTable } from './health_bar.js';
import { MapView } from './map_view.js';
import { Pictures } from './pictures.js';
import { chartsOf } from './run_charts.js';
import { comparison } from './tables.js';
import { TimeChart } from './time_chart.js';
import { duration, element } from './words.js';

export function headingOf(run) {
  const steps = run.series.t.length < run.steps ? `, ${run.series.t.length} of them drawn, extremes kept` : '';
  if (run.series.t.length === 0) return run.estimator;
  return `${run.estimator}, ${run.steps} steps${steps}, ${duration(run.series.t.at(-1))}`;
}

/// The chart, or an empty place for a chart that only another run has, so that charts in columns are aligned.
function chartOrGap(key, specs, all, link, axes) {
  const spec = specs.find((own) => own.key === key);
  if (spec) return new TimeChart(spec, link, axes).node;
  const { title } = all.find((other) => other.key === key);
  return element('section', { class: 'card chart gap' }, element('h3', {}, title), element('p', { class: 'faint' },
    'Not measured in this run.'));
}

/// Returns the node of the panel and the view of its map. With `alone`, map and charts are side by side; otherwise
/// below each other in a column beside other runs. `axes` and `all` are the axes and the charts of all runs.
export function runPanel(run, link, alone, axes, all = chartsOf(run)) {
  const map = new MapView(run, link), left = element('div', { class: 'left' }, map.node);
  const right = element('div', { class: 'right' });
  if (alone && run.series.t.length > 0) right.append(element('h2', { class: 'unseen' }, 'Over time'));
  if (run.health.length > 0) right.append(new HealthBar(run.health, () => run.series.t, link).node);
  const specs = chartsOf(run), keys = [...new Set(all.map(({ key }) => key))];
  right.append(...keys.map((key) => chartOrGap(key, specs, all, link, axes)));
  if (run.pictures.length > 0) (alone ? left : right).append(new Pictures(run.pictures, link).node);
  if (run.health.length > 0) (alone ? left : right).append(healthTable(run.health, link));
  if (alone) {
    if (run.metrics.length > 0) left.append(comparison([run], [], () => {}));
    return { map, node: element('div', { class: right.hasChildNodes() ? 'panel alone' : 'panel' }, left, right) };
  }
  const heading = element('div', { class: 'heading' }, element('h2', {}, run.name),
    element('span', { class: 'faint' }, headingOf(run)));
  return { map, node: element('div', { class: 'panel' }, heading, left, right) };
}
