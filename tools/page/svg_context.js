// A drawing context that makes SVG, with the part of the canvas interface that the maps use.

const escaped = (text) => `${text}`.replace(/[&<>"]/g, (c) => ({ '&': '&amp;', '<': '&lt;', '>': '&gt;', '"': '&quot;' })[c]);
const brief = (value) => Number(value.toFixed(2));

export class SvgContext {
  globalAlpha = 1;
  lineWidth = 1;
  lineDashOffset = 0;
  fillStyle = '#000';
  strokeStyle = '#000';
  lineJoin = 'miter';
  textAlign = 'left';
  font = '11px sans-serif';
  #path = '';
  #dash = [];
  #transform = '';
  #kept = [];
  #parts = [];

  constructor(width, height) {
    this.width = width, this.height = height;
  }

  save() { this.#kept.push([this.#transform, this.globalAlpha]); }
  restore() { [this.#transform, this.globalAlpha] = this.#kept.pop(); }
  translate(x, y) { this.#transform += `translate(${brief(x)} ${brief(y)})`; }
  rotate(turn) { this.#transform += `rotate(${brief((turn * 180) / Math.PI)})`; }
  setLineDash(dash) { this.#dash = dash; }
  beginPath() { this.#path = ''; }
  closePath() { this.#path += 'Z'; }
  moveTo(x, y) { this.#path += `M${brief(x)} ${brief(y)}`; }
  /// The first point starts the path, as on a canvas.
  lineTo(x, y) { this.#path += `${this.#path === '' ? 'M' : 'L'}${brief(x)} ${brief(y)}`; }
  arc(x, y, radius) { this.ellipse(x, y, radius, radius, 0); }

  /// Only full ellipses, because maps have no others.
  ellipse(x, y, long, across, turn) {
    const cos = long * Math.cos(turn), sin = long * Math.sin(turn), degrees = (turn * 180) / Math.PI;
    const half = (px, py) => `A${brief(long)} ${brief(across)} ${brief(degrees)} 0 1 ${brief(px)} ${brief(py)}`;
    this.#path += `M${brief(x + cos)} ${brief(y + sin)}${half(x - cos, y - sin)}${half(x + cos, y + sin)}Z`;
  }

  fill() { this.#add('path', `d="${this.#path}" fill="${escaped(this.fillStyle)}"`); }

  stroke() {
    const dash = this.#dash.length > 0 ? ` stroke-dasharray="${this.#dash.join(' ')}" stroke-dashoffset="${brief(this.lineDashOffset)}"` : '';
    this.#add('path', `d="${this.#path}" fill="none" stroke="${escaped(this.strokeStyle)}" stroke-width="${this.lineWidth}" stroke-linejoin="${this.lineJoin}"${dash}`);
  }

  fillRect(x, y, width, height) {
    this.#add('rect', `x="${brief(x)}" y="${brief(y)}" width="${brief(width)}" height="${brief(height)}" fill="${escaped(this.fillStyle)}"`);
  }

  fillText(text, x, y) {
    const anchor = { left: 'start', center: 'middle', right: 'end' }[this.textAlign] ?? 'start';
    this.#add('text', `x="${brief(x)}" y="${brief(y)}" fill="${escaped(this.fillStyle)}" text-anchor="${anchor}" font-size="11" font-family="sans-serif"`, escaped(text));
  }

  measureText(text) { return { width: 6 * text.length }; }

  #add(tag, attributes, text = '') {
    if (attributes.startsWith('d=""')) return;
    const alpha = this.globalAlpha < 1 ? ` opacity="${this.globalAlpha}"` : '',
      transform = this.#transform ? ` transform="${this.#transform}"` : '';
    this.#parts.push(`<${tag} ${attributes}${alpha}${transform}${text === '' ? '/>' : `>${text}</${tag}>`}`);
  }

  text(background) {
    return `<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 ${this.width} ${this.height}" width="${this.width}" height="${this.height}">\n` +
      `<rect width="100%" height="100%" fill="${escaped(background)}"/>\n${this.#parts.join('\n')}\n</svg>\n`;
  }
}
