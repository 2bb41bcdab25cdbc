// Saves the shown map as a file: PNG, SVG or GeoJSON in metres.

import { SvgContext } from './svg_context.js';
import { element } from './words.js';

function save(blob, name) {
  const link = element('a', { href: URL.createObjectURL(blob), download: name });
  document.body.append(link);
  link.click();
  link.remove();
  setTimeout(() => URL.revokeObjectURL(link.href), 10000);
}

/// Draws with `paint(context, width, height)` of `map`, whose surface has the size and the colours.
export function mapAsSvg(map) {
  const { clientWidth: width, clientHeight: height } = map.canvas, context = new SvgContext(width, height);
  map.paint(context, width, height);
  return context.text(map.surface.colours.card);
}

/// Twice the resolution of the screen.
export function mapAsPng(map) {
  const { clientWidth: width, clientHeight: height } = map.canvas, canvas = document.createElement('canvas');
  canvas.width = 2 * width, canvas.height = 2 * height;
  const context = canvas.getContext('2d');
  context.fillStyle = map.surface.colours.card;
  context.fillRect(0, 0, canvas.width, canvas.height);
  context.scale(2, 2);
  context.font = map.surface.context.font;
  map.paint(context, width, height);
  return new Promise((done) => canvas.toBlob(done, 'image/png'));
}

const feature = (type, coordinates, properties) => ({ type: 'Feature', properties, geometry: { type, coordinates } });

/// In metres of the map frame, in the format of `azimuth export`. `ways` is [{ name, points: [[x, y], ...] }];
/// `landmarks` is [{ id, name, at, covariance, state }].
export function mapAsGeoJson(ways, landmarks) {
  const lines = ways.filter(({ points }) => points.length > 1)
    .map(({ name, points }) => feature('LineString', points, { what: name }));
  const points = landmarks.map(({ id, name, at, covariance: [xx, xy, yy], state }) => feature('Point', at,
    { what: 'landmark', landmark_id: id ?? name, covariance_m2: [[xx, xy], [xy, yy]], ...(state ? { state } : {}) }));
  return JSON.stringify({ type: 'FeatureCollection', name: 'map_frame_in_metres', crs: null,
    'azimuth:frame': { coordinates: 'map', unit: 'm' }, features: [...lines, ...points] });
}

/// The page address with the shown moment.
export function momentAddress(seconds) {
  return `${location.origin}${location.pathname}#t=${seconds.toFixed(3)}`;
}

/// The moment in the page's address, or null.
export function momentWanted() {
  const found = /[#&]t=(-?\d+(?:\.\d+)?)/.exec(location.hash);
  return found ? Number(found[1]) : null;
}

/// A menu for saving. `geoJson()` returns the text, `seconds()` the moment; `tell(words)` shows a message.
export function exportMenu(map, geoJson, seconds, tell) {
  const stem = () => `azimuth-${seconds().toFixed(1)}s`;
  const item = (words, onclick) => element('button', { type: 'button', onclick: () => { menu.open = false; onclick(); } }, words);
  const copy = async () => {
    const address = momentAddress(seconds());
    history.replaceState(null, '', address);
    try {
      await navigator.clipboard.writeText(address);
      tell('The link to this moment is in the clipboard.');
    } catch {
      tell('The link to this moment is in the address bar.');
    }
  };
  const menu = element('details', { class: 'menu' }, element('summary', {}, 'Save'), element('div', { class: 'items' },
    item('Picture (PNG)', async () => save(await mapAsPng(map), `${stem()}.png`)),
    item('Drawing (SVG)', () => save(new Blob([mapAsSvg(map)], { type: 'image/svg+xml' }), `${stem()}.svg`)),
    item('Places (GeoJSON)', () => save(new Blob([geoJson()], { type: 'application/geo+json' }), `${stem()}.geojson`)),
    item('Link to this moment', copy)));
  menu.addEventListener('keydown', (event) => { if (event.key === 'Escape') menu.open = false; });
  document.addEventListener('click', (event) => { if (!menu.contains(event.target)) menu.open = false; });
  return menu;
}
