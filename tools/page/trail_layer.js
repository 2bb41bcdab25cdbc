// Draws long paths with visible detail only, in parts that fit into a frame.

const rowsInAFrame = 5000;

/// Points closer than this to the last drawn one are skipped.
const finest_px = 0.9;

/// Style of a stretch of the path by health; colour and dashes both show it.
export const healthStyles = [{ colour: 'starting', width: 1.6, dash: [2, 3] }, { colour: 'estimate', width: 2.2, dash: [] },
  { colour: 'degraded', width: 2.6, dash: [7, 4] }, { colour: 'lost', width: 2.8, dash: [2, 4] }];

/// Draws rows `from` to `to` of the columns `x` and `y` in one style.
function strokeRows(context, view, x, y, from, to) {
  let lastX = NaN, lastY = NaN, wasOut = 0;
  context.beginPath();
  for (let i = from; i < to; ++i) {
    const px = view.px(x[i], y[i]), py = view.py(x[i], y[i]);
    if (Number.isNaN(px)) {
      lastX = NaN;
      continue;
    }
    if (i + 1 < to && Math.abs(px - lastX) + Math.abs(py - lastY) < finest_px) continue;
    // Both ends are beyond the same side, so the line is out of sight.
    const out = (px < -20 ? 1 : px > view.width + 20 ? 2 : 0) | (py < -20 ? 4 : py > view.height + 20 ? 8 : 0);
    if (Number.isNaN(lastX) || (out & wasOut)) context.moveTo(px, py);
    else context.lineTo(px, py);
    lastX = px, lastY = py, wasOut = out;
  }
  context.stroke();
}

/// Draws rows in the only style of `styles`, or in the style of their health. They are joined to the row before.
function paintRows(context, view, columns, [xs, ys], styles, colours, from, to) {
  const x = columns.get(xs), y = columns.get(ys), health = styles.length > 1 ? columns.get('health') : null;
  const way = columns.names.includes('way') ? columns.get('way') : null;
  context.lineJoin = 'bevel';
  for (let begin = from; begin < to;) {
    const kind = health ? health[begin] : 0;
    let end = begin + 1;
    while (end < to && (!health || health[end] === kind)) ++end;
    const style = styles[kind] ?? styles[0];
    context.strokeStyle = colours[style.colour];
    context.lineWidth = style.width;
    context.setLineDash(style.dash);
    // The dashes continue those of the previous part.
    if (style.dash.length > 0 && way) context.lineDashOffset = (way[Math.max(0, begin - 1)] * view.scale) % 840;
    strokeRows(context, view, x, y, Math.max(0, begin - 1), end);
    begin = end;
  }
  context.setLineDash([]);
  context.lineDashOffset = 0;
}

/// The functions `paint` and `append` of MapCache for the path in `columns`.
export function trailPainter(columns, names, styles) {
  return [
    function* paint(context, view, colours) {
      let row = 0;
      while (row < columns.length) {
        const next = Math.min(columns.length, row + rowsInAFrame);
        paintRows(context, view, columns, names, styles, colours, row, next);
        row = next;
        if (row < columns.length) yield;
      }
      return row;
    },
    (context, view, colours, from) => {
      if (columns.length > from) paintRows(context, view, columns, names, styles, colours, from, columns.length);
      return columns.length;
    },
  ];
}
