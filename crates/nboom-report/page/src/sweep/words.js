// What the page of a sweep says of numbers and cases.

import { digits, digitsTo, element, given, minus, whole } from '../text.js';

/** A number with two decimals; nothing is less than zero by none of them. */
export function decimals(value) {
  const text = value.toFixed(2);
  return Number(text) === 0 ? '0.00' : minus(text);
}

/** A number with enough digits to tell it from others that spread so far; those beyond the tenth are errors of runs. */
export function among({ deviation }, value, least = 4) {
  const needed = deviation > 0 && Number.isFinite(value) ? Math.min(10, digitsTo(deviation / 100, value)) : 0;
  return digits(value, Math.max(least, needed));
}

/** The same, or the word for a lock-up that does not come. */
export const said = (spread, value, least) => (value === null ? 'never' : among(spread, value, least));
export const casesOf = (count) => `${whole(count)} ${count === 1 ? 'case' : 'cases'}`;
export const drawsOf = (count) => `${whole(count)} ${count === 1 ? 'draw' : 'draws'}`;
export const percent = (share) => `${digits(100 * share, 3)}\u202f%`;

/** An interval, which has an end only where there are enough cases for it. */
export function interval(low, high, told) {
  const end = (value) => (value === undefined ? 'no bound' : told(value));
  if (low === null) return 'never';
  return low === undefined && high === undefined ? 'no bounds' : `${end(low)} to ${end(high)}`;
}

export const titled = ({ label, unit }) => [given(label), unit ? element('span', { class: 'unit' }, ` [${unit}]`) : null];
