// Caches a part of the map as a picture, which moves with the view. When it no longer fits, a new one is drawn in
// steps.

import { Viewpoint } from './viewpoint.js';

/// Margin on each side of the view: share of its size, and largest number of pixels.
const share = 0.25, mostMargin = 300;

const appendEvery_ms = 300;

class Picture {
  constructor() {
    this.canvas = document.createElement('canvas');
    this.context = this.canvas.getContext('2d');
    this.view = new Viewpoint();
  }

  aim(view, ratio, font) {
    this.margin = Math.round(Math.min(mostMargin, share * Math.max(view.width, view.height)));
    this.view = view.copy(this.margin);
    this.ratio = ratio;
    const columns = Math.round(this.view.width * ratio), rows = Math.round(this.view.height * ratio);
    if (this.canvas.width !== columns || this.canvas.height !== rows) this.canvas.width = columns, this.canvas.height = rows;
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, this.view.width, this.view.height);
    this.context.font = font;
  }

  /// True if the picture covers `view` with `spare` further pixels.
  covers(view, spare = 0.4 * this.margin) {
    return [[0, 0], [view.width, 0], [0, view.height], [view.width, view.height]].every(([x, y]) => {
      const point = view.toMap(x, y), px = this.view.px(...point), py = this.view.py(...point);
      return px >= spare && py >= spare && px <= this.view.width - spare && py <= this.view.height - spare;
    });
  }

  /// Draws the picture at its place in `view`; on whole pixels if it is neither rotated nor scaled against the view.
  show(context, view) {
    const { ratio } = this, k = view.scale / this.view.scale, by = view.turn - this.view.turn;
    const [x, y] = [view.px(...this.view.centre), view.py(...this.view.centre)];
    context.save();
    if (k === 1 && by === 0) {
      context.setTransform(1, 0, 0, 1, 0, 0);
      context.drawImage(this.canvas, Math.round((x - this.view.width / 2) * ratio), Math.round((y - this.view.height / 2) * ratio));
    } else {
      context.imageSmoothingEnabled = false;  // for a few frames, until a sharp picture is ready
      context.translate(x, y);
      context.rotate(-by);
      context.scale(k, k);
      context.drawImage(this.canvas, -this.view.width / 2, -this.view.height / 2, this.view.width, this.view.height);
    }
    context.restore();
  }
}

export class MapCache {
  #front = new Picture();
  #back = new Picture();
  #job = null;
  #shown = null;  // key of the front picture; null: none yet
  #appended_ms = 0;
  #drawn = null;  // key of the picture being drawn

  /// `paint(context, view, colours)` is a generator that yields where a frame may end, and returns the state at its
  /// end. `append(context, view, colours, from)` paints everything newer than the state `from`, and returns the new
  /// state.
  constructor(paint, append = (context, view, colours, from) => from) {
    this.paint = paint;
    this.append = append;
  }

  /// Shows the picture in `view`. `key` names its content; another key causes a new picture. Returns true if a better
  /// picture is in work and the next frame must draw again. A started picture is always finished, so that a moving view
  /// shows one.
  draw(context, view, ratio, colours, key) {
    if (!this.#job && !this.#fits(view, ratio, key)) this.#begin(view, ratio, colours, key);
    if (this.#job) this.#goOn();
    if (this.#shown !== null) this.#show(context, view, colours);
    return this.#job !== null || !this.#fits(view, ratio, key);
  }

  /// New parts are added to the picture only from time to time, because drawing on a shown picture copies it.
  #show(context, view, colours) {
    const now_ms = performance.now();
    if (now_ms - this.#appended_ms > appendEvery_ms) {
      this.#appended_ms = now_ms;
      this.#front.end = this.append(this.#front.context, this.#front.view, colours, this.#front.end);
    }
    this.#front.show(context, view);
    this.append(context, view, colours, this.#front.end);
  }

  #fits(view, ratio, key) {
    const { view: own, ratio: ownRatio } = this.#front;
    return this.#shown === key && ownRatio === ratio && own.scale === view.scale && own.turn === view.turn
      && this.#front.covers(view);
  }

  #begin(view, ratio, colours, key) {
    this.#back.aim(view, ratio, `11px ${colours.font}`);
    this.#drawn = key;
    this.#job = this.paint(this.#back.context, this.#back.view, colours);
  }

  #goOn() {
    const { done, value } = this.#job.next();
    if (!done) return;
    [this.#front, this.#back] = [this.#back, this.#front];
    this.#front.end = value;
    this.#shown = this.#drawn;
    this.#job = null;
  }
}
