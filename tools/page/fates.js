// The fate of a bearing. Colour, dashes and mark all encode it, so that each of them alone is enough.

export const fates = {
  used: { words: 'used', colour: 'used', dash: [], mark: 'disc', sign: '●' },
  refused: { words: 'refused', colour: 'refused', dash: [6, 4], mark: 'cross', sign: '✕' },
  new: { words: 'new', colour: 'new', dash: [2, 3], mark: 'plus', sign: '✚' },
  ambiguous: { words: 'ambiguous', colour: 'ambiguous', dash: [9, 3, 2, 3], mark: 'diamond', sign: '◇' },
  thinned: { words: 'thinned', colour: 'thinned', dash: [2, 6], mark: 'dot', sign: '•' },
  unknown: { words: 'not said', colour: 'faint', dash: [3, 7], mark: 'ring', sign: '○' },
};

export const fateOf = (name) => fates[name] ?? fates.unknown;

/// Counts the bearings of each fate, in the order above: [[name, count]].
export function countFates(bearings) {
  const counts = new Map(Object.keys(fates).map((name) => [name, 0]));
  for (const bearing of bearings) {
    const name = fates[bearing[4]] ? bearing[4] : 'unknown';
    counts.set(name, counts.get(name) + 1);
  }
  return [...counts].filter(([, count]) => count > 0);
}

export function drawMark(context, x, y, { mark, colour }, colours, radius = 4) {
  context.strokeStyle = context.fillStyle = colours[colour];
  context.lineWidth = 1.8;
  context.beginPath();
  if (mark === 'cross') {
    context.moveTo(x - radius, y - radius), context.lineTo(x + radius, y + radius);
    context.moveTo(x - radius, y + radius), context.lineTo(x + radius, y - radius);
  } else if (mark === 'plus') {
    context.moveTo(x - radius, y), context.lineTo(x + radius, y), context.moveTo(x, y - radius), context.lineTo(x, y + radius);
  } else if (mark === 'diamond') {
    context.moveTo(x, y - radius), context.lineTo(x + radius, y), context.lineTo(x, y + radius), context.lineTo(x - radius, y);
    context.closePath();
  } else context.arc(x, y, mark === 'dot' ? radius / 2 : radius, 0, 2 * Math.PI);
  if (mark === 'disc' || mark === 'dot') context.fill();
  else context.stroke();
}

/// Draws the rays of an image from `pose` ({ x, y, heading }): to the landmark if it is known, else faded to the edge.
export function drawRays(context, view, pose, bearings, landmarks, colours) {
  const far = (view.width + view.height) / view.scale;
  context.lineWidth = 1.3;
  for (const [azimuth, , , , name, id] of bearings) {
    const fate = fateOf(name), landmark = landmarks?.get(id);
    const reach = landmark ? Math.hypot(landmark.at[0] - pose.x, landmark.at[1] - pose.y) : far;
    const turn = pose.heading + azimuth, x = pose.x + reach * Math.cos(turn), y = pose.y + reach * Math.sin(turn);
    context.globalAlpha = landmark ? 0.6 : 0.4;
    context.strokeStyle = colours[fate.colour];
    context.setLineDash(fate.dash);
    context.beginPath();
    context.moveTo(view.px(pose.x, pose.y), view.py(pose.x, pose.y)), context.lineTo(view.px(x, y), view.py(x, y));
    context.stroke();
    context.setLineDash([]);
    if (landmark) drawMark(context, view.px(x, y), view.py(x, y), fate, colours, 3);
  }
  context.globalAlpha = 1;
}
