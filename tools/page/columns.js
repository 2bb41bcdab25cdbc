// Growing columns of numbers with a bounded number of rows, stored as contiguous arrays for drawing.

export class Columns {
  #columns = new Map();
  #views = new Map();

  /// Keeps at most `most` rows. `onFull` "forget" drops the older half; "thin" thins it out, so that the whole path
  /// stays.
  constructor(names, most, onFull = 'thin') {
    this.names = names;
    this.most = most;
    this.onFull = onFull;
    this.clear();
  }

  clear() {
    this.length = 0;
    this.generation = (this.generation ?? 0) + 1;  // changes whenever the numbering of rows changes
    for (const name of this.names) this.#columns.set(name, new Float64Array(256));
    this.#views.clear();
  }

  /// Appends a row with values in the order of `names`; NaN for unknown values.
  push(...values) {
    if (this.length === this.most) this.#makeRoom();
    if (this.length === this.#columns.get(this.names[0]).length) this.#grow();
    this.names.forEach((name, k) => { this.#columns.get(name)[this.length] = values[k] ?? NaN; });
    ++this.length;
    this.#views.clear();
  }

  /// Sets a value of an existing row.
  set(name, row, value) {
    this.#columns.get(name)[row] = value;
  }

  /// The column as an array, valid until the next change of the rows.
  get(name) {
    const known = this.#views.get(name);
    if (known) return known;
    const view = this.#columns.get(name).subarray(0, this.length);
    this.#views.set(name, view);
    return view;
  }

  last(name) {
    return this.length > 0 ? this.#columns.get(name)[this.length - 1] : NaN;
  }

  #grow() {
    for (const [name, values] of this.#columns) {
      const larger = new Float64Array(Math.min(this.most, 2 * values.length));
      larger.set(values);
      this.#columns.set(name, larger);
    }
  }

  #makeRoom() {
    const half = this.most >> 1, kept = this.onFull === 'thin' ? half >> 1 : 0;
    for (const values of this.#columns.values()) {
      for (let row = 0; row < kept; ++row) values[row] = values[2 * row];
      values.copyWithin(kept, half, this.length);
    }
    this.length -= half - kept;
    ++this.generation;
    this.#views.clear();
  }
}
