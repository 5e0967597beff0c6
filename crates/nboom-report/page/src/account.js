// How a run was made, and the scene as it was read.

import { digits, element, note, numeric, order, table, whole } from './text.js';

/** Version, input, formulation, integrator and effort. */
export function account(run) {
  const { summary, units } = run;
  if (!summary) return null;
  const rows = [
    ['Program', `nboom ${summary.version}`],
    ['Scene', summary.scene],
    ['SHA-256 of the input', summary.input_sha256],
    ['Parameters', Object.entries(summary.parameters ?? {}).map(([name, value]) => `${name} = ${value}`).join(', ') || null],
    ['Units', summary.units === 'custom' ? [units.length, units.time, units.force].join(', ') : summary.units],
    ['Code', `${summary.path}, formulation ${summary.formulation}; ${digits(100 * summary.generated_share, 3)} % of evaluations by generated code`],
    ['Integrator', `${summary.integrator}, relative tolerance ${order(summary.rtol)}, absolute ${order(summary.atol)}`],
    ['Steps', `${whole(summary.steps_accepted)} accepted, ${whole(summary.steps_rejected)} rejected`],
    ['Evaluations', whole(summary.evaluations)],
    ['Wall-clock time', `${digits(summary.wall_seconds, 3)} s`],
    ['Attitude drift', order(summary.attitude_drift)],
    ['Stresses', summary.stresses ? `${summary.stresses.signs}; pulses ${summary.stresses.pulses}; ${summary.stresses.left_out}` : null],
    ['Not computed', (summary.skipped ?? []).join('; ') || null],
  ].filter(([, value]) => value !== null && value !== undefined);
  return element('div', {}, table(['', ''], rows, { class: 'account' }), routines(run), certificate(run));
}

/** Modes that are listed; more would fill the page. */
const MOST = 60;

function routines(run) {
  const { summary, units } = run;
  const { selections = [] } = summary;
  if (selections.length === 0) return null;
  const rows = selections.slice(0, MOST).map(({ since, path, formulation, reason, evaluations }) =>
    [numeric(run.time(since, 6)), path, formulation, reason, numeric(whole(evaluations))]);
  const more = selections.length - rows.length;
  return element('div', {}, element('h3', {}, 'Routines by mode'),
    table([`Since [${units.time}]`, 'Path', 'Formulation', 'Why', 'Evaluations'], rows),
    rest(more, 'summary.json'));
}

function certificate({ data }) {
  const { certificate: found } = data;
  if (!found) return null;
  const rows = [...found.end, ...found.peaks.map((peak) => ({ ...peak, quantity: `${peak.quantity}, ${peak.name ?? `${peak.appendage},${peak.segment}`}${peak.station ? ` station ${peak.station}` : ''}` }))]
    .map(({ quantity, difference, digits: sure }) => [quantity, numeric(order(difference)), numeric(String(sure))]);
  return element('div', {}, element('h3', {}, `Certificate by ${found.reference}`), table(['Quantity', 'Difference', 'Digits'], rows));
}

/** Says how many rows a table leaves out. */
function rest(number, file) {
  return number > 0 ? note(`${number} more are in ${file}.`) : null;
}

/** The largest stresses and hinge loads, worst first; hinges by their moments. */
export function envelopes(run) {
  const { data, units } = run;
  const label = ({ appendage, segment }) => run.hinge(appendage, segment)?.label ?? `${appendage},${segment}`;
  const by = { lock_up: 'latch', impact: 'stop' };
  const cause = (row) => (by[row.event] ? `${by[row.event]} of ${label({ appendage: row.event_appendage, segment: row.event_segment })}` : 'motion');
  const stresses = [...(data.stress_envelope ?? [])].sort((a, b) => b.von_mises - a.von_mises);
  const loads = (data.hinge_envelope ?? []);
  const margin = (share) => numeric(share === null ? '' : digits(share, 3));
  const tables = [];
  if (stresses.length > 0) {
    const rows = stresses.slice(0, MOST).map((row) => [label(row), numeric(String(row.station)), numeric(digits(row.von_mises)), row.driver,
      cause(row), numeric(run.time(row.t)), margin(row.margin), margin(row.ultimate_margin)]);
    tables.push(element('h3', {}, 'Largest stresses'),
      table(['Segment', 'Station', `Von Mises [${units.stress}]`, 'Driver', 'By', `Time [${units.time}]`, 'Margin to yield', 'Margin to ultimate'], rows),
      rest(stresses.length - rows.length, 'stress_envelope.csv'));
  }
  if (loads.length > 0) {
    const hinges = new Map();
    loads.forEach((row) => {
      const key = `${row.appendage}_${row.segment}`;
      hinges.set(key, { ...hinges.get(key), [row.quantity]: row });
    });
    const size = (row) => row?.magnitude ?? 0;
    const worst = [...hinges.values()].sort((a, b) => size(b.moment) - size(a.moment) || size(b.force) - size(a.force));
    const rows = worst.slice(0, MOST).map(({ force, moment }) =>
      [label(force ?? moment), ...[force, moment].flatMap((row) => (row ? [numeric(digits(row.magnitude)), numeric(run.time(row.t)), cause(row)] : ['', '', '']))]);
    tables.push(element('h3', {}, 'Largest hinge loads'),
      table(['Hinge', `Force [${units.force}]`, `Time [${units.time}]`, 'By', `Moment [${units.torque}]`, `Time [${units.time}]`, 'By'], rows),
      rest(worst.length - rows.length, 'hinge_load_envelope.csv'));
  }
  return tables.length > 0 ? element('div', {}, tables) : null;
}

export function sceneText(run) {
  const { text } = run.data;
  if (!text) return note('The directory has no scene.toml.');
  return element('details', { open: text.split('\n').length < 60 }, element('summary', {}, 'scene.toml'), element('pre', { dir: 'ltr' }, text));
}
