// Images with their detections: the one of the linked instant large, and all of them in a strip.

import { element, number } from './words.js';

export class Pictures {
  /// `pictures` is [{ t, why, src }], sorted by time.
  constructor(pictures, link) {
    this.pictures = pictures;
    this.link = link;
    this.large = element('img', { class: 'large', alt: '' });
    this.words = element('span', { class: 'faint' });
    this.buttons = pictures.map(({ t, why, src }) => element('button',
      { type: 'button', title: `${number(t, 1)} s${why ? `, ${why}` : ''}`, onclick: () => link.moveTo(t) },
      element('img', { src, alt: `Image at ${number(t, 1)} s`, loading: 'lazy' })));
    this.node = element('section', { class: 'card pictures' },
      element('div', { class: 'top' }, element('h3', {}, 'Images'), this.words), this.large,
      element('div', { class: 'strip' }, ...this.buttons),
      element('div', { class: 'faint' },
        'Lines: bearings seen. Arcs at the rim: where the map expected landmarks. Magenta: in nobody’s gate.'));
    link.listen(() => this.show());
    this.show();
  }

  /// Shows the last picture that is not after the cursor.
  show() {
    const after = this.pictures.findIndex(({ t }) => t > this.link.cursor + 1e-3);
    const index = after < 0 ? this.pictures.length - 1 : Math.max(0, after - 1);
    if (index === this.shown) return;
    this.shown = index;
    const { t, why, src } = this.pictures[index];
    this.large.src = src;
    this.large.alt = `Image at ${number(t, 1)} s with bearings seen and expected`;
    this.words.textContent = `${number(t, 1)} s${why ? `: ${why}` : ''}`;
    this.buttons.forEach((button, i) => button.setAttribute('aria-current', i === index));
  }
}
