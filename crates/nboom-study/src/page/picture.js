// Pictures with axes.

/** Round numbers between two others. */
function ticks(low, high, count) {
  const raw = (high - low) / count;
  const power = 10 ** Math.floor(Math.log10(raw));
  const step = power * [1, 2, 5, 10].find((factor) => factor * power >= raw * 0.999);
  const first = Math.ceil(low / step - 1e-9);
  const last = Math.floor(high / step + 1e-9);
  return Array.from({ length: Math.max(0, Math.min(50, last - first + 1)) }, (_, i) => Number(((first + i) * step).toPrecision(12)));
}

/** The ends of a range with some room, so that a single number has a range too. */
function roomy([low, high], share = 0.03) {
  const size = high - low;
  const room = size > 1e-12 * Math.max(Math.abs(low), Math.abs(high)) ? share * size : 0.1 * Math.abs(high) || 1;
  return [low - room, high + room];
}

/** A picture with axes: places of numbers on it, and what is to be added to. */
function frame({ width = 460, height = 190, x, y, left = 50, right = 10, top = 10, xLabel, yLabel, xText = digits, yText = digits, about }) {
  const bottom = height - (xLabel ? 42 : 24);
  const X = (value) => left + ((value - x[0]) / (x[1] - x[0])) * (width - left - right);
  const Y = (value) => bottom - ((value - y[0]) / (y[1] - y[0])) * (bottom - top);
  const across = ticks(...x, Math.max(2, Math.floor((width - left) / 65))).map((at) => [
    drawn('line', { class: 'grid', x1: X(at), x2: X(at), y1: top, y2: bottom }),
    drawn('text', { x: X(at), y: bottom + 16, 'text-anchor': 'middle' }, xText(at))]);
  const up = yText === null ? [] : ticks(...y, Math.max(2, Math.floor(height / 60))).map((at) => [
    drawn('line', { class: 'grid', x1: left, x2: width - right, y1: Y(at), y2: Y(at) }),
    drawn('text', { x: left - 6, y: Y(at) + 4, 'text-anchor': 'end' }, yText(at))]);
  const svg = drawn('svg', { viewBox: `0 0 ${width} ${height}`, role: 'img', 'aria-label': about }, across.flat(), up.flat(),
    drawn('line', { class: 'axis', x1: left, x2: width - right, y1: bottom, y2: bottom }),
    xLabel ? drawn('text', { x: width - right, y: height - 6, 'text-anchor': 'end' }, xLabel) : null,
    yLabel ? drawn('text', { x: 0, y: 12 }, yLabel) : null);
  return { svg, X, Y, top, bottom };
}
