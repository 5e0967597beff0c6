// What became of the run, first of all.

import { digits, element, given, note, numeric, order, table, whole } from './text.js';
import { angleText } from './units.js';

const STATES = { '-1': 'held', 0: 'free', 1: 'locked', 2: 'stuck' };

/** Hinges that are listed before the rest is asked for. */
const MOST = 30;

/** The verdict in a sentence. */
export function sentence(run) {
  const { summary, units } = run;
  const told = summary?.verdict?.hinges;
  if (!told) return 'This run has no verdict.';
  const locked = told.filter(({ state }) => state === 1);
  const free = told.filter(({ state }) => state === 0).length;
  const stuck = told.filter(({ state }) => state === 2).length;
  const held = told.length - locked.length - free - stuck;
  const times = locked.map(({ time }) => time).filter((time) => time !== null);
  const by = times.length > 0 ? ` by ${run.time(Math.max(...times))} ${units.time}` : '';
  const count = (number, what) => `${number} ${number === 1 ? 'joint' : 'joints'} ${what}`;
  if (told.length === 0) return 'A rigid body: no joints.';
  const all = ['', 'The joint', 'Both joints'][told.length] ?? `All ${told.length} joints`;
  if (locked.length === told.length) return `${all} locked${by}.`;
  const parts = [locked.length > 0 && count(locked.length, `locked${by}`), free > 0 && count(free, 'free at the end'),
    stuck > 0 && count(stuck, 'stuck by friction or against a stop'), held > 0 && count(held, 'never released')];
  return `${parts.filter(Boolean).join(', ')}.`;
}

function figure(name, value, unit, where) {
  return element('div', { class: 'key' },
    element('dt', {}, name),
    element('dd', {}, element('span', { class: 'value' }, value), unit ? element('span', { class: 'unit' }, ` ${unit}`) : null,
      where ? element('div', { class: 'where' }, where) : null));
}

function place(at, run) {
  if (!at) return '';
  const hinge = run.hinge(at.appendage, at.segment);
  const station = at.station ? `, station ${at.station}` : '';
  const event = { lock_up: ', by a latch', impact: ', by a stop' }[at.event] ?? '';
  return [given(hinge?.label ?? `${at.appendage},${at.segment}`), `${station}, t = ${run.time(at.time, 4)}${event}`];
}

/** The smallest margin to each limit that is known. */
const weakest = (verdict) =>
  ['yield', 'ultimate']
    .map((limit) => ({ limit, margin: verdict[`smallest_${limit}_margin`], at: verdict[`smallest_${limit}_margin_at`] }))
    .filter(({ at }) => at);

/** What loads leave out, if they leave out the pulses of latches and stops. */
export const withoutPulses = ({ summary }) => (summary?.latch_pulses === false ? ', without pulses of latches and stops' : '');

/** Key figures: name, value, unit and where, of one run. */
export function keyFigures(run) {
  const { summary, units } = run;
  const verdict = summary?.verdict;
  if (!verdict) return [];
  const found = [];
  const add = (name, value, unit, where) => value !== null && value !== undefined && found.push({ name, value, unit, where });
  const locks = verdict.hinges.filter(({ state, time }) => state === 1 && time !== null);
  const last = locks.reduce((late, hinge) => (hinge.time > (late?.time ?? -Infinity) ? hinge : late), null);
  if (last) add('Last lock-up', run.time(last.time), units.time, [given(run.hinge(last.appendage, last.segment)?.label ?? '')]);
  if (verdict.largest_impulse) {
    const at = verdict.largest_impulse_at;
    const hinge = run.hinge(at.appendage, at.segment);
    add('Largest impulse', digits(verdict.largest_impulse), hinge?.slides ? units.momentum : units.angular_momentum, place(at, run));
  }
  if (verdict.worst_load) add('Largest stress', digits(verdict.worst_load), units.stress, [place(verdict.worst_load_at, run), withoutPulses(run)].flat());
  for (const { margin, limit, at } of weakest(verdict)) add(`Smallest margin to ${limit}`, digits(margin, 3), '', place(at, run));
  if (verdict.largest_hinge_moment) add('Largest hinge moment', digits(verdict.largest_hinge_moment), units.torque, [place(verdict.largest_hinge_moment_at, run), withoutPulses(run)].flat());
  add(...trust(run));
  return found;
}

/** Digits to trust: certified ones, else what conservation says. */
function trust({ data, summary }) {
  const { certificate } = data;
  if (certificate) {
    const all = [...certificate.events.flatMap(({ time, impulse }) => [time, impulse]), ...certificate.end, ...certificate.peaks].filter(Boolean);
    const fewest = Math.min(...all.map(({ digits: count }) => count));
    return ['Digits to trust', Number.isFinite(fewest) ? String(fewest) : '–', '', [`certified by ${certificate.reference}`]];
  }
  const { linear_momentum: linear, angular_momentum: angular, energy } = summary.conservation ?? {};
  return ['Worst residual', order(Math.max(linear, angular, energy)), '', ['of momentum and energy, relative; not certified']];
}

export function verdictSection(run) {
  const keys = keyFigures(run).map(({ name, value, unit, where }) => figure(name, value, unit, where));
  return element('section', { class: 'verdict', id: 'verdict' },
    element('p', { class: 'sentence' }, sentence(run)),
    problems(run),
    element('dl', { class: 'keys' }, keys),
    run.summary?.judged_by ? note(`Loads and margins are judged by ${run.summary.judged_by}.`) : null,
    hingeList(run),
    warnings(run));
}

/** Gaps, errors, and why the results are not to be trusted or not to be liked. */
function problems({ summary, data }) {
  const said = [...data.gaps, ...(summary?.troubles ?? [])];
  if (summary && !summary.complete) said.unshift(`The run is not complete: ${summary.error ?? 'it was ended'}.`);
  return said.map((text) => element('p', { class: 'problem' }, text));
}

/** Warnings about the scene, and what the page leaves out. */
function warnings({ summary, data }) {
  const said = (summary?.warnings ?? []).filter((text) => !summary.troubles?.includes(text));
  const thinned = data.thinned ? note(data.thinned) : null;
  if (said.length === 0) return thinned;
  return [thinned, element('details', { class: 'warnings' },
    element('summary', {}, `${said.length} ${said.length === 1 ? 'warning' : 'warnings'} about the scene`),
    element('ul', {}, said.map((text) => element('li', {}, text))))];
}

/** What became of each joint. */
function hingeList(run) {
  const told = run.summary?.verdict?.hinges ?? [];
  if (told.length === 0) return null;
  const { units } = run;
  const items = told.map((joint) => {
    const { appendage, segment, state, time, angle } = joint;
    const hinge = run.hinge(appendage, segment);
    const amount = (of) => (hinge?.slides ? `${digits(of)} ${units.length}` : angleText(of));
    const since = time === null ? '' : state === 1 ? `at ${run.time(time, 6)} ${units.time}` : `since ${run.time(time, 6)} ${units.time}`;
    return element('li', {}, given(hinge?.label ?? ''), element('span', { class: `state state-${STATES[state]}` }, `${STATES[state] ?? state} ${since}`),
      element('span', { class: 'position' }, amount(angle)), latch(joint, amount, run));
  });
  const list = element('ul', { class: 'hinges' }, items);
  return items.length > MOST ? element('details', {}, element('summary', {}, `All ${items.length} joints`), list) : list;
}

/** How fast a latch closed, or how near a free joint came to it; nothing in runs of older versions. */
function latch({ closing_rate: rate, miss, miss_time: time }, amount, run) {
  const { units } = run;
  const told = Number.isFinite(rate) ? `its latch closed at ${amount(rate)}/${units.time}`
    : Number.isFinite(miss) ? `nearest to its latch at ${run.time(time, 6)} ${units.time}: ${amount(miss)} away` : null;
  return told && element('span', { class: 'latch' }, told);
}

/** Runs side by side: each key figure in a row. */
export function comparison(runs) {
  const found = runs.map((run) => [
    { name: 'Verdict', value: sentence(run) }, ...keyFigures(run),
    ...(run.summary?.verdict?.hinges ?? []).filter(({ time }) => time !== null).map(({ appendage, segment, time, state }) => ({
      name: `${run.hinge(appendage, segment)?.label}: ${{ locked: 'locks', stuck: 'stuck since' }[STATES[state]] ?? 'free since'}`, value: run.time(time, 6), unit: run.units.time })),
    { name: 'Judged by', value: run.summary?.judged_by }, { name: 'Formulation', value: run.summary?.formulation }, { name: 'Integrator', value: run.summary?.integrator },
    { name: 'Evaluations', value: run.summary && whole(run.summary.evaluations) },
  ]);
  const names = [...new Set(found.flat().map(({ name }) => name))];
  const rows = names.map((name) => [name, ...found.map((figures) => {
    const one = figures.find((candidate) => candidate.name === name);
    return (one?.value ?? null) === null ? numeric('') : [String(one.value), one.unit ? `\u00a0${one.unit}` : ''].join('');
  })]);
  return element('section', { class: 'verdict', id: 'verdict' },
    runs.flatMap((run) => problems(run).map((said) => element('div', {}, element('b', {}, given(run.name)), said))),
    table(['', ...runs.map((run) => run.name)], rows, { class: 'comparison' }));
}
