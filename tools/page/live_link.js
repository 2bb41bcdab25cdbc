// The time link of a live page: the cursor follows the present until the user looks back.

import { TimeLink } from './time_link.js';

/// Initial and smallest length of the shown time range, in seconds.
const firstWindow = 120, shortest = 2;

export class LiveLink extends TimeLink {
  constructor() {
    super(0, 1);
    this.clear();
  }

  clear() {
    this.following = true;
    this.window = firstWindow;  // null: the whole time
    this.begin = Infinity, this.end = -Infinity;
    this.from = 0, this.to = firstWindow, this.cursor = 0;
  }

  /// Pointing does not move the cursor, because a resting mouse would stop it.
  get hovers() {
    return false;
  }

  get any() {
    return this.end > -Infinity;
  }

  grow(seconds) {
    this.begin = Math.min(this.begin, seconds), this.end = Math.max(this.end, seconds);
    if (this.following) this.#slide();
    else this.changed();
  }

  /// Returns to the present.
  follow() {
    this.following = true;
    this.#slide();
  }

  #slide() {
    if (!this.any) return;
    this.cursor = this.end;
    const span = this.window ?? Math.max(shortest, this.end - this.begin);
    this.from = Math.max(this.begin, this.end - span), this.to = this.from + span;
    this.changed();
  }

  moveTo(seconds) {
    if (!this.any) return;
    if (seconds >= this.end - this.span / 200) return this.follow();
    this.following = false;
    super.moveTo(seconds);
  }

  show(from, to) {
    if (!this.any) return;
    const span = Math.max(shortest, to - from);
    this.window = span > 1.05 * (this.end - this.begin) + firstWindow ? null : span;
    if (this.following) return this.#slide();
    this.to = Math.min(Math.max(to, this.begin + span / 2), this.end);
    this.from = this.to - span;
    this.changed();
  }

  reset() {
    this.window = null;
    if (this.following) return this.#slide();
    this.from = this.begin, this.to = this.end;
    this.changed();
  }
}
