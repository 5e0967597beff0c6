// Which figures a run has.

import { Tree } from './pose.js';
import { angles } from './units.js';

const XYZ = ['x', 'y', 'z'];

/** Curves of one figure, from all runs; those of a hinge have its key. */
function figure(title, unit, series, extra = {}) {
  return { title, unit, series: series.filter(({ y }) => y), ...extra };
}

/** Events of kick-off springs, and whether a spring acts after them. */
const ACTS = { kick_off_engage: true, kick_off_disengage: false };

/** Share of the fastest joint's rate below which a rate is rounding. */
const ROUNDING = 1e-9;

/** The largest magnitude in some columns. */
function largest(columns) {
  return columns.filter(Boolean).reduce((most, column) => column.reduce((a, b) => Math.max(a, Math.abs(b)), most), 0);
}

function scaled(column, scale) {
  return column && scale !== 1 ? column.map((value) => value * scale) : column;
}

/** Every figure of a run, in the report's order. */
export function figuresOf(run) {
  const made = [];
  if (run.motion) made.push(...ofMotion(run));
  if (run.hingeLoads) made.push(...ofHingeLoads(run));
  if (run.stress) made.push(...ofStresses(run));
  if (run.ledger) made.push(...ofLedger(run));
  return made.filter(({ series }) => series.length > 0);
}

function ofMotion(run) {
  const { motion, units, hinges } = run;
  const x = motion.times;
  const { scale } = angles;
  const of = (quantity, which, factor) =>
    which.map(({ key, label }) => ({ label, x, y: scaled(motion.column(`${quantity}_${key}`), factor) }));
  const parts = (quantity, factor = 1) =>
    XYZ.map((axis) => ({ label: axis, x, y: scaled(motion.column(`${quantity}_${axis}`), factor) }));
  const [turning, sliding] = [hinges.filter((hinge) => !hinge.slides), hinges.filter((hinge) => hinge.slides)];
  return [
    figure('Joint angles', units.angle, of('beta', turning, scale)),
    figure('Travels', units.length, of('beta', sliding, 1)),
    figure('Joint rates', units.rate, of('tau', turning, scale)),
    figure('Speeds', units.speed, of('tau', sliding, 1)),
    figure('Rate of the main body, its axes', units.rate, parts('omega', scale), { least: ROUNDING * scale * largest(turning.map(({ key }) => motion.column(`tau_${key}`))) }),
    figure('Nutation', units.angle, [{ label: 'nutation', x, y: run.hasMomentum ? scaled(motion.column('nutation'), scale) : null }],
      { note: 'Angle between the angular momentum and the x axis of the main body.' }),
    ...directionCosines(run),
    ...kickOffs(run),
  ];
}

/** Of the main body's x axis with the inertial axes. */
function directionCosines({ motion }) {
  const [w, i, j, k] = ['chi', 'kappa_x', 'kappa_y', 'kappa_z'].map((name) => motion.column(name));
  if (!(w && i && j && k)) return [];
  const x = motion.times;
  const along = (row) => [
    1 - 2 * (j[row] ** 2 + k[row] ** 2), 2 * (i[row] * j[row] + w[row] * k[row]), 2 * (i[row] * k[row] - w[row] * j[row])];
  const rows = Array.from(x, (_, row) => along(row));
  const series = XYZ.map((axis, part) => ({ label: axis, x, y: rows.map((row) => row[part]) }));
  return [figure('Direction cosines of the main body’s x axis', '', series, { note: 'With the inertial x, y and z axes.' })];
}

/**
 * Forces of kick-off springs. A spring lets go and takes hold at its events: at its limit length only they say on which
 * side the motion is.
 */
function kickOffs(run) {
  if (!run.scene?.bodies.some(({ kick_off: spring }) => spring)) return [];
  const tree = new Tree(run.scene);
  const { motion, hinges, units } = run;
  const columns = hinges.map(({ key }) => motion.column(`beta_${key}`));
  if (!columns.every(Boolean)) return [];
  const forces = hinges.map(() => new Float64Array(motion.rows));
  const acts = hinges.map(() => null);
  const { times } = motion;
  let next = 0;
  for (let row = 0; row < motion.rows; row++) {
    // Of rows at one time the last is after what happens then.
    const isAfter = times[row + 1] !== times[row];
    for (; run.events[next]?.t < times[row] || (isAfter && run.events[next]?.t === times[row]); next++) {
      const { kind, appendage, segment } = run.events[next];
      if (kind in ACTS) acts[hinges.indexOf(run.hinge(appendage, segment))] = ACTS[kind];
    }
    const found = tree.kickOffs(tree.places(columns.map((column) => column[row])));
    found.forEach((spring, i) => {
      if (!spring) return;
      acts[i] ??= spring.reaches;
      forces[i][row] = acts[i] ? spring.force : 0;
    });
  }
  const sprung = hinges.map((hinge, i) => ({ label: hinge.label, x: times, y: run.scene.bodies[i].kick_off ? forces[i] : null }));
  return [figure('Kick-off forces', units.force, sprung)];
}

function ofHingeLoads(run) {
  const { hingeLoads, hingePeaks, units, hinges } = run;
  const of = (quantity, title, unit) => {
    const curves = hinges.map(({ key, label }) =>
      ({ label, x: hingeLoads.times, y: hingeLoads.column(`${quantity}_${key}`) })).filter(({ y }) => y);
    const worst = (run.data.hinge_envelope ?? []).filter((row) => row.quantity === quantity);
    const marks = worst.map(({ appendage, segment, t, magnitude }) => {
      const hinge = run.hinge(appendage, segment);
      const i = curves.findIndex(({ label }) => label === hinge?.label);
      return i < 0 ? null : { label: `largest at ${hinge.label}`, x: [t], y: [magnitude], points: true, of: i };
    }).filter(Boolean);
    const pulses = run.summary?.latch_pulses === false ? 'without latches, which have no pulse_constant' : 'with the pulses of latches';
    const note = marks.length > 0 ? `Dots: the largest of the whole motion, ${pulses}.` : '';
    return figure(title, unit, [...curves, ...marks], { note, peaks: hingePeaks });
  };
  return [of('force', 'Hinge forces', units.force), of('moment', 'Hinge moments', units.torque)];
}

/** Of each segment the station with the largest stress at the time. */
function ofStresses(run) {
  const { stress, units, hinges } = run;
  const curves = hinges.map(({ key, label }) => {
    const stations = stress.names.filter((name) => name.startsWith(`${key}_`)).map((name) => stress.column(name));
    if (stations.length === 0) return { label, x: stress.times, y: null };
    const y = Float64Array.from(stress.times, (_, row) => Math.max(...stations.map((column) => column[row])));
    return { label, x: stress.times, y };
  }).filter(({ y }) => y);
  const marks = curves.map(({ label }, i) => {
    const hinge = hinges.find((candidate) => candidate.label === label);
    const rows = (run.data.stress_envelope ?? []).filter(({ appendage, segment }) => appendage === hinge.appendage && segment === hinge.segment);
    const worst = rows.reduce((most, row) => (row.von_mises > (most?.von_mises ?? -1) ? row : most), null);
    return worst && { label: `largest in ${label}`, x: [worst.t], y: [worst.von_mises], points: true, of: i };
  }).filter(Boolean);
  const note = 'Von Mises stress of the worst station of each segment. Dots: the largest of the whole motion, with the pulses of latches.';
  return [figure('Stresses', units.stress, [...curves, ...marks], { note })];
}

function ofLedger({ ledger, units }) {
  const x = ledger.times;
  const parts = [['kinetic energy', 'kinetic_energy'], ['potential energy', 'potential_energy'], ['work of dashpots', 'dashpot_work'],
    ['work of thrust', 'thrust_work'], ['work of motors', 'motor_work'], ['taken away by lock-ups', 'lock_up_loss']];
  const moves = (column) => column && column.some((value) => value !== 0);
  const energies = parts.map(([label, name]) => ({ label, x, y: ledger.column(name) })).filter(({ y }) => moves(y));
  const laws = [['linear momentum', 'residual_linear_momentum'], ['angular momentum', 'residual_angular_momentum'], ['energy', 'residual_energy']];
  const residuals = laws.map(([label, name]) => {
    const column = ledger.column(name);
    // Nothing has no logarithm.
    return { label, x, y: moves(column) ? Array.from(column, (value) => (value > 0 ? value : null)) : null };
  });
  return [
    figure('Energy', units.energy, energies, { note: 'Kinetic and potential energy and what lock-ups took away add up to the work done. Lines join output times.' }),
    figure('Conservation residuals', 'relative', residuals,
      { log: true, note: 'What momentum and energy are off by, after all impulses and all work have been accounted for. Zeros are not drawn.' }),
  ];
}
