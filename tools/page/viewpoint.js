// The viewpoint of a map: converts metres to pixels and back.

const leastScale = 0.02, mostScale = 8000;  // pixels per metre

export class Viewpoint {
  /// `centre` is the point of the map in the middle, in metres; `scale` is in pixels per metre, null before the first
  /// fit; `turn` is the counter-clockwise rotation of the map, in radians.
  constructor() {
    this.width = this.height = 1;
    this.centre = [0, 0];
    this.scale = null;
    this.face(0);
  }

  face(turn) {
    this.turn = Math.atan2(Math.sin(turn), Math.cos(turn));
    this.cos = Math.cos(turn), this.sin = Math.sin(turn);
  }

  /// A copy that is larger by `margin` pixels on each side.
  copy(margin = 0) {
    const made = Object.assign(new Viewpoint(), this);
    made.centre = [...this.centre];
    made.width += 2 * margin, made.height += 2 * margin;
    return made;
  }

  px(x, y) { return this.width / 2 + this.scale * (this.cos * (x - this.centre[0]) - this.sin * (y - this.centre[1])); }
  py(x, y) { return this.height / 2 - this.scale * (this.sin * (x - this.centre[0]) + this.cos * (y - this.centre[1])); }

  toMap(px, py) {
    const right = (px - this.width / 2) / this.scale, up = (this.height / 2 - py) / this.scale;
    return [this.centre[0] + this.cos * right + this.sin * up, this.centre[1] - this.sin * right + this.cos * up];
  }

  sees(x, y, margin = 60) {
    const px = this.px(x, y), py = this.py(x, y);
    return px > -margin && py > -margin && px < this.width + margin && py < this.height + margin;
  }

  /// Smallest and largest x and y in sight.
  bounds() {
    const corners = [[0, 0], [this.width, 0], [0, this.height], [this.width, this.height]].map(([px, py]) => this.toMap(px, py));
    const xs = corners.map(([x]) => x), ys = corners.map(([, y]) => y);
    return [Math.min(...xs), Math.min(...ys), Math.max(...xs), Math.max(...ys)];
  }

  pan(px, py) { this.centre = this.toMap(this.width / 2 - px, this.height / 2 - py); }

  /// Zooms; the point at the pixel stays there.
  zoom(factor, px = this.width / 2, py = this.height / 2) {
    this.#about(px, py, () => { this.scale = Math.min(mostScale, Math.max(leastScale, this.scale * factor)); });
  }

  rotate(by, px = this.width / 2, py = this.height / 2) {
    this.#about(px, py, () => this.face(this.turn + by));
  }

  #about(px, py, change) {
    const [x, y] = this.toMap(px, py);
    change();
    const [nowX, nowY] = this.toMap(px, py);
    this.centre = [this.centre[0] + x - nowX, this.centre[1] + y - nowY];
  }

  /// Fits the box [x, y, x, y] into the view.
  fit([left, low, right, high]) {
    const middle = [(left + right) / 2, (low + high) / 2], wide = Math.max(1, right - left), tall = Math.max(1, high - low);
    const across = Math.abs(this.cos) * wide + Math.abs(this.sin) * tall,
      along = Math.abs(this.sin) * wide + Math.abs(this.cos) * tall;
    this.scale = Math.min(mostScale, Math.max(leastScale, Math.min((this.width - 56) / across, (this.height - 64) / along)));
    this.centre = middle;
  }
}
