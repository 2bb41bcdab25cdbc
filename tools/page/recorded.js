// The page of a served recording: the report with fetched data, the moment in the page's address, and maps to save.

import { exportMenu, mapAsGeoJson, momentWanted } from './map_export.js';
import { OverlayMap } from './overlay_map.js';
import { showReport } from './report.js';
import { element } from './words.js';

const both = (xs, ys) => (xs ? xs.map((x, i) => [x, ys[i]]).filter(([x, y]) => x !== null && y !== null) : []);

function geoJson({ series, map }) {
  const ways = [{ name: 'path', points: both(series.x, series.y) }, { name: 'truth', points: both(series.truth_x, series.truth_y) },
    { name: 'odometry', points: both(series.odometry_x, series.odometry_y) }, { name: 'path in hindsight', points: map.hindsight }];
  return mapAsGeoJson(ways, map.landmarks);
}

async function load() {
  const answer = await fetch('run.json');
  if (!answer.ok) throw new Error((await answer.text()).trim().slice(0, 300) || `the server answers ${answer.status}`);
  return await answer.json();
}

/// Fetches the run and fills the element.
export async function showRecorded(root) {
  const data = await load();
  const { link, maps } = showReport(data, root), said = element('span', { role: 'status', class: 'faint' });
  document.title = `${data.runs.map(({ name }) => name).join(', ')} - Azimuth`;
  const tell = (words) => { said.textContent = words; };
  maps.forEach((map, i) => {
    const menu = exportMenu(map, () => geoJson(data.runs[i]), () => link.cursor, tell);
    map.node.querySelector('.right-end').append(said, menu);
  });
  if (data.runs.length > 1) document.querySelector('.panels').before(new OverlayMap(data.runs, link).node);
  const seek = () => {
    const wanted = momentWanted();
    if (wanted !== null) link.moveTo(wanted);
  };
  addEventListener('hashchange', seek);
  seek();
}
