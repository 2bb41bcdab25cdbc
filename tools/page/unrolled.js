// Unrolls an omnidirectional picture by azimuth: from behind at the left edge over the left side to ahead in the
// middle. A table of pixels is computed once and used for every picture.

/// Size of the unrolled picture.
export const rows = 96, columns = 720;

/// The ring of the picture that shows the surroundings, and the direction of its azimuths. `geometry` is "image" of the
/// rig; `picture` has its width and height. The picture is larger than the image by a margin. Null if the geometry is
/// unknown.
export function ringOf(geometry, picture) {
  if (!geometry?.centre || !(geometry.width > 0) || !picture) return null;
  const margin = Math.max(0, (picture.width - geometry.width) / 2);
  const most = Math.min(picture.width, picture.height) / 2 - margin;
  return { ...geometry, margin, outer: Math.min(geometry.outer ?? most, most), inner: geometry.inner ?? 0,
    width: picture.width, height: picture.height };
}

/// The index of the picture's pixel for each place in the strip; -1 if there is none. The highest elevations are at the
/// rim of a mirror and in the middle of a lens that looks up.
export function pixelIndices({ centre: [u0, v0], beta, direction, offset, inner, outer, margin, width, height, looksUp }) {
  const indices = new Int32Array(rows * columns);
  for (let row = 0; row < rows; ++row) {
    const part = (row + 0.5) / rows, r = looksUp ? inner + part * (outer - inner) : outer - part * (outer - inner);
    for (let column = 0; column < columns; ++column) {
      const azimuth = Math.PI - (2 * Math.PI * (column + 0.5)) / columns, psi = direction * (azimuth - offset);
      const u = Math.round(u0 + r * Math.cos(psi) + margin), v = Math.round(beta * (v0 + r * Math.sin(psi)) + margin);
      indices[row * columns + column] = u >= 0 && v >= 0 && u < width && v < height ? v * width + u : -1;
    }
  }
  return indices;
}

export class Unrolled {
  #known = '';

  constructor() {
    this.strip = Object.assign(document.createElement('canvas'), { width: columns, height: rows });
    this.pixels = new Uint32Array(rows * columns);
    this.source = document.createElement('canvas');
    this.reader = this.source.getContext('2d', { willReadFrequently: true });
  }

  /// Unrolls a picture; returns whether the strip shows it.
  take(image, geometry, picture) {
    const ring = ringOf(geometry, picture);
    if (!ring || image.naturalWidth !== picture.width || image.naturalHeight !== picture.height) return false;
    const known = JSON.stringify(ring);
    if (known !== this.#known) {
      this.#known = known;
      this.indices = pixelIndices(ring);
      Object.assign(this.source, { width: ring.width, height: ring.height });
    }
    this.reader.drawImage(image, 0, 0);
    const from = new Uint32Array(this.reader.getImageData(0, 0, ring.width, ring.height).data.buffer);
    this.indices.forEach((index, i) => { this.pixels[i] = index < 0 ? 0 : from[index]; });
    this.strip.getContext('2d').putImageData(new ImageData(new Uint8ClampedArray(this.pixels.buffer), columns, rows), 0, 0);
    return true;
  }
}
