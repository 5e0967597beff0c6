// Texts, and the elements of the page. All text goes through `textContent`.

/** Marks that turn the direction of text, and control characters, which could make text read as what it is not. */
const DECEPTIVE = /[\u0000-\u0008\u000b-\u001f\u007f-\u009f\u061c\u200b-\u200f\u2028-\u202e\u2060-\u2069\ufeff]/g;

const visible = (text) => String(text).replace(DECEPTIVE, '\ufffd');

function fill(made, attributes, children) {
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

const element = (name, attributes = {}, ...children) => fill(document.createElement(name), attributes, children);
const drawn = (name, attributes = {}, ...children) => fill(document.createElementNS('http://www.w3.org/2000/svg', name), attributes, children);

/** A name that a file gave, which cannot turn the direction of what is around it. */
const given = (text) => element('bdi', {}, text);

/** A number with so many significant digits, without an exponent where that is short. */
function digits(value, count = 4) {
  if (value === null || value === undefined) return '\u2013';
  const size = Math.abs(value);
  if (size === 0 || (size >= 1e-3 && size < 1e6)) return String(Number(value.toPrecision(count))).replace('-', '\u2212');
  const [mantissa, power] = value.toExponential(count - 1).split('e');
  const raised = [...String(Number(power))].map((c) => '\u207b\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079'['-0123456789'.indexOf(c)]);
  return `${String(Number(mantissa)).replace('-', '\u2212')}\u202f\u00b7\u202f10${raised.join('')}`;
}

/** A number with two decimals; nothing is less than zero by none of them. */
function decimals(value) {
  const text = value.toFixed(2);
  return Number(text) === 0 ? '0.00' : text.replace('-', '\u2212');
}

/** How many significant digits a number has down to a step of this size. */
const digitsTo = (step, value) => Math.floor(Math.log10(Math.abs(value))) - Math.floor(Math.log10(step)) + 1;

/** A number with enough digits to tell it from others that spread so far; those beyond the tenth are errors of runs. */
function among({ deviation }, value, least = 4) {
  const needed = deviation > 0 && Number.isFinite(value) ? Math.min(10, digitsTo(deviation / 100, value)) : 0;
  return digits(value, Math.max(least, needed));
}

/** The same, or the word for a lock-up that does not come. */
const said = (spread, value, least) => (value === null ? 'never' : among(spread, value, least));
const whole = (number) => number.toLocaleString('en');
const casesOf = (count) => `${whole(count)} ${count === 1 ? 'case' : 'cases'}`;
const drawsOf = (count) => `${whole(count)} ${count === 1 ? 'draw' : 'draws'}`;
const percent = (share) => `${digits(100 * share, 3)}\u202f%`;
/** An interval, which has an end only where there are enough cases for it. */
function interval(low, high, told) {
  const end = (value) => (value === undefined ? 'no bound' : told(value));
  if (low === null) return 'never';
  return low === undefined && high === undefined ? 'no bounds' : `${end(low)} to ${end(high)}`;
}
const titled = ({ label, unit }) => [given(label), unit ? element('span', { class: 'unit' }, ` [${unit}]`) : null];

/** A cell with a number. */
const numeric = (text) => ({ number: text });

function table(headings, rows) {
  const cell = (content) => (content?.number === undefined
    ? element('td', { class: typeof content === 'string' ? 'text' : null }, content)
    : element('td', { class: 'number' }, content.number));
  const head = headings.map((heading, i) => element('th', { class: rows[0]?.[i]?.number === undefined ? null : 'number' }, heading));
  return element('div', { class: 'wide' }, element('table', {},
    element('thead', {}, element('tr', {}, head)),
    element('tbody', {}, rows.map((row) => element('tr', {}, row.map(cell))))));
}

function section(id, title, ...content) {
  return element('section', { id }, element('h2', {}, title), ...content);
}

const note = (text) => element('p', { class: 'note' }, text);
