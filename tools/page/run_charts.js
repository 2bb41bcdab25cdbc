// Selects the charts of a run by its measured data.

import { number } from './words.js';

const degrees = 180 / Math.PI;
/// If the error is within two standard deviations for a smaller share of the time, the deviations are too small.
const few_percent = 85;

const times = (values, factor) => values?.map((value) => (value === null ? null : value * factor));
const measured = (values) => values !== undefined && values.some((value) => value !== null);

/// Specifications for TimeChart, in reading order.
export function chartsOf(run) {
  const { series } = run;
  if (series.t.length === 0) return [];
  const charts = [error(run, 'x', 'm', 1), error(run, 'y', 'm', 1), error(run, 'heading', '°', degrees)];
  if (measured(series.nees)) charts.push(nees(run));
  if (measured(series.nis)) charts.push(nis(run));
  if (measured(series.accepted)) charts.push(bearings(run));
  if (measured(series.step_us)) charts.push(stepTime(run));
  return charts;
}

/// The share of the time in which the error is within its limits; 95 % if the covariance is right.
export function shareWithin(errors, limits) {
  const both = errors.map((error, i) => [error, limits[i]]).filter(([error, limit]) => error !== null && limit !== null);
  const within = both.filter(([error, limit]) => Math.abs(error) <= limit).length;
  if (both.length === 0) return '2σ';
  const percent = (100 * within) / both.length;
  return `${percent < few_percent ? 'only ' : ''}${number(Math.floor(percent), 0)} % of it within 2σ`;
}

/// With truth: the error and two standard deviations; without truth: only the deviations.
function error(run, axis, unit, factor) {
  const { series } = run;
  const known = measured(series[`error_${axis}`]);
  const high = times(series[`two_sigma_${axis}`], factor);
  const parts = [{ low: times(high, -1), high, words: '2σ', colour: 'band', mirrored: true }, { level: 0, colour: 'axis' }];
  if (known) parts.push({ line: times(series[`error_${axis}`], factor), words: 'error', colour: 'estimate', width: 1.5 });
  const title = known ? `Error in ${axis}, ${shareWithin(series[`error_${axis}`], series[`two_sigma_${axis}`])}` : `2σ of ${axis} (no truth)`;
  return { key: `error_${axis}`, title, unit, times: series.t, symmetric: true, parts };
}

function nees(run) {
  const { series } = run, [low, high] = run.nees_bounds;
  return { key: 'nees', title: 'NEES and ANEES so far', unit: '3 is ideal', times: series.t, logarithmic: true, parts: [
    { low, high, words: '95 %', colour: 'band' }, { level: 3, colour: 'axis', dash: [4, 3] },
    { line: series.nees, words: 'NEES', colour: 'estimate', width: 1, opacity: 0.6 },
    { line: series.anees, words: 'ANEES', colour: 'hindsight', width: 2 }] };
}

function nis(run) {
  const { series } = run;
  return { key: 'nis', title: 'NIS, mean of used bearings', unit: '1 is ideal', times: series.t, least: 0, parts: [
    { low: series.nis_low, high: series.nis_high, words: '95 %', colour: 'band' }, { level: 1, colour: 'axis', dash: [4, 3] },
    { line: series.nis, words: 'step', colour: 'faint', width: 0.8, opacity: 0.5 },
    { line: series.nis_recent, words: 'last 10 s', colour: 'nis', width: 2 }] };
}

function bearings(run) {
  const { series } = run;
  const columns = [['accepted', 'used'], ['created', 'new'], ['thinned', 'thinned'], ['ambiguous', 'ambiguous'],
    ['rejected', 'refused']];
  const parts = columns
    .filter(([column]) => series[column].at(-1) > 0).map(([column, words]) => ({ counts: series[column], words, colour: words }));
  return { key: 'bearings', title: 'Bearings', unit: '1/s; numbers: so far', times: series.t, least: 0, parts };
}

function stepTime(run) {
  const { series } = run;
  return { key: 'step', title: 'Step time', unit: 'ms', times: series.t, logarithmic: true,
    parts: [{ line: times(series.step_us, 1e-3), words: '', colour: 'time', width: 1 }] };
}
