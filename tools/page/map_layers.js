// Functions that draw the parts of a map. `view` is a Viewpoint; all coordinates are in the map frame.

import { strokeLine } from './canvas.js';
import { LabelRoom } from './label_room.js';
import { number } from './words.js';
import { decimalsOf, step } from './scale.js';

/// Draws a grid at round numbers of metres with a scale bar.
export function drawGrid(context, view, colours) {
  const by = step(view.width / view.scale, view.width / 90);
  const [left, low, right, high] = view.bounds();
  context.lineWidth = 1;
  for (let k = Math.ceil(left / by); k * by <= right; ++k) gridLine(context, view, colours, k === 0, [k * by, low], [k * by, high]);
  for (let k = Math.ceil(low / by); k * by <= high; ++k) gridLine(context, view, colours, k === 0, [left, k * by], [right, k * by]);
  const length = by * view.scale, y = view.height - 14;
  context.strokeStyle = colours.text;
  context.lineWidth = 2;
  context.beginPath();
  context.moveTo(12, y - 4), context.lineTo(12, y), context.lineTo(12 + length, y), context.lineTo(12 + length, y - 4);
  context.stroke();
  context.fillStyle = colours.text;
  context.textAlign = 'left';
  context.fillText(`${number(by, decimalsOf(by))} m`, 17, y - 6);
}

/// Vertical and horizontal lines lie on whole pixels, so that they are sharp.
function gridLine(context, view, colours, isAxis, from, to) {
  const sharp = (place) => (view.turn === 0 ? Math.round(place) + 0.5 : place);
  context.strokeStyle = isAxis ? colours.axis : colours.grid;
  context.beginPath();
  context.moveTo(sharp(view.px(...from)), sharp(view.py(...from)));
  context.lineTo(sharp(view.px(...to)), sharp(view.py(...to)));
  context.stroke();
}

/// Draws rows `from` to `to` of two columns as a line.
export function drawPath(context, view, xs, ys, from, to, colour, width, dash = []) {
  context.strokeStyle = colour;
  context.lineWidth = width;
  context.lineJoin = 'round';
  context.setLineDash(dash);
  const known = (i) => xs[from + i] !== null && ys[from + i] !== null;
  strokeLine(context, to - from, (i) => (known(i) ? view.px(xs[from + i], ys[from + i]) : NaN),
    (i) => (known(i) ? view.py(xs[from + i], ys[from + i]) : NaN));
  context.setLineDash([]);
}

/// The ellipse of two standard deviations. `covariance` is [xx, xy, yy] in m^2.
export function ellipse(context, view, x, y, covariance) {
  const [xx, xy, yy] = covariance;
  const middle = (xx + yy) / 2, apart = Math.hypot((xx - yy) / 2, xy);
  const long = 2 * Math.sqrt(Math.max(0, middle + apart)) * view.scale;
  const across = 2 * Math.sqrt(Math.max(0, middle - apart)) * view.scale;
  if (!Number.isFinite(long + across)) return false;
  const turn = 0.5 * Math.atan2(2 * xy, xx - yy);
  context.beginPath();
  context.ellipse(view.px(x, y), view.py(x, y), long, across, -turn - view.turn, 0, 2 * Math.PI);
  return true;
}

const nearEnough_px = 12;

/// The landmark at the pointer, or null.
export function nearestLandmark(landmarks, x, y, scale) {
  if (landmarks.length === 0) return null;
  const off = ({ at }) => Math.hypot(at[0] - x, at[1] - y) * scale;
  const nearest = landmarks.reduce((best, one) => (off(one) < off(best) ? one : best));
  return off(nearest) <= nearEnough_px ? nearest : null;
}

/// The number of the landmark on the page, and its id in files and LCM if that differs.
export function landmarkWords(word, name, id) {
  return `${word} ${name}${id === null || id === undefined || name === `${id}` ? '' : ` (id ${id})`}`;
}

/// Number of corners of a marker, and direction of the first one.
const corners = { square: [4, Math.PI / 4], triangle: [3, -Math.PI / 2], diamond: [4, 0], pentagon: [5, -Math.PI / 2],
  wedge: [3, Math.PI / 2] };

function marker(context, x, y, shape, radius) {
  context.beginPath();
  const known = corners[shape];
  if (!known) return context.arc(x, y, radius, 0, 2 * Math.PI);
  for (let k = 0; k < known[0]; ++k) {
    const turn = known[1] + (2 * Math.PI * k) / known[0];
    context.lineTo(x + 1.25 * radius * Math.cos(turn), y + 1.25 * radius * Math.sin(turn));
  }
  context.closePath();
}

/// Landmarks per frame when they are drawn in steps. From `many` landmarks on, markers are small and fewer have names;
/// from `crowd` on, they are dots.
const landmarksInAFrame = 500, many = 300, crowd = 1000;

/// Draws ellipses, then markers, then names where there is room. Landmarks that are not settled are hollow. A generator
/// that yields where a frame may end.
export function* paintLandmarks(context, view, map, colours) {
  const seen = map.landmarks.filter(({ at }) => view.sees(...at)), isCrowd = seen.length >= crowd;
  const largest = 0.35 * Math.min(view.width, view.height);
  for (const paintOne of [(one) => paintSpread(context, view, one, map.kinds[one.kind].colour, largest, isCrowd),
    (one) => (isCrowd ? paintSpeck : paintMarker)(context, view, one, map.kinds[one.kind], colours,
      seen.length > many ? 2 : 3.6)]) {
    for (let i = 0; i < seen.length; ++i) {
      paintOne(seen[i]);
      if (i % landmarksInAFrame === landmarksInAFrame - 1) yield;
    }
  }
  drawNames(context, view, seen, colours, seen.length > many ? 7 : 1);
}

/// Draws an ellipse, unless it is as large as the map or hidden by its marker.
function paintSpread(context, view, { at, covariance }, colour, largest, isCrowd) {
  const reach = 2 * Math.sqrt(Math.max(covariance[0], covariance[2])) * view.scale;
  if (!(reach < largest && reach > 1.5) || !ellipse(context, view, at[0], at[1], covariance)) return;
  context.lineWidth = 1;
  context.globalAlpha = isCrowd ? 0.3 : 0.16;
  context.fillStyle = context.strokeStyle = colour;
  context.fill();
  context.globalAlpha = 0.7;
  if (!isCrowd) context.stroke();
  context.globalAlpha = 1;
}

function paintMarker(context, view, { at, settled }, { colour, marker: shape }, colours, radius) {
  context.lineWidth = 1;
  marker(context, view.px(...at), view.py(...at), shape, radius);
  context.fillStyle = settled ? colour : colours.card;
  context.strokeStyle = settled ? colours.card : colour;
  context.fill();
  context.stroke();
}

function paintSpeck(context, view, { at, settled }, { colour }) {
  context.fillStyle = colour;
  context.globalAlpha = settled ? 1 : 0.5;
  context.fillRect(view.px(...at) - 1.5, view.py(...at) - 1.5, 3, 3);
  context.globalAlpha = 1;
}

export function drawLandmarks(context, view, map, colours) {
  for (const part of paintLandmarks(context, view, map, colours)) void part;
}

/// Draws names where there is room beside the markers; `apart` is the required room in multiples of a name's width.
function drawNames(context, view, landmarks, colours, apart) {
  const room = new LabelRoom(), height = 11;
  context.fillStyle = colours.text;
  context.textAlign = 'left';
  if (apart === 1) for (const { at } of landmarks) room.take(view.px(...at) - 4, view.py(...at) - 4, 8, 8);
  for (const { at, name } of landmarks) {
    if (name === '') continue;
    const width = context.measureText(name).width + 2;
    const x = view.px(...at), y = view.py(...at);
    const found = apart > 1 ? room.first([[x + 6, y - height]], apart * width, 3 * height) : room.beside(x, y, 6, width, height);
    if (found) context.fillText(name, found[0] + 1, found[1] + height - 2);
  }
}

export function drawTrueLandmarks(context, view, points, colours) {
  context.strokeStyle = colours.truth;
  context.lineWidth = 1.3;
  context.beginPath();
  for (const [x, y] of points) {
    const px = view.px(x, y), py = view.py(x, y);
    context.moveTo(px - 5, py), context.lineTo(px + 5, py), context.moveTo(px, py - 5), context.lineTo(px, py + 5);
  }
  context.stroke();
}

/// Draws the robot with its heading. A `size` of 1 is 20 pixels long.
export function drawRobot(context, view, x, y, heading, fill, edge, size = 1) {
  if (![x, y, heading].every(Number.isFinite)) return;
  context.save();
  context.translate(view.px(x, y), view.py(x, y));
  context.rotate(-heading - view.turn);
  context.beginPath();
  for (const [ahead, left] of [[12, 0], [-8, 7.5], [-4.5, 0], [-8, -7.5]]) context.lineTo(size * ahead, size * left);
  context.closePath();
  context.fillStyle = fill;
  context.strokeStyle = edge;
  context.lineWidth = 1.5;
  context.fill();
  context.stroke();
  context.restore();
}
