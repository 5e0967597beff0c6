// Elements and numbers of pages. All text goes through `textContent`, so no text of a scene or study becomes markup.

/** What `steers` of nboom-model finds, but tabs and line ends; a test compares. */
const DECEPTIVE = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff\ufffe\uffff]/g;

/** The text with everything visible that would not be. */
export function visible(text) {
  return String(text).replace(DECEPTIVE, '\ufffd');
}

function filled(made, attributes, children) {
  for (const [key, value] of Object.entries(attributes)) {
    if (value === false || value === null || value === undefined) continue;
    if (typeof value === 'function') made.addEventListener(key, value);
    else made.setAttribute(key, value === true ? '' : visible(value));
  }
  for (const child of children.flat()) {
    if (child === null || child === undefined || child === false) continue;
    made.append(child instanceof Node ? child : visible(child));
  }
  return made;
}

/**
 * An element with attributes and children. An attribute that is a function listens to the event of its name;
 * one that is false or null is left out. A child is an element, a text, or nothing.
 */
export function element(name, attributes = {}, ...children) {
  return filled(document.createElement(name), attributes, children);
}

/** The same of a picture in SVG. */
export function drawn(name, attributes = {}, ...children) {
  return filled(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);
}

export function section(id, title, ...content) {
  return element('section', { id }, element('h2', {}, title), ...content);
}

export function note(text) {
  return element('p', { class: 'note' }, text);
}

/** A name that a file gave, which cannot turn the direction of what is around it. */
export function given(text) {
  return element('bdi', {}, text);
}

/** A table; cells that are numbers stand to the right. Of a row that has attributes these are its `attributes`, and its cells `cells`. */
export function table(headings, rows, attributes = {}) {
  const cellsOf = (row) => row.cells ?? row;
  const kind = (content) => (content?.number !== undefined ? 'number' : typeof content === 'string' ? 'text' : null);
  const cell = (content) => element('td', { class: kind(content) }, content?.number ?? content);
  const isNumeric = (column) => rows.length > 0 && kind(cellsOf(rows[0])[column]) === 'number';
  const head = element('tr', {}, headings.map((heading, column) => element('th', { class: isNumeric(column) ? 'number' : null }, heading)));
  const body = rows.map((row) => element('tr', row.attributes ?? {}, cellsOf(row).map(cell)));
  const made = element('table', attributes, element('thead', {}, head), element('tbody', {}, body));
  return element('div', { class: 'wide' }, made);
}

/** A cell with a number, or a dash where there is none. */
export function numeric(text) {
  return { number: text === '' ? '\u2013' : text };
}

/** A number with so many significant digits, without an exponent where that is short. */
export function digits(value, count = 4) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '\u2013';
  if (value === 0) return '0';
  const size = Math.abs(value);
  if (size >= 1e6 || size < 1e-3) return exponential(value, count);
  return minus(Number(value.toPrecision(count)).toString());
}

/** How many significant digits a number has down to a step of this size. */
export function digitsTo(step, value) {
  return Math.floor(Math.log10(Math.abs(value))) - Math.floor(Math.log10(step)) + 1;
}

/** A number with the digits in which it differs from those a step away: of steps of 2.5 they have one more. */
export function stepped(value, step) {
  const [mantissa] = step.toExponential(2).split('e');
  const beyond = String(Number(mantissa)).replace(/^\d\.?/, '').length;
  return digits(value, Math.max(1, Math.min(14, digitsTo(step, value) + beyond)));
}

/** A time with `least` digits, and with more where a ten-thousandth of the run's length asks for them: runs may start late. */
export function moment(time, length, least) {
  const needed = time && length > 0 ? digitsTo(1e-4 * length, time) : 0;
  return needed > least ? minus(Number(time.toPrecision(Math.min(needed, 15))).toString()) : digits(time, least);
}

/** A count, with commas. */
export function whole(count) {
  return count?.toLocaleString('en') ?? '\u2013';
}

/** A small number by its order. */
export function order(value) {
  if (value === null || value === undefined || !Number.isFinite(value)) return '\u2013';
  return value === 0 ? '0' : exponential(value, 2);
}

function exponential(value, count) {
  const [mantissa, power] = value.toExponential(count - 1).split('e');
  const raised = [...String(Number(power))].map((c) => '\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'['-0123456789'.indexOf(c)]);
  const short = String(Number(mantissa));
  return `${minus(short)}\u202f\u00b7\u202f10${raised.join('')}`;
}

/** With a minus sign in place of a hyphen. */
export function minus(text) {
  return text.replace('-', '\u2212');
}
