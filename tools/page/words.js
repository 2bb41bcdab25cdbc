// Makes elements and formats numbers. Text is inserted as text, never as markup.

/// Makes an element with attributes (`on...` are listeners; `class`, `data-...`) and children, which may be strings.
export function element(tag, attributes = {}, ...children) {
  const made = document.createElement(tag);
  for (const [name, value] of Object.entries(attributes)) {
    if (name.startsWith('on')) made.addEventListener(name.slice(2), value);
    else if (value !== undefined && value !== false) made.setAttribute(name, value === true ? '' : value);
  }
  made.append(...children.filter((child) => child !== null && child !== undefined));
  return made;
}

/// Formats a number with a typographic minus; a dash for a missing number.
export function number(value, decimals) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  return value.toFixed(decimals).replace('-', '−');
}

/// Formats a number with its significant digits.
export function short(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '–';
  const size = Math.abs(value);
  if (size >= 1e5) return value.toExponential(1).replace('-', '−');
  return number(value, size >= 100 || size === 0 ? 0 : size >= 10 ? 1 : size >= 1 ? 2 : 3);
}

/// Formats a duration, e.g. 12.3 s or 3:05 min.
export function duration(seconds) {
  if (seconds < 100) return `${number(seconds, 1)} s`;
  const whole = Math.round(seconds);
  const two = (part) => String(part).padStart(2, '0');
  const h = Math.floor(whole / 3600), min = Math.floor(whole / 60) % 60;
  return h > 0 ? `${h}:${two(min)}:${two(whole % 60)} h` : `${min}:${two(whole % 60)} min`;
}

export function withUnit(text, unit) {
  return unit === '' ? text : `${text}${unit === '°' ? '' : ' '}${unit}`;
}
