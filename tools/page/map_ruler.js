// Measures a distance on the map between pressing and releasing the pointer.

import { number } from './words.js';

export class Ruler {
  on = false;
  ends = null;

  /// For steerMap: takes the pointer while the ruler is on.
  press(x, y, phase) {
    if (!this.on) return false;
    if (phase === 'down') this.ends = [[x, y], [x, y]];
    else this.ends[1] = [x, y];
    return true;
  }

  /// Switches the ruler on or off; off clears it.
  set(on) {
    this.on = on;
    if (!on) this.ends = null;
  }

  words() {
    if (!this.ends) return '';
    const [[x0, y0], [x1, y1]] = this.ends;
    const degrees = (Math.atan2(y1 - y0, x1 - x0) * 180) / Math.PI;
    return `${number(Math.hypot(x1 - x0, y1 - y0), 2)} m, ${number(degrees, 0)}°`;
  }

  draw(context, view, colours) {
    if (!this.ends) return;
    const [[ax, ay], [bx, by]] = this.ends.map(([x, y]) => [view.px(x, y), view.py(x, y)]);
    const long = Math.hypot(bx - ax, by - ay) || 1, across = [(-6 * (by - ay)) / long, (6 * (bx - ax)) / long];
    context.strokeStyle = colours.text;
    context.lineWidth = 1.6;
    context.beginPath();
    context.moveTo(ax, ay), context.lineTo(bx, by);
    for (const [x, y] of [[ax, ay], [bx, by]]) {
      context.moveTo(x - across[0], y - across[1]);
      context.lineTo(x + across[0], y + across[1]);
    }
    context.stroke();
    this.#label(context, (ax + bx) / 2, (ay + by) / 2, colours);
  }

  #label(context, x, y, colours) {
    const words = this.words(), width = context.measureText(words).width + 12;
    context.fillStyle = colours.card;
    context.fillRect(x - width / 2, y - 22, width, 18);
    context.fillStyle = colours.text;
    context.textAlign = 'center';
    context.fillText(words, x, y - 9);
  }
}
