// A canvas with the resolution of the screen and the colours of the style sheet.

/// Surfaces to draw, in the order of their waiting time.
const waiting = new Set();
let mostInAFrame = Infinity, asked = false;

/// Limits the number of surfaces drawn in a frame, so that no frame takes long. Surfaces that are out of sight wait
/// until they are visible.
export function paceSurfaces(surfacesInAFrame) {
  mostInAFrame = surfacesInAFrame;
}

function ask() {
  if (asked || waiting.size === 0) return;
  asked = true;
  requestAnimationFrame(() => {
    asked = false;
    let left = mostInAFrame;
    for (const surface of [...waiting]) {
      if (!surface.first && left-- <= 0) continue;
      waiting.delete(surface);
      surface.drawNow();
    }
    ask();
  });
}

export class Surface {
  #inSight = true;

  /// Calls `draw(context, width, height)`, in CSS pixels, after a change of the size and after redraw(). With `first`
  /// the surface is drawn in the next frame in spite of the limit.
  constructor(canvas, draw, first = false) {
    this.canvas = canvas;
    this.draw = draw;
    this.first = first;
    this.context = canvas.getContext('2d');
    new ResizeObserver(() => this.redraw()).observe(canvas);
    for (const query of ['(prefers-color-scheme: dark)', 'print'])
      matchMedia(query).addEventListener('change', () => { this.colours = null, this.redraw(); });
    if (mostInAFrame < Infinity) new IntersectionObserver((seen) => this.#see(seen.at(-1).isIntersecting)).observe(canvas);
  }

  #see(inSight) {
    this.#inSight = inSight;
    if (inSight) this.redraw();
    else waiting.delete(this);
  }

  /// Requests a drawing; several calls within a frame give one drawing.
  redraw() {
    if (!this.#inSight) return;
    waiting.add(this);
    ask();
  }

  drawNow() {
    const width = this.canvas.clientWidth, height = this.canvas.clientHeight;
    if (width === 0 || height === 0) return;
    const ratio = window.devicePixelRatio || 1;
    const columns = Math.round(width * ratio), rows = Math.round(height * ratio);
    if (this.canvas.width !== columns || this.canvas.height !== rows) {
      this.canvas.width = columns;
      this.canvas.height = rows;
    }
    this.context.setTransform(ratio, 0, 0, ratio, 0, 0);
    this.context.clearRect(0, 0, width, height);
    this.colours ??= colours(this.canvas);
    this.context.font = `11px ${this.colours.font}`;
    this.draw(this.context, width, height);
  }
}

const names = ['text', 'faint', 'grid', 'axis', 'card', 'estimate', 'odometry', 'truth', 'hindsight', 'nis', 'band',
  'used', 'new', 'thinned', 'ambiguous', 'refused', 'time', 'starting', 'tracking', 'degraded', 'lost'];

function colours(node) {
  const style = getComputedStyle(node);
  const found = { font: style.fontFamily };
  for (const name of names) found[name] = style.getPropertyValue(`--${name}`).trim();
  return found;
}

/// A pen that draws lines between points and is lifted at points that are no numbers. It returns whether the point was
/// drawn.
function pen(context) {
  let down = false;
  context.beginPath();
  return (x, y) => {
    const is = Number.isFinite(x) && Number.isFinite(y);
    if (is && down) context.lineTo(x, y);
    else if (is) context.moveTo(x, y);
    return (down = is);
  };
}

/// Draws a line through the points; points that are no numbers interrupt it.
export function strokeLine(context, count, x, y) {
  const drawTo = pen(context);
  for (let i = 0; i < count; ++i) drawTo(x(i), y(i));
  context.stroke();
}

/// The same for many points whose x does not decrease: within half a pixel, only the first, the extremes and the last
/// are drawn.
export function strokeDense(context, count, x, y) {
  const column = { at: NaN, low: 0, high: 0, last: 0 }, drawTo = pen(context);
  const leave = () => {
    if (Number.isNaN(column.at)) return;
    for (const py of [column.low, column.high, column.last]) context.lineTo(column.at, py);
    column.at = NaN;
  };
  for (let i = 0; i < count; ++i) {
    const px = Math.round(2 * x(i)) / 2, py = y(i);
    if (px === column.at && Number.isFinite(py)) {
      column.low = Math.min(column.low, py), column.high = Math.max(column.high, py), column.last = py;
      continue;
    }
    leave();
    if (drawTo(px, py)) column.at = px, column.low = column.high = column.last = py;
  }
  leave();
  context.stroke();
}
