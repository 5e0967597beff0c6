// Which figures a run has.

import { angles } from './units.js';

const XYZ = ['x', 'y', 'z'];

/** Curves of one figure, from all runs; those of a hinge have its key. */
function figure(title, unit, series, extra = {}) {
  return { title, unit, series: series.filter(({ y }) => y), ...extra };
}

function scaled(column, scale) {
  return column && scale !== 1 ? column.map((value) => value * scale) : column;
}

/** Every figure of a run, in the report's order. */
export function figuresOf(run) {
  const made = [];
  if (run.motion) made.push(...ofMotion(run));
  made.push(...ofRotors(run), ...ofRig(run));
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
  const sliding = hinges.filter(({ slides }) => slides);
  // Their turns would make all other angles one line.
  const wheels = hinges.filter(({ wheel }) => wheel);
  const turning = hinges.filter(({ slides, wheel }) => !slides && !wheel);
  return [
    figure('Joint angles', units.angle, of('beta', turning, scale)),
    figure('Angles of wheels', units.angle, of('beta', wheels, scale)),
    figure('Travels', units.length, of('beta', sliding, 1)),
    figure('Joint rates', units.rate, of('tau', turning, scale)),
    figure('Rates of wheels', units.rate, of('tau', wheels, scale)),
    figure('Speeds', units.speed, of('tau', sliding, 1)),
    figure('Rate of the main body, its axes', units.rate, parts('omega', scale), { least: scale * run.leastRate }),
    figure('Velocity of the main body, inertial axes', units.speed, run.isSlid ? parts('v') : []),
    figure('Nutation', units.angle, [{ label: 'nutation', x, y: run.hasMomentum ? scaled(motion.column('nutation'), scale) : null }],
      { note: run.captions.nutation }),
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

function kickOffs({ kickOffs: forces, units, hinges }) {
  if (!forces) return [];
  return [figure('Kick-off forces', units.force, hinges.map(({ key, label }) => ({ label, x: forces.times, y: forces.column(`force_${key}`) })))];
}

function ofRotors({ rotors, rotorSpeeds, requested, units, captions }) {
  const of = (table, quantity, scale) =>
    rotors.map(({ key, label }) => ({ label, x: table?.times, y: scaled(table?.column(`${quantity}_${key}`), scale) }));
  return [
    figure('Speeds of rotors', units.rate, of(rotorSpeeds ?? requested, 'rotor_speed', angles.scale), { note: captions.rotor_speeds }),
    figure('Torques of motors', units.torque, of(requested, 'motor_torque', 1), { note: captions.on_request }),
  ];
}

/** What holds the main body on a test rig. */
function ofRig({ requested: table, units, captions }) {
  const note = `Of the test rig on the main body, its axes; the moment about O. ${captions.on_request}`;
  const of = (quantity) => XYZ.map((axis) => ({ label: axis, x: table?.times, y: table?.column(`${quantity}_${axis}`) }));
  return [
    figure('Force of the rig', units.force, of('reaction_force'), { note }),
    figure('Moment of the rig', units.torque, of('reaction_moment'), { note }),
  ];
}

function ofHingeLoads(run) {
  const { hingeLoads, units } = run;
  const of = (quantity, title, unit) => {
    const curves = ofHinges(run, ({ key }) => hingeLoads.column(`${quantity}_${key}`), hingeLoads.times);
    const worst = (run.data.hinge_envelope ?? []).filter((row) => row.quantity === quantity);
    return figure(title, unit, ...withDots(run, curves, worst, 'magnitude'));
  };
  return [of('force', 'Hinge forces', units.force), of('moment', 'Hinge moments', units.torque)];
}

/** Of each segment the station with the largest stress at the time. */
function ofStresses(run) {
  const { stress, units } = run;
  const curves = ofHinges(run, ({ key }) => {
    const stations = stress.names.filter((name) => name.startsWith(`${key}_`)).map((name) => stress.column(name));
    return stations.length > 0 && Float64Array.from(stress.times, (_, row) => Math.max(...stations.map((column) => column[row])));
  }, stress.times);
  return [figure('Stresses', units.stress, ...withDots(run, curves, run.data.stress_envelope ?? [], 'von_mises', `Von Mises stress. ${run.captions.stresses}`))];
}

/** Curves of those hinges that have values. */
function ofHinges({ hinges }, values, x) {
  return hinges.map((hinge) => ({ hinge, label: hinge.label, x, y: values(hinge) })).filter(({ y }) => y);
}

/** Curves of hinges with their largest values as dots, by rows of an envelope, and the note that says so. */
function withDots({ captions }, curves, rows, quantity, note = '') {
  const dots = curves.map(({ hinge: { appendage, segment, label } }, i) => {
    const own = rows.filter((row) => row.appendage === appendage && row.segment === segment);
    const worst = own.reduce((most, row) => (row[quantity] > (most?.[quantity] ?? -1) ? row : most), null);
    return worst && { label: `largest, ${label}`, x: [worst.t], y: [worst[quantity]], points: true, of: i };
  }).filter(Boolean);
  return [[...curves, ...dots], { note: [note, dots.length > 0 ? captions.dots : ''].filter(Boolean).join(' ') }];
}

function ofLedger({ ledger, units, captions }) {
  const x = ledger.times;
  const moves = (column) => column && column.some((value) => value !== 0);
  const of = (parts, shown) => parts.map(([label, name]) => ({ label, x, y: ledger.column(name) }))
    .filter(({ y }) => moves(y)).map((curve) => ({ ...curve, y: shown(curve.y) }));
  // Nothing has no logarithm.
  const positive = (column) => Array.from(column, (value) => (value > 0 ? value : null));
  return [
    figure('Energy', units.energy, of(captions.energies, (column) => column), { note: captions.energy }),
    figure('Conservation residuals', 'relative', of(captions.laws, positive), { log: true, note: captions.residuals }),
  ];
}
