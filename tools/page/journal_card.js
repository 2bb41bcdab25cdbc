// The card with the journal, newest entry first.

import { element, number } from './words.js';

const mostShown = 200;
const signs = { info: '·', warning: '▲', error: '✖' };

export class JournalCard {
  #shown = null;

  constructor(store, link) {
    this.store = store;
    this.link = link;
    this.list = element('ol');
    this.node = element('section', { class: 'card journal', id: 'journal', 'aria-label': 'Journal' },
      element('div', { class: 'head' }, element('h2', {}, 'Journal')),
      element('div', { class: 'lines', tabindex: '0', role: 'log', 'aria-label': 'What happened, newest first' }, this.list));
  }

  update() {
    const { journal } = this.store;
    if (journal.at(-1) === this.#shown) return;
    const from = journal.lastIndexOf(this.#shown) + 1;
    this.#shown = journal.at(-1);
    this.list.prepend(...journal.slice(from).reverse().map((line) => this.#line(line)));
    while (this.list.childElementCount > mostShown) this.list.lastElementChild.remove();
  }

  /// A line of the journal; a time within the drive is a link to this moment.
  #line({ t, text, level, at }) {
    const words = Number.isFinite(t) ? `${number(t, 1)} s` : at.toLocaleTimeString('en-GB');
    const when = Number.isFinite(t) ? element('button', { type: 'button', class: 'number',
      onclick: () => this.link.moveTo(t) }, words)
      : element('span', { class: 'number faint' }, words);
    return element('li', { class: level }, when, element('span', { class: 'sign', 'aria-label': level },
      signs[level] ?? signs.info), element('span', {}, text));
  }
}
