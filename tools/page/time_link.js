// The instant and the time range that all parts of a page share.

/// Times are seconds from `begin` to `end`. Listeners are called at most once per frame.
export class TimeLink {
  constructor(begin, end) {
    this.begin = begin;
    this.end = Math.max(end, begin + 1e-3);
    this.reset();
    this.cursor = this.end;
  }

  #listeners = [];
  #pending = false;

  listen(listener) {
    this.#listeners.push(listener);
  }

  /// True if pointing at a chart without a button moves the cursor.
  get hovers() {
    return true;
  }

  get span() {
    return this.to - this.from;
  }

  moveTo(seconds) {
    this.cursor = Math.min(this.end, Math.max(this.begin, seconds));
    this.#tell();
  }

  /// Shows a range, clipped to the available time and at least a thousandth of it.
  show(from, to) {
    const whole = this.end - this.begin;
    const span = Math.min(whole, Math.max(whole / 1000, to - from));
    this.from = Math.min(this.end - span, Math.max(this.begin, from));
    this.to = this.from + span;
    this.#tell();
  }

  /// Shortens the range by `factor`; `about` keeps its place.
  zoom(factor, about) {
    this.show(about - (about - this.from) * factor, about + (this.to - about) * factor);
  }

  reset() {
    this.from = this.begin;
    this.to = this.end;
    this.#tell();
  }

  /// Must be called after other changes of the shown content.
  changed() {
    this.#tell();
  }

  #tell() {
    if (this.#pending) return;
    this.#pending = true;
    requestAnimationFrame(() => {
      this.#pending = false;
      for (const listener of this.#listeners) listener();
    });
  }
}

/// Index of the last time that is not after `seconds`; 0 if all are after.
export function indexAt(times, seconds) {
  let low = 0, high = times.length;
  while (high - low > 1) {
    const middle = (low + high) >> 1;
    if (times[middle] <= seconds) low = middle;
    else high = middle;
  }
  return low;
}
