// Pictures with axes.

import { drawn, stepped } from '../text.js';

/** Labels at round numbers between two others: what they say, and where they stand. */
function ticks([low, high], count, text) {
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  const places = Array.from({ length: Math.max(0, Math.min(50, last - first + 1)) }, (_, i) => Number(((first + i) * step).toPrecision(14)));
  return places.map((at) => ({ at, text: text(at, step) }));
}

/** About how wide a text of a picture is. */
const widthOf = (text) => 7 * text.length;

/** Labels along a length, at most about so many, and fewer where they would touch. */
function ticksAlong(length, [low, high], most, text) {
  for (let count = most; ; count -= 1) {
    const found = ticks([low, high], count, text);
    const room = (length / (high - low)) * (found[1]?.at - found[0]?.at);
    if (count === 1 || !found.some((tick) => widthOf(tick.text) + 8 > room)) return found;
  }
}

/** The ends of a range with some room, so that a single number has a range too. */
export function roomy([low, high], share = 0.03) {
  const size = high - low;
  const room = size > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? share * size : 0.1 * Math.abs(high) || 1;
  return [low - room, high + room];
}

/** A picture with axes: places of numbers on it, and what is to be added to. */
export function frame({ width = 460, height = 190, x, y, left: least = 50, right = 10, top = 10, xLabel, yLabel, yText = stepped, about }) {
  const bottom = height - (xLabel ? 42 : 24);
  const rows = yText === null ? [] : ticks(y, Math.max(2, Math.floor(height / 60)), yText);
  const left = Math.max(least, ...rows.map(({ text }) => widthOf(text) + 8));
  const X = (value) => left + ((value - x[0]) / (x[1] - x[0])) * (width - left - right);
  const Y = (value) => bottom - ((value - y[0]) / (y[1] - y[0])) * (bottom - top);
  const across = ticksAlong(width - left - right, x, Math.max(2, Math.floor((width - left) / 65)), stepped).map(({ at, text }) => [
    drawn('line', { class: 'grid', x1: X(at), x2: X(at), y1: top, y2: bottom }),
    drawn('text', { x: X(at), y: bottom + 16, 'text-anchor': 'middle' }, text)]);
  const up = rows.map(({ at, text }) => [
    drawn('line', { class: 'grid', x1: left, x2: width - right, y1: Y(at), y2: Y(at) }),
    drawn('text', { x: left - 6, y: Y(at) + 4, 'text-anchor': 'end' }, text)]);
  const svg = drawn('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': about }, across.flat(), up.flat(),
    drawn('line', { class: 'axis', x1: left, x2: width - right, y1: bottom, y2: bottom }),
    xLabel ? drawn('text', { x: width - right, y: height - 6, 'text-anchor': 'end' }, xLabel) : null,
    yLabel ? drawn('text', { x: 0, y: 12 }, yLabel) : null);
  return { svg, X, Y, top, bottom };
}
