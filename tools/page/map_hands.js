// Moves a viewpoint by mouse, touch, pen and keys.

const turnStep = Math.PI / 12;

/// Dragging, wheel, two fingers and keys on `canvas` change `view` and call `moved()`. Double click and 0 call
/// `given.fit()`. `given.point(x, y)` receives the pointer in metres, or nothing when it has left. The optional
/// `given.press(x, y, phase)` with phase "down", "move" or "up" takes the pointer from the view by returning true.
export function steerMap(canvas, view, moved, given) {
  const pointers = new Map();
  let taken = false;
  const at = (event) => {
    const box = canvas.getBoundingClientRect();
    return [event.clientX - box.left, event.clientY - box.top];
  };
  const press = (event, phase) => given.press?.(...view.toMap(...at(event)), phase) === true;
  canvas.addEventListener('pointerdown', (event) => {
    if (!view.scale) return;
    canvas.setPointerCapture(event.pointerId);
    pointers.set(event.pointerId, at(event));
    taken = pointers.size === 1 && event.button === 0 && press(event, 'down');
  });
  canvas.addEventListener('pointermove', (event) => {
    if (!view.scale) return;
    given.point?.(...view.toMap(...at(event)));
    if (taken) return void press(event, 'move');
    if (!pointers.has(event.pointerId)) return;
    const before = [...pointers.values()], now = at(event), then = pointers.get(event.pointerId);
    pointers.set(event.pointerId, now);
    if (pointers.size === 2) pinch(view, before, [...pointers.values()]);
    else if (event.buttons === 2 || event.ctrlKey) view.rotate((then[0] - now[0]) * 0.008);
    else view.pan(now[0] - then[0], now[1] - then[1]);
    moved();
  });
  for (const end of ['pointerup', 'pointercancel'])
    canvas.addEventListener(end, (event) => {
      if (taken && view.scale) press(event, 'up');
      taken = false;
      pointers.delete(event.pointerId);
    });
  canvas.addEventListener('pointerleave', () => given.point?.());
  canvas.addEventListener('contextmenu', (event) => event.preventDefault());
  canvas.addEventListener('dblclick', () => given.fit());
  canvas.addEventListener('wheel', (event) => {
    event.preventDefault();
    if (!view.scale) return;
    view.zoom(Math.exp(-0.0016 * event.deltaY), ...at(event));
    moved();
  }, { passive: false });
  canvas.addEventListener('keydown', (event) => mapKey(event, view, moved, given));
}

function pinch(view, [a, b], [c, d]) {
  const middle = [(c[0] + d[0]) / 2, (c[1] + d[1]) / 2];
  view.pan(middle[0] - (a[0] + b[0]) / 2, middle[1] - (a[1] + b[1]) / 2);
  const apart = Math.hypot(b[0] - a[0], b[1] - a[1]);
  if (apart > 1) view.zoom(Math.hypot(d[0] - c[0], d[1] - c[1]) / apart, ...middle);
  const turned = Math.atan2(b[1] - a[1], b[0] - a[0]) - Math.atan2(d[1] - c[1], d[0] - c[0]);
  view.rotate(Math.atan2(Math.sin(turned), Math.cos(turned)), ...middle);
}

function mapKey(event, view, moved, given) {
  if (event.ctrlKey || event.metaKey || event.altKey || !view.scale) return;
  const moves = { ArrowLeft: [40, 0], ArrowRight: [-40, 0], ArrowUp: [0, 40], ArrowDown: [0, -40] };
  if (moves[event.key]) view.pan(...moves[event.key]), moved();
  else if (event.key === '+' || event.key === '=') view.zoom(1.25), moved();
  else if (event.key === '-') view.zoom(0.8), moved();
  else if (event.key === 'r') view.rotate(turnStep), moved();
  else if (event.key === 'R') view.rotate(-turnStep), moved();
  else if (event.key === '0') given.fit();
  else return;
  event.preventDefault();
  event.stopPropagation();
}
