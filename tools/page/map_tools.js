// The layer switches and tools of the live map.

import { liveLayers } from './live_map.js';
import { mapAsGeoJson, exportMenu } from './map_export.js';
import { element } from './words.js';

const buttonTurn = Math.PI / 12;

function button(words, title, onclick, more = {}) {
  return element('button', { type: 'button', title, onclick, ...more }, words);
}

/// True if the layer has something to show; others have no switch.
function hasLayer(store, key) {
  if (key === 'truth') return store.truth.length > 0;
  if (key === 'hindsight') return store.path.length > 0;
  if (key === 'odometry') return Number.isFinite(store.poses.last('odom_x'));
  return true;
}

/// The path with at most `most` points.
function wayOf(columns, x, y, most = 20000) {
  const xs = columns.get(x), ys = columns.get(y), by = Math.max(1, Math.ceil(xs.length / most)), points = [];
  const rounded = (value) => Number(value.toFixed(4));
  for (let i = 0; i < xs.length; i += by) if (Number.isFinite(xs[i])) points.push([rounded(xs[i]), rounded(ys[i])]);
  return points;
}

export function liveGeoJson({ poses, truth, map, path }) {
  const ways = [{ name: 'path', points: wayOf(poses, 'x', 'y') }, { name: 'odometry', points: wayOf(poses, 'odom_x', 'odom_y') },
    { name: 'truth', points: wayOf(truth, 'x', 'y') }, { name: 'path in hindsight', points: path.map(([, x, y]) => [x, y]) }];
  return mapAsGeoJson(ways, map.landmarks);
}

export class MapTools {
  /// `map` is a LiveMap; `tell(words)` shows a message.
  constructor(map, tell) {
    const { store, link, view } = map;
    this.map = map;
    this.chips = liveLayers.map(([key, words, swatch]) => [key, button(words, `Show or hide: ${words}`,
      (event) => event.currentTarget.setAttribute('aria-pressed', map.toggle(key)), { class: 'chip', 'aria-pressed': 'true' }),
        swatch]);
    for (const [, chip, swatch] of this.chips) chip.prepend(element('span', { class: `swatch ${swatch}` }));
    const turn = (by) => () => { view.rotate(by), map.become('free'); };
    this.all = button('All', 'Show everything (0)', () => map.become('all'), { 'aria-pressed': 'true' });
    this.follow = button('Follow', 'Keep the robot in the middle (F)', () => this.toggleFollow(), { 'aria-pressed': 'false' });
    this.measure = button('Measure', 'Measure a distance: press, drag, let go (M)', () => this.toggleRuler(),
      { 'aria-pressed': 'false' });
    this.tools = element('div', { class: 'tools', role: 'toolbar', 'aria-label': 'Map tools' }, this.all, this.follow, this.measure,
      button('−', 'Smaller (-)', () => this.#zoom(0.7), { 'aria-label': 'Smaller' }), button('+', 'Larger (+)',
        () => this.#zoom(1.4), { 'aria-label': 'Larger' }),
      button('↺', 'Turn the map left (R)', turn(buttonTurn), { 'aria-label': 'Turn the map left' }),
      button('↻', 'Turn the map right (Shift R)', turn(-buttonTurn), { 'aria-label': 'Turn the map right' }),
      button('N', 'The map’s y axis up', () => { view.face(0), map.become(map.mode); }, { 'aria-label': 'The map’s y axis up' }),
      exportMenu(map, () => liveGeoJson(store), () => (Number.isFinite(link.cursor) ? link.cursor : 0), tell));
    this.layers = element('div', { class: 'layers', role: 'group', 'aria-label': 'Layers' }, ...this.chips.map(([, chip]) => chip));
    map.moded = () => this.update();
  }

  /// Zooms; about the robot if the view follows it.
  #zoom(factor) {
    this.map.view.zoom(factor);
    this.map.become(this.map.mode === 'follow' ? 'follow' : 'free');
  }

  toggleFollow() {
    this.map.become(this.map.mode === 'follow' ? 'free' : 'follow');
  }

  toggleRuler() {
    const { ruler, canvas, surface } = this.map;
    ruler.set(!ruler.on);
    this.measure.setAttribute('aria-pressed', ruler.on);
    canvas.classList.toggle('measures', ruler.on);
    surface.redraw();
  }

  update() {
    const { map } = this;
    for (const [key, chip] of this.chips) chip.hidden = !hasLayer(map.store, key);
    this.all.setAttribute('aria-pressed', map.mode === 'all');
    this.follow.setAttribute('aria-pressed', map.mode === 'follow');
  }
}
