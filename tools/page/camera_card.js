// The card with the newest picture, as large as it fits, and the panorama below it.

import { Panorama } from './panorama.js';
import { element, number } from './words.js';

export class CameraCard {
  #loading = false;

  constructor(store) {
    this.store = store;
    this.panorama = new Panorama(store);
    this.image = element('img', { class: 'newest', alt: 'The newest picture, with bearings seen and expected' });
    this.words = element('span', { class: 'faint number' });
    this.frame = element('div', { hidden: true }, this.image,
      element('p', { class: 'faint small' },
        'Lines: bearings seen. Arcs at the rim: where the map expected landmarks. Magenta: in nobody’s gate.'));
    this.node = element('section', { class: 'card camera', id: 'camera', 'aria-label': 'Camera' },
      element('div', { class: 'head' }, element('h2', {}, 'Camera'), this.words), this.frame, this.panorama.node);
  }

  /// Loads one picture at a time: the newest one when the previous one has arrived.
  update() {
    this.panorama.surface.redraw();
    const { picture } = this.store;
    if (!picture) this.shown = undefined;
    if (!picture || this.#loading || picture.seq === this.shown) return;
    this.#loading = true;
    const next = new Image();
    const end = (good) => {
      this.#loading = false;
      this.shown = picture.seq;
      if (good) this.#show(next, picture);
      this.update();
    };
    next.onload = () => end(true);
    next.onerror = () => end(false);
    next.src = `picture?n=${picture.seq}`;
  }

  #show(next, picture) {
    next.className = 'newest';
    next.alt = this.image.alt;
    this.image.replaceWith(next);
    this.image = next;
    this.panorama.show(next, picture);
    this.frame.hidden = false;
    this.words.textContent = `picture of ${number(picture.t, 1)} s`;
  }

  clear() {
    this.frame.hidden = true;
    this.shown = undefined;
    this.panorama.show(null);
    this.words.textContent = '';
  }
}
