// Curves over time: one figure, its legend, its data.

import uPlot from 'uplot';
import { alone } from './gaps.js';
import { csv, save } from './save.js';
import { digits, element, moment, note as noted, order, stepped } from './text.js';

/** Curves beyond these have no legend of their own; the nearest one is named. */
const LEGEND = 12;

const HEIGHT = 250;

const HUES = {
  light: ['#2563b0', '#c2410c', '#0f766e', '#a21caf', '#a16207', '#4d7c0f', '#be123c', '#475569'],
  dark: ['#6ea8fe', '#fb9a6b', '#4fd1c5', '#e58fed', '#e3b341', '#a3d05a', '#ff8fa3', '#a8b3c4'],
};

function hue(i, count, dark) {
  const hues = HUES[dark ? 'dark' : 'light'];
  if (count <= hues.length) return hues[i];
  // From the first to the last in one sweep, so that neighbours look alike.
  return `hsl(${215 - (255 * i) / (count - 1)} 60% ${dark ? 66 : 40}%)`;
}

/** Times of rows at both sides of an instant, a hair apart, so that a curve jumps there. */
function apart(times) {
  const hair = 1e-9 * (times[times.length - 1] - times[0]);
  return Array.from(times, (t, i) => (times[i + 1] === t ? t - hair : t));
}

/** All series over one axis of time. */
function joined(series) {
  const own = new Map();
  const tables = series.map(({ x, y }) => {
    if (!own.has(x)) own.set(x, apart(x));
    return [own.get(x), Array.from(y)];
  });
  const same = series.every(({ x }) => x === series[0].x);
  return same ? [tables[0][0], ...tables.map(([, y]) => y)] : uPlot.join(tables);
}

/**
 * A figure. `series` have a `label`, times `x`, values `y`, perhaps `points` for marks without a line and
 * `dash`; `events` are times that are marked; what is below `least` everywhere is rounding.
 */
export class Figure {
  constructor({ title, unit, series, log, least = 0, events, timeUnit, note, go }) {
    Object.assign(this, { title, unit, series, log, least, events, timeUnit, go });
    const said = [note, series.length > LEGEND ? 'Point at a curve to see whose it is.' : ''].filter(Boolean).join(' ');
    this.place = element('div', { class: 'plot' });
    this.nearest = element('output', { class: 'nearest' });
    this.element = element('figure', { class: 'curve', 'data-title': title },
      element('figcaption', {},
        element('h3', {}, unit ? `${title} [${unit}]` : title), this.nearest,
        element('button', { type: 'button', class: 'save', title: 'Save the data of these curves as CSV', click: () => this.save() }, 'Save data')),
      this.place, said ? noted(said) : null);
  }

  draw({ dark, ink, line, now: nowColour }) {
    this.plot?.destroy();
    const data = joined(this.series);
    const [times] = data;
    const [first, last] = [times[0], times[times.length - 1]];
    const many = this.series.length > LEGEND;
    const count = this.series.filter(({ points }) => !points).length;
    let drawn = 0;
    const of = ({ label, points, dash, of: same }) => {
      const i = same ?? drawn++;
      const stroke = hue(i, count, dark);
      return {
        // Where a value has no logarithm the line ends; one by itself is a dot.
        label, stroke, width: many ? 1.1 : 1.6, spanGaps: !this.log, dash, value: (_, y) => this.written(y),
        ...(points
          ? { class: 'mark-series', width: 0, paths: () => null, points: { show: true, size: 7, fill: stroke, stroke } }
          : { points: { show: times.length < 3, filter: (plot, k, show) => (this.log && !show ? alone(plot.data[k]) : null) } }),
      };
    };
    const axis = { stroke: ink, grid: { stroke: line, width: 1 }, ticks: { stroke: line, width: 1 }, font: '12px system-ui, sans-serif', labelFont: '12px system-ui, sans-serif' };
    this.plot = new uPlot({
      width: Math.max(this.place.clientWidth, 200), height: HEIGHT,
      cursor: { sync: { key: 'time' }, focus: { prox: 24 }, drag: { x: true, y: false }, points: { size: 6 } },
      focus: { alpha: many ? 0.25 : 1 },
      legend: { show: !many, live: true },
      // A run of no length has its moment in the middle.
      scales: { x: { time: false, ...(first === last ? { range: () => range(first, last, 0) } : {}) }, y: this.log ? { distr: 3 } : { range: (_, low, high) => range(low, high, this.least) } },
      axes: [
        { ...axis, label: `Time [${this.timeUnit}]`, labelSize: 18, size: 34 },
        { ...axis, size: widthOf, ...(this.log ? { splits: decades } : {}), values: (_, ticks, __, ___, step) => ticks.map((tick) => (tick === null ? '' : this.log ? order10(tick) : stepped(tick, step))) },
      ],
      series: [{ label: `t [${this.timeUnit}]`, value: (_, x) => (x === null ? '' : moment(x, last - first, 5)) }, ...this.series.map(of)],
      hooks: {
        drawClear: [(plot) => this.markEvents(plot, line)],
        setSeries: [(_, i, { show }) => (show === undefined ? many && this.name(i) : this.showMarks(i, show))],
      },
    }, data, this.place);
    this.needle = element('div', { class: 'needle' });
    this.needle.style.background = nowColour;
    this.plot.over.append(this.needle);
    this.plot.over.addEventListener('dblclick', ({ offsetX }) => this.go?.(this.plot.posToVal(offsetX, 'x')));
    if (this.time !== undefined) this.at(this.time);
  }

  /** Marks come and go with their curve. */
  showMarks(i, show) {
    const curves = this.series.filter(({ points }) => !points);
    const number = curves.indexOf(this.series[i - 1]);
    this.series.forEach(({ of: same }, k) => {
      if (number >= 0 && same === number && this.plot.series[k + 1].show !== show) this.plot.setSeries(k + 1, { show });
    });
  }

  written(y) {
    if (y === null || y === undefined) return '';
    return this.log ? order(y) : digits(y, 5);
  }

  name(i) {
    const series = i ? this.series[i - 1] : null;
    this.nearest.replaceChildren(series ? element('bdi', {}, series.label) : '');
  }

  markEvents({ ctx, bbox, valToPos }, colour) {
    ctx.save();
    ctx.strokeStyle = colour;
    ctx.setLineDash([3 * devicePixelRatio, 3 * devicePixelRatio]);
    ctx.lineWidth = devicePixelRatio;
    for (const time of this.events ?? []) {
      const x = Math.round(valToPos.call(this.plot, time, 'x', true)) + 0.5;
      if (!(x >= bbox.left && x <= bbox.left + bbox.width)) continue;
      ctx.beginPath();
      ctx.moveTo(x, bbox.top);
      ctx.lineTo(x, bbox.top + bbox.height);
      ctx.stroke();
    }
    ctx.restore();
  }

  /** Moves the needle to a time. */
  at(time) {
    this.time = time;
    if (!this.plot) return;
    const x = this.plot.valToPos(time, 'x');
    this.needle.style.transform = `translateX(${x}px)`;
    this.needle.hidden = !(x >= 0 && x <= this.plot.over.clientWidth);
  }

  resize() {
    const width = this.place.clientWidth;
    if (this.plot && width > 0 && width !== this.plot.width) this.plot.setSize({ width, height: HEIGHT });
    if (this.time !== undefined) this.at(this.time);
  }

  save() {
    const same = this.series.every(({ x }) => x === this.series[0].x);
    const [times, ...columns] = same ? [this.series[0].x, ...this.series.map(({ y }) => y)] : joined(this.series);
    const headings = this.series.map(({ label }) => (this.unit ? `${label} [${this.unit}]` : label));
    save(`${this.title}.csv`, csv([`t [${this.timeUnit}]`, ...headings], [times, ...columns]));
  }
}

/** How wide an axis is: as its longest label asks for, and alike where labels are short. */
function widthOf(plot, labels, number) {
  const { font: [font], ticks, gap } = plot.axes[number];
  plot.ctx.font = font;
  const widths = (labels ?? []).map((label) => plot.ctx.measureText(label).width / devicePixelRatio);
  return Math.max(66, Math.ceil(Math.max(0, ...widths) + ticks.size + gap));
}

/** Powers of ten, at most about eight. */
function decades(_, __, low, high) {
  const [from, to] = [Math.ceil(Math.log10(low) - 1e-9), Math.floor(Math.log10(high) + 1e-9)];
  const step = Math.max(1, Math.ceil((to - from) / 8));
  return Array.from({ length: Math.max(0, Math.floor((to - from) / step)) + 1 }, (___, i) => 10 ** (from + i * step));
}

function order10(tick) {
  const power = Math.log10(tick);
  return Math.abs(power - Math.round(power)) < 1e-6 ? order(tick).replace('1\u202f·\u202f', '') : '';
}

/** A little room above and below; a constant stands in the middle, and rounding does not look like motion. */
function range(low, high, least) {
  if (low === null || high === null) return [0, 1];
  if (Math.max(Math.abs(low), Math.abs(high)) < least) return [-least, least];
  const size = Math.max(Math.abs(low), Math.abs(high));
  if (high - low <= 1e-9 * size) return size === 0 ? [-1, 1] : [low - 0.1 * size, high + 0.1 * size];
  return uPlot.rangeNum(low, high, 0.08, true);
}
