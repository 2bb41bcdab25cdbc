// Places labels on a canvas without overlap with each other or with reserved areas.

const cell_px = 24;

export class LabelRoom {
  #cells = new Map();

  *#around(box) {
    for (let i = Math.floor(box.left / cell_px); i <= Math.floor(box.right / cell_px); ++i)
      for (let j = Math.floor(box.top / cell_px); j <= Math.floor(box.bottom / cell_px); ++j) yield `${i},${j}`;
  }

  /// Reserves a rectangle; all values are in pixels.
  take(left, top, width, height) {
    const box = { left, top, right: left + width, bottom: top + height };
    for (const cell of this.#around(box)) {
      if (!this.#cells.has(cell)) this.#cells.set(cell, []);
      this.#cells.get(cell).push(box);
    }
  }

  isFree(left, top, width, height) {
    const box = { left, top, right: left + width, bottom: top + height };
    for (const cell of this.#around(box))
      for (const other of this.#cells.get(cell) ?? [])
        if (other.left < box.right && box.left < other.right && other.top < box.bottom && box.top < other.bottom) return false;
    return true;
  }

  /// Reserves the first free one of several places of equal size; null if none is free.
  first(candidates, width, height) {
    const found = candidates.find(([left, top]) => this.isFree(left, top, width, height));
    if (found) this.take(...found, width, height);
    return found ?? null;
  }

  /// Reserves a place beside a mark of this radius and returns left and top of the label, or null. The first choice is
  /// to the right and slightly above.
  beside(x, y, radius, width, height) {
    const right = x + radius, left = x - radius - width, middle = x - width / 2, above = y - radius - height, below = y + radius;
    return this.first([[right, y - height + 2], [right, y - 2], [left, y - height + 2], [left, y - 2], [middle, above],
      [middle, below], [right, above], [left, above]], width, height);
  }
}
