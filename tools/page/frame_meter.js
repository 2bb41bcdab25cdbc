// Measures the frame times of the page with its own clock.

const kept = 600;

export class FrameMeter {
  #times = [];
  #last = null;

  constructor() {
    const tick = (now) => {
      if (this.#last !== null) this.#times.push(now - this.#last);
      if (this.#times.length > kept) this.#times.splice(0, this.#times.length - kept);
      this.#last = document.hidden ? null : now;
      requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  clear() {
    this.#times = [];
  }

  /// Statistics of the time between the last frames in milliseconds: { count, median, p95, worst, fps }.
  figures() {
    const sorted = [...this.#times].sort((a, b) => a - b), at = (share) => sorted[Math.floor(share * (sorted.length - 1))] ?? NaN;
    const sum = sorted.reduce((total, ms) => total + ms, 0);
    return { count: sorted.length, median: at(0.5), p95: at(0.95), worst: at(1), fps: (1000 * sorted.length) / sum };
  }
}
