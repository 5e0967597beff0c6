// The page of a sweep: sections in the order in which people ask.

import { digits, drawn, element, given, note, numeric, section, table, visible, whole } from '../text.js';
import { switchTheme, themeButton } from '../theme.js';
import { frame, roomy } from './picture.js';
import { among, casesOf, decimals, drawsOf, interval, percent, said, titled } from './words.js';

const { facts, summary } = JSON.parse(document.getElementById('data').textContent);
const { counts, columns, points } = summary;
const results = columns.filter((column) => column.is_result);
const groups = ['no fault', ...summary.faults];
/** The column of what is required. */
const columnOf = ({ result }) => results.find(({ label }) => label === result);

// What is of cases without fault says so where there are others.
const bare = summary.faults.length > 0 ? ' without fault' : '';
// What only draws have: points of a grid are chosen, and have no intervals.
const isDrawn = facts.method !== 'grid';
const ofDraws = (...found) => (isDrawn ? found : []);
const METHODS = { monte_carlo: 'Monte Carlo', latin_hypercube: 'Latin hypercube', sobol: 'Sobol sequence', grid: 'grid' };

function histogram(column) {
  const { histogram: found, is_constant: isConstant, spreads: [spread] } = column;
  if (!found) return note(spread.cases > 0 ? `No case${bare} has this number.` : `No case${bare} ran.`);
  const { from, to, counts: high } = found;
  const step = (to - from) / high.length;
  // Errors of runs fill no picture.
  const x = roomy([from, isConstant ? from : to]);
  const { svg, X, Y, top, bottom } = frame({ x, y: [0, Math.max(...high) * 1.08], yText: (count) => (Number.isInteger(count) ? whole(count) : ''), about: `Histogram of ${column.label}` });
  svg.append(...high.map((count, i) => {
    const [left, right] = isConstant ? [X(from) - 6, X(from) + 6] : [X(from + i * step), X(from + (i + 1) * step)];
    return drawn('rect', { class: 'bar', x: left, y: Y(count), width: Math.max(0.5, right - left - 0.6), height: bottom - Y(count) },
      drawn('title', {}, `${among(spread, from + i * step)} to ${among(spread, from + (i + 1) * step)}: ${casesOf(count)}`));
  }));
  const required = summary.requirements.find((one) => columnOf(one) === column);
  for (const [words, bound] of [['at least', required?.at_least], ['at most', required?.at_most]]) {
    if (bound === undefined || bound < x[0] || bound > x[1]) continue;
    svg.append(drawn('line', { class: 'limit', x1: X(bound), x2: X(bound), y1: top, y2: bottom }, drawn('title', {}, `required: ${words} ${digits(bound, 12)}`)));
  }
  for (const { percent: which, value, low, high: upper } of spread.percentiles.filter((one) => [5, 50, 95].includes(one.percent))) {
    if (value === null) continue;
    const [left, right] = [X(low ?? from), X(upper ?? to)];
    svg.append(...ofDraws(drawn('rect', { class: 'band', x: left, y: top, width: Math.max(0, right - left), height: bottom - top })),
      drawn('line', { class: 'mark', x1: X(value), x2: X(value), y1: top, y2: bottom, 'stroke-dasharray': which === 50 ? null : '4 3' },
        drawn('title', {}, `${which} %: ${among(spread, value)}`)));
  }
  return svg;
}

// A latch that does not close is later than all others.
const isLockTime = (column) => column.meaning.lock_time !== undefined;

function spreadFigure(column) {
  const [spread] = column.spreads;
  const told = (value) => said(spread, value);
  const gaps = spread.cases - spread.count;
  return element('figure', { 'data-column': columns.indexOf(column) }, element('h3', {}, titled(column)), column.is_result ? null : note(column.description), histogram(column),
    spread.count > 0 && note([`Mean ${among(spread, spread.mean)}, deviation ${digits(spread.deviation)}, ${column.is_result ? casesOf(spread.count) : drawsOf(spread.count)}`, gaps > 0 ? `; ${whole(gaps)} without such a number${isLockTime(column) ? ', which count as never' : ''}.` : '.'].join('')),
    spread.percentiles.length > 0
      ? table(['Percentile', 'Value', ...ofDraws('95 % confidence')], spread.percentiles.map(({ percent: which, value, low, high }) => [numeric(`${which} %`), numeric(told(value)), ...ofDraws(numeric(interval(low, high, told)))]))
      : null);
}

// What the sweep was, and what became of it.

function header() {
  const about = [`nboom ${facts.version}`, METHODS[facts.method] ?? facts.method, `seed ${facts.seed}`];
  return element('header', {},
    element('div', {}, element('h1', {}, given(facts.name)), element('p', { class: 'about' }, `${about.join(' \u00b7 ')} \u00b7 scene `, given(facts.scene))),
    element('div', { class: 'tools' }, themeButton()));
}

function account() {
  const { cases, ok, rejected, failed, runaway, first_runaway: firstRunaway, poor, first_poor: firstPoor, doubtful, first_doubtful: firstDoubtful } = counts;
  const said = ok === cases ? `${cases === 1 ? 'The only case' : `All ${whole(cases)} cases`} ran.` : `${whole(ok)} of ${whole(cases)} cases ran; ${whole(rejected)} were rejected, ${whole(failed)} failed.`;
  const keys = [['Draws', facts.draws], ['Faults', summary.faults.length], ['Ran', ok], ['Rejected', rejected], ['Failed', failed]];
  return element('section', { id: 'account' }, element('p', { class: 'sentence' }, said),
    element('dl', { class: 'keys' }, keys.map(([name, number]) => element('div', { class: 'key' }, element('dt', {}, name), element('dd', {}, whole(number))))),
    summary.share > 1 ? note(`Counts, means, deviations and extreme cases are of all cases. Percentiles, histograms, drivers and curves are of ${whole(summary.held)} cases: those of a random one of ${whole(summary.share)} draws.`) : null,
    runaway > 0 ? element('p', { class: 'warning' }, `In ${whole(runaway)} of the cases that ran the motion runs away, the first is `, caseButton(firstRunaway), '.') : null,
    poor > 0 ? element('p', { class: 'warning' }, `${whole(poor)} of the cases that ran ${poor === 1 ? 'has' : 'have'} poor conservation, the first is `, caseButton(firstPoor), '. Do not trust their motion.') : null,
    doubtful > 0 ? element('p', { class: 'warning' }, `In ${whole(doubtful)} of the cases that ran errors of the run may decide whether a hinge locks, the first is `, caseButton(firstDoubtful), '.') : null,
    facts.method === 'grid' ? element('p', { class: 'warning' }, 'Points of a grid are chosen, not drawn. Percentiles and shares describe the grid, not how likely anything is.') : null,
    ['latin_hypercube', 'sobol'].includes(facts.method) ? note('These draws are more even than independent ones, for which the intervals are; as a rule they are wider than need be.') : null);
}

function spreadSection(id, title, of, shown) {
  return shown.length > 0 && section(id, title,
    note(`Lines are the percentiles 5, 50 and 95${ofDraws(', bands their intervals')}. ${of}`),
    element('div', { class: 'figures' }, shown.map(spreadFigure)));
}

function driverFigure(column) {
  const found = column.drivers.filter(({ coefficient, bound }, i) => i < 3 || (i < 12 && Math.abs(coefficient) > bound));
  const bar = ({ coefficient, bound }) => drawn('svg', { viewBox: '0 0 160 16', style: 'width: 160px', 'aria-hidden': 'true' },
    ...ofDraws(drawn('rect', { class: 'bound', x: 80 - 78 * bound, y: 0, width: 156 * bound, height: 16 })),
    drawn('rect', { class: `bar${coefficient < 0 ? ' negative' : ''}`, x: 80 + 78 * Math.min(0, coefficient), y: 3, width: 78 * Math.abs(coefficient), height: 10 }),
    drawn('line', { class: 'axis', x1: 80, x2: 80, y1: 0, y2: 16 }));
  const rows = found.map((driver) => {
    const isWeak = isDrawn && Math.abs(driver.coefficient) <= driver.bound;
    return [element('span', { class: isWeak ? 'name weak' : 'name' }, given(columns[driver.variable].label)), bar(driver), numeric(decimals(driver.coefficient))];
  });
  const others = column.drivers.length - found.length;
  const [spread] = column.spreads;
  const leavesOut = spread.count < spread.cases && !isLockTime(column);
  return element('figure', { class: 'drivers' }, element('h3', {}, titled(column)),
    rows.length > 0 ? table(['Variable', 'Rank correlation', ''], rows) : note('It is the same in all cases, or there are too few.'),
    others > 0 ? note(`${others} more ${others === 1 ? 'is' : 'are'} weaker.`) : null,
    leavesOut ? note(`Of the ${casesOf(spread.count)} that have such a number.`) : null);
}

function drivers() {
  return results.some((column) => column.drivers.length > 0) && section('drivers', 'What drives what',
    note(`Spearman\u2019s rank correlation: 1 where a result always grows with the variable, \u22121 where it always falls.${ofDraws(' Within the grey band it may be chance (95 % for all variables together).')}${bare ? ` Of cases${bare}.` : ''}`),
    facts.vary_together.length > 0 ? note(`${facts.vary_together.map(visible).join(', ')} vary together: each may seem to drive what another does.`) : null,
    element('div', { class: 'figures' }, results.map(driverFigure)));
}

// Points that are chosen.

let chosen = null;

function scatter() {
  if (points.cases.length === 0 || columns.length < 2) return null;
  const first = columns.findIndex((column) => column.is_result && column.drivers.length > 0);
  const shown = { y: Math.max(0, first), x: first < 0 ? 1 : columns[first].drivers[0].variable, group: -1 };
  const place = element('div', { class: 'scatter' });
  const nearest = element('output', { class: 'nearest' });
  const told = note('');
  const choice = (key, label, options) => element('label', {}, label, element('select', { id: `scatter-${key}`, change: ({ target }) => { shown[key] = Number(target.value); draw(); } },
    options.map(([value, text]) => element('option', { value, selected: value === shown[key] }, text))));
  const all = columns.map(({ label }, i) => [i, label]);
  let places = [];
  function draw() {
    const [x, y] = [points.values[shown.x], points.values[shown.y]];
    const rows = points.cases.map((_, i) => i).filter((i) => x[i] !== null && y[i] !== null && (shown.group < 0 || points.faults[i] === shown.group));
    const ends = (values) => rows.reduce(([low, high], i) => [Math.min(low, values[i]), Math.max(high, values[i])], [Infinity, -Infinity]);
    nearest.textContent = '';
    told.textContent = [`${whole(rows.length)} of ${whole(counts.ok)} cases that ran`, summary.faults.length > 0 ? ', those with a fault in orange' : '', '. A click chooses a case.'].join('');
    if (rows.length === 0) { places = []; place.replaceChildren(note('No case has both numbers.')); return; }
    const named = ({ label, unit }) => (unit ? `${label} [${unit}]` : label);
    const width = Math.max(300, Math.min(860, document.documentElement.clientWidth - 30));
    const { svg, X, Y } = frame({ width, height: Math.round(Math.min(460, width * 0.75)), x: roomy(ends(x)), y: roomy(ends(y)), left: 64, top: 24, xLabel: named(columns[shown.x]), yLabel: named(columns[shown.y]), about: `${columns[shown.y].label} over ${columns[shown.x].label}` });
    places = rows.map((i) => ({ i, x: X(x[i]), y: Y(y[i]) }));
    for (const spot of places) {
      spot.circle = drawn('circle', { class: `point${points.faults[spot.i] > 0 ? ' broken' : ''}`, cx: spot.x.toFixed(1), cy: spot.y.toFixed(1), r: 2.6 });
      svg.append(spot.circle);
    }
    const at = ({ clientX, clientY }) => {
      const box = svg.getBoundingClientRect();
      const [px, py] = [((clientX - box.left) * width) / box.width, ((clientY - box.top) * width) / box.width];
      const distance = (spot) => Math.hypot(spot.x - px, spot.y - py);
      return places.reduce((best, spot) => (distance(spot) < distance(best) ? spot : best));
    };
    svg.addEventListener('pointermove', (event) => tell(at(event).i));
    svg.addEventListener('click', (event) => pick(points.cases[at(event).i]));
    place.replaceChildren(svg);
    mark();
  }
  function tell(i) {
    const fault = points.faults[i] > 0 ? `, ${groups[points.faults[i]]}` : '';
    nearest.textContent = visible(`case ${points.cases[i]}${fault}: ${[shown.x, shown.y].map((column) => `${columns[column].label} = ${among(columns[column].spreads[points.faults[i]], points.values[column][i], 5)}`).join(', ')}`);
  }
  function mark() {
    for (const { i, circle } of places) circle.classList.toggle('chosen', points.cases[i] === chosen);
  }
  document.addEventListener('chosen', mark);
  addEventListener('resize', draw);
  draw();
  return section('scatter', 'One against another',
    element('div', { class: 'choices' }, choice('x', 'Across', all), choice('y', 'Up', all),
      summary.faults.length > 0 ? choice('group', 'Cases', [[-1, 'all'], ...groups.map((name, i) => [i, name])]) : null),
    place, nearest, told);
}

// Latches and faults.

function latchFigure({ hinge, unit, times, by_end: [end] }) {
  if (times.length === 0) return element('figure', {}, element('h3', {}, given(hinge)), note(end.of === 0 ? `No case${bare} ran.` : `It latches in none of ${casesOf(end.of)}${bare}.`));
  const x = roomy([times[0].time, times.at(-1).time], 0.06);
  const { svg, X, Y } = frame({ x, y: [0, 1], height: 170, yText: (share) => `${Math.round(100 * share)} %`, about: `Share of cases in which ${hinge} has latched, over time`, xLabel: unit ? `t [${unit}]` : 't' });
  const steps = (value) => {
    // Cases that are not told one by one are taken to be even between two times.
    const corners = [[x[0], 0]];
    let last = { count: 0 };
    for (const at of times) {
      const before = at.before === last.count ? corners.at(-1)[1] : Math.max(corners.at(-1)[1], value(at) - (at.count - at.before) / at.of);
      corners.push([at.time, before], [at.time, value(at)]);
      last = at;
    }
    return [...corners, [x[1], corners.at(-1)[1]]].map(([time, share]) => `${X(time).toFixed(1)},${Y(share).toFixed(1)}`);
  };
  svg.append(...ofDraws(drawn('polygon', { class: 'band', points: [...steps(({ low }) => low), ...steps(({ high }) => high).reverse()].join(' ') })),
    drawn('polyline', { class: 'curve', points: steps(({ count, of }) => count / of).join(' ') }));
  return element('figure', {}, element('h3', {}, given(hinge)), svg, note(`${percent(end.count / end.of)}${ofDraws(` (${interval(end.low, end.high, percent)})`)}, ${whole(end.count)} of ${casesOf(end.of)}${bare}, by the end.`));
}

/** The cells of a share of cases, and what stands above them. */
const shareHeadings = (met) => [met, 'Share', ...ofDraws('95 % confidence')];
const shareCells = ({ count, of, low, high }) => [`${whole(count)} of ${whole(of)}`, percent(count / of), ...ofDraws(interval(low, high, percent))]
  .map((text) => numeric(of > 0 ? text : '\u2013'));
const wilson = `${ofDraws(', with Wilson\u2019s interval of 95 % confidence')}`;

function latches() {
  const rows = summary.latches.flatMap(({ hinge, by_end: ends }) => ends.map((end, i) => [given(hinge), given(groups[i]), ...shareCells(end)]));
  return summary.latches.length > 0 && section('latches', 'Latched by a time',
    note(`The share of cases that ran in which a hinge has latched${wilson}.${bare ? ` Curves are of cases${bare}.` : ''}`),
    element('div', { class: 'figures' }, summary.latches.map(latchFigure)),
    summary.faults.length > 0 ? table(['Hinge', 'Fault', ...shareHeadings('Latched')], rows) : null);
}

function requirements() {
  const bounds = ({ at_least: least, at_most: most }) => [least === undefined ? null : `at least ${digits(least, 12)}`, most === undefined ? null : `at most ${digits(most, 12)}`].filter(Boolean).join(' and ');
  const row = (what, i, met, first) => [what, given(groups[i]), ...shareCells(met), first];
  const rows = summary.requirements.flatMap((one) => one.met.map((met, i) => row([...titled(columnOf(one)), ` ${bounds(one)}`], i, met, one.first_broken[i] ? caseButton(one.first_broken[i]) : '')));
  const all = summary.requirements.length > 1 ? summary.meet_all.map((met, i) => row('all of them', i, met, '')) : [];
  return rows.length > 0 && section('requirements', 'Requirements',
    note(`The share of cases that ran which meet a requirement${wilson}. A case without the number does not meet it.`),
    table(['Requirement', 'Fault', ...shareHeadings('Met'), 'First that breaks it'], [...rows, ...all]));
}

/** The percentiles of a box: the five of its picture, which are null where a lock-up is never. */
const boxOf = ({ percentiles }) => [5, 25, 50, 75, 95].flatMap((which) => percentiles.filter(({ percent: one }) => one === which).map(({ value }) => value));

function boxes(column, rows) {
  const numbers = rows.flat().filter((value) => value !== null);
  if (numbers.length === 0) return null;
  const isNever = rows.some((values) => values.includes(null));
  const x = roomy([Math.min(...numbers), Math.max(...numbers)]);
  const height = 30 * rows.length + 34;
  const { svg, X, top } = frame({ x, y: [0, 1], height, left: 8, right: isNever ? 56 : 10, yText: null, about: `${column.label} by fault` });
  rows.forEach((values, i) => {
    const y = top + 30 * i + 14;
    const whisker = (kind, x1, x2) => drawn('line', { class: kind, x1, x2, y1: y, y2: y });
    const there = values.filter((value) => value !== null);
    // The last of them that is a number: what comes after it is never.
    const last = there.length > 0 ? X(there.at(-1)) : X(x[0]);
    if (there.length < values.length) svg.append(whisker('whisker never', last, X(x[1]) + 12), drawn('text', { class: 'never', x: 456, y: y + 4, 'text-anchor': 'end' }, 'never'));
    if (there.length > 0) svg.append(whisker('whisker', X(there[0]), last));
    if (there.length > 1) svg.append(drawn('rect', { class: `box${i > 0 ? ' broken' : ''}`, x: X(there[1]), y: y - 8, width: Math.max(1, X(there[Math.min(3, there.length - 1)]) - X(there[1])), height: 16 }));
    const spread = column.spreads[i];
    if (there.length > 2) svg.append(drawn('line', { class: 'median', x1: X(there[2]), x2: X(there[2]), y1: y - 10, y2: y + 10 }, drawn('title', {}, `${groups[i]}: median ${said(spread, there[2])} of ${whole(spread.count)} cases`)));
  });
  return svg;
}

function boxFigure(column) {
  const found = column.spreads.map(boxOf);
  if (found.every((values) => values.length === 0)) return null;
  const median = (i) => found[i][2];
  const rows = column.spreads.map((spread, i) => {
    const difference = i > 0 && [median(i), median(0)].every(Number.isFinite) ? median(i) - median(0) : null;
    return [given(groups[i]), numeric(said(spread, median(i))), numeric(i > 0 ? digits(difference, 3) : ''), numeric(`${whole(spread.count)} of ${whole(spread.cases)}`)];
  });
  return element('figure', { 'data-boxes': columns.indexOf(column) }, element('h3', {}, titled(column)), boxes(column, found), table(['From top to bottom', 'Median', 'Difference', 'Cases'], rows));
}

function faults() {
  const figures = summary.faults.length > 0 ? results.map(boxFigure).filter(Boolean) : [];
  const isNever = results.some(({ spreads }) => spreads.some((spread) => boxOf(spread).includes(null)));
  return figures.length > 0 && section('faults', 'Faults side by side',
    note(`Boxes are the percentiles 25, 50 and 75, lines reach from 5 to 95. The difference is that of the medians.${isNever ? ' A dashed line leads on from the last of these that is a time to those that are never.' : ''}`),
    element('div', { class: 'figures' }, figures));
}

// One case.

const caseButton = (number) => element('button', { type: 'button', class: 'case', title: 'Choose this case', click: () => pick(number) }, `case ${number}`);
const reportOf = (number) => facts.reports.includes(number) && `worst/case-${number}/report.html`;

function worst() {
  const end = (column, found) => found.map(({ case: number, fault, value }) => element('div', {}, `${said(column.spreads[fault], value, 5)} `, caseButton(number), reportOf(number) ? [' ', element('a', { href: reportOf(number) }, 'page')] : null, fault > 0 ? [' ', given(groups[fault])] : null));
  return results.length > 0 && section('worst', 'Extreme cases', note('Of all cases that ran, with and without fault.'),
    table(['Result', 'Smallest', 'Largest'], results.map((column) => [element('span', {}, titled(column)), element('div', {}, end(column, column.smallest)), element('div', {}, end(column, column.largest))])));
}

function troubles() {
  const found = summary.troubles;
  const all = counts.rejected + counts.failed;
  return found.length > 0 && section('troubles', 'Cases that did not run',
    note(`${whole(counts.rejected)} were rejected, ${whole(counts.failed)} failed.${found.length < all ? ` These are the first ${found.length}.` : ''}`),
    element('div', { class: 'long', tabindex: 0, role: 'region', 'aria-label': 'Cases that did not run' }, table(['Case', 'Fault', 'Why'], found.map(({ case: number, fault, status }) => [caseButton(number), given(fault > 0 ? groups[fault] : '\u2013'), status]))));
}

/** A word of a shell. */
const quoted = (word) => (/^[\w./+-][\w./+-]*$/.test(word) && !word.startsWith('-') ? word : `'${visible(word).replaceAll("'", "'\\''")}'`);

const command = {
  number: element('input', { type: 'number', min: 1, max: counts.cases, step: 1, 'aria-label': 'Case', change: ({ target }) => target.checkValidity() && target.value && pick(Number(target.value)) }),
  line: element('code', {}),
  report: element('a', {}, 'Its page'),
};

function commandBar() {
  const copy = element('button', { type: 'button', click: () => navigator.clipboard?.writeText(command.line.textContent).then(() => said('Copied'), () => said('Select it')) }, 'Copy');
  const said = (text) => { copy.textContent = text; setTimeout(() => { copy.textContent = 'Copy'; }, 1500); };
  return element('div', { class: 'command', id: 'command' }, element('label', {}, 'Case ', command.number), command.line, command.report, copy);
}

/** Chooses a case. */
function pick(number) {
  chosen = number;
  command.number.value = number;
  command.line.textContent = `nboom run ${quoted(facts.study)} --case ${number}`;
  command.report.hidden = !reportOf(number);
  if (reportOf(number)) command.report.href = reportOf(number);
  document.dispatchEvent(new Event('chosen'));
}

document.body.append(...[header(), account(), requirements(), spreadSection('results', `Results${bare}`, `Of cases that ran${bare}.`, results), drivers(), scatter(), latches(), faults(), worst(), troubles(),
  spreadSection('variables', 'What was drawn', 'Of all draws, whether their cases ran or not.', columns.filter((column) => !column.is_result)), commandBar()].filter(Boolean));
pick(results.find(({ largest }) => largest.length > 0)?.largest[0].case ?? 1);
addEventListener('keydown', ({ key, target, ctrlKey, metaKey, altKey }) => {
  if (key === 't' && !ctrlKey && !metaKey && !altKey && !/INPUT|SELECT/.test(target.tagName)) switchTheme();
});
document.documentElement.dataset.ready = '';
