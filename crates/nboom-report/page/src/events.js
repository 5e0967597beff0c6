// What happened, when, and what it did to energy.

import { rowBefore } from './tables.js';
import { digits, element, numeric, order, table } from './text.js';

const NAMES = {
  lock_up: 'locks', release: 'is released', kick_off_disengage: 'kick-off spring lets go',
  kick_off_engage: 'kick-off spring takes hold', torque_table_up: 'passes a point of its table upward',
  torque_table_down: 'passes a point of its table downward', turn_up: 'turns upward', turn_down: 'turns downward',
  stick: 'sticks by friction', slip: 'slips', impact: 'hits a stop', rest: 'rests against a stop', leave: 'leaves a stop',
  thrust_on: 'thrust on', thrust_off: 'thrust off', end: 'end of the run',
};

/** What happens in an event. */
export function happening({ kind }) {
  return NAMES[kind] ?? kind.replaceAll('_', ' ');
}

/** An event in words, with its hinge. */
export function eventName(event, run) {
  const hinge = hingeOf(event, run);
  return hinge ? `${hinge.label}: ${happening(event)}` : happening(event);
}

export function hingeOf({ appendage, segment }, run) {
  return appendage ? run.hinge(appendage, segment) : undefined;
}

/** Rows that are shown before the rest is asked for. */
const MOST = 40;

/** The table of events; a click goes to one. */
export function eventTable(run, go) {
  const { units } = run;
  const headings = [`Time [${units.time}]`, 'Hinge', 'What happens',
    `Impulse [${units.angular_momentum}]`, `Kinetic energy before [${units.energy}]`, 'after', 'change'];
  const momentum = momentumAt(run);
  if (momentum) headings.push(`Angular momentum [${units.angular_momentum}]`, 'its change');
  let [instant, before] = [null, null];
  const rows = run.events.map((event) => {
    const first = event.t !== instant;
    // Lock-ups and impacts of one instant share the change of energy; what comes after them in it changes none.
    const shared = !first && event.before === before;
    [instant, before] = [event.t, event.before];
    const change = event.after - event.before;
    const hinge = hingeOf(event, run);
    // One of a slide has another unit than the heading.
    const unit = hinge?.slides ? ` ${units.momentum}` : '';
    return {
      attributes: { tabindex: 0, class: 'event', 'data-t': event.t, click: () => go(event.t), keydown: ({ key }) => key === 'Enter' && go(event.t) },
      cells: [numeric(run.time(event.t, 6)), hinge?.label ?? '', happening(event),
        numeric(event.impulse === null ? '' : `${digits(event.impulse)}${unit}`),
        ...(shared ? [null, null, null] : [event.before, event.after, change]).map((value) => numeric(value === null ? '″' : digits(value, 5))),
        ...(momentum ? momentum(event.t, first) : [])],
    };
  });
  const shown = table(headings, rows.slice(0, MOST), { id: `events-${run.number}`, class: 'events' });
  if (rows.length <= MOST) return shown;
  const all = element('button', { type: 'button', click: () => shown.replaceChildren(...table(headings, rows).childNodes) }, `Show all ${rows.length} events`);
  shown.append(all);
  return shown;
}

/** The angular momentum after an instant and its change in it, relative, by the rows on both sides. */
function momentumAt({ motion, hasMomentum }) {
  const parts = ['x', 'y', 'z'].map((axis) => motion?.column(`angular_momentum_${axis}`));
  if (!parts.every(Boolean) || !hasMomentum) return null;
  return (time, first) => {
    if (!first) return [numeric('″'), numeric('″')];
    const after = rowBefore(motion.times, time);
    let before = after;
    while (before > 0 && motion.times[before - 1] === time) before -= 1;
    const [size, change] = [after, before].map((row, i) => Math.hypot(...parts.map((column) => column[row] - (i === 0 ? 0 : column[after]))));
    const found = motion.times[after] === time;
    return [numeric(found ? digits(size, 6) : ''), numeric(found && before < after ? order(change / size) : '')];
  };
}
