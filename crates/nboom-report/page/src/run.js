// A run as the page sees it: what was computed, by name.

import { Table } from './tables.js';
import { moment, visible } from './text.js';
import { labels } from './units.js';

export class Run {
  constructor(data, number) {
    this.data = data;
    this.number = number;
    this.name = visible(data.label);
    this.units = labels(data.units);
    this.scene = data.scene;
    this.captions = data.captions;
    this.events = data.events ?? [];
    this.motion = data.motion && new Table(data.motion);
    this.hasMomentum = data.has_momentum;
    this.spinAxis = data.spin_axis;
    this.leastRate = data.least_rate;
    this.kickOffs = data.kick_offs && new Table(data.kick_offs);
    this.rotorSpeeds = data.rotor_speeds && new Table(data.rotor_speeds);
    this.requested = data.requested && new Table(data.requested);
    this.isSlid = data.is_slid;
    this.ledger = data.ledger && new Table(data.ledger);
    this.hingeLoads = data.hinge_loads && new Table(data.hinge_loads);
    this.stress = data.stress && new Table(data.stress);
    this.stressPeaks = data.stress_peaks && new Table(data.stress_peaks);
    this.summary = data.summary;
    const shown = (one) => ({ ...one, label: visible(one.label) });
    this.hinges = data.hinges.map(shown);
    this.rotors = data.rotors.map(shown);
  }

  /** First and last time of the motion. */
  get span() {
    const { times } = this.motion;
    return [times[0], times[times.length - 1]];
  }

  /** A time of the run with at least so many digits, without its unit. */
  time(value, least = 5) {
    const told = this.motion?.times ?? this.events.map(({ t }) => t);
    return moment(value, told.length > 0 ? told[told.length - 1] - told[0] : 0, least);
  }

  /** The hinge with these numbers, which count from 1. */
  hinge(appendage, segment) {
    return this.hinges.find((hinge) => hinge.appendage === appendage && hinge.segment === segment);
  }

  /** Its hinges in the motion, with their bodies. */
  get bodies() {
    return this.scene?.bodies ?? [];
  }
}
