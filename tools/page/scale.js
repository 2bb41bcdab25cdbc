// Scales from values to pixels, and ticks.

/// A round step that divides `span` into about `count` parts.
export function step(span, count) {
  const raw = span / Math.max(1, count);
  const power = 10 ** Math.floor(Math.log10(raw));
  const lead = raw / power;
  return power * (lead < 1.5 ? 1 : lead < 3.5 ? 2 : lead < 7.5 ? 5 : 10);
}

export function ticks(from, to, count) {
  const by = step(to - from, count);
  const found = [];
  for (let k = Math.ceil(from / by - 1e-9); k * by <= to + 1e-9 * by; ++k) found.push(k * by);
  return found;
}

/// Ticks for seconds: tenths and whole seconds, then half minutes, minutes, hours.
export function timeTicks(from, to, count) {
  const span = (to - from) / Math.max(1, count);
  const by = [0.1, 0.2, 0.5, 1, 2, 5, 10, 15, 30, 60, 120, 300, 600, 900, 1800, 3600, 7200].find((s) => s >= span) ?? 14400;
  const found = [];
  for (let k = Math.ceil(from / by - 1e-9); k * by <= to + 1e-9; ++k) found.push(k * by);
  return found;
}

/// Ticks at powers of ten, and also at 2 and 5 times these if there are few.
export function logTicks(from, to) {
  const first = Math.floor(Math.log10(from)), last = Math.ceil(Math.log10(to));
  const found = [];
  for (let power = first; power <= last; ++power) found.push(10 ** power);
  const stride = Math.ceil(found.length / 5);
  return found.filter((value, i) => value >= from * 0.999 && value <= to * 1.001 && i % stride === 0);
}

/// A function from [from, to] to [start, end], linear or logarithmic.
export function scale(from, to, start, end, logarithmic = false) {
  const place = logarithmic ? (value) => Math.log(Math.max(value, from * 1e-3)) : (value) => value;
  const low = place(from), factor = (end - start) / (place(to) - low || 1);
  return (value) => (value === null || value === undefined ? NaN : start + (place(value) - low) * factor);
}

export function decimalsOf(by) {
  return Math.max(0, Math.min(6, -Math.floor(Math.log10(by) + 1e-9)));
}
