// The motion at any time: rows of the table, and smooth curves between them.

import { Quaternion, Vector3 } from 'three';
import { rowBefore } from './tables.js';

export class Motion {
  constructor(run) {
    const { motion, hinges } = run;
    const column = (name) => motion.column(name);
    this.times = motion.times;
    this.beta = hinges.map(({ key }) => column(`beta_${key}`));
    this.tau = hinges.map(({ key }) => column(`tau_${key}`));
    this.attitude = ['chi', 'kappa_x', 'kappa_y', 'kappa_z'].map(column);
    this.omega = ['omega_x', 'omega_y', 'omega_z'].map(column);
    this.momentum = ['angular_momentum_x', 'angular_momentum_y', 'angular_momentum_z'].map(column);
    this.nutation = column('nutation');
    this.hasMomentum = run.hasMomentum;
    this.spinAxis = run.spinAxis;
  }

  /** Whether all columns are there that a picture needs. */
  get isWhole() {
    return [...this.beta, ...this.attitude].every(Boolean);
  }

  /** Angles, attitude, momentum and nutation at a time; at a row they are the row's. */
  at(time) {
    const { times } = this;
    const i = rowBefore(times, time);
    const last = i === times.length - 1 || times[i] === time;
    const h = last ? 0 : times[i + 1] - times[i];
    const x = h > 0 ? Math.min(Math.max((time - times[i]) / h, 0), 1) : 0;
    const j = h > 0 ? i + 1 : i;
    const linear = (column) => (column ? column[i] + (column[j] - column[i]) * x : 0);
    const beta = this.beta.map((column, hinge) => {
      if (x === 0) return column[i];
      const rates = this.tau[hinge];
      return rates ? hermite(x, h, [column[i], column[j]], [rates[i], rates[j]]) : linear(column);
    });
    return {
      time, beta,
      tau: this.tau.map(linear),
      attitude: this.attitudeAt(i, j, x, h),
      momentum: new Vector3(...this.momentum.map(linear)),
      nutation: linear(this.nutation),
    };
  }

  /** Both rows carried on by their rates, and one faded into the other: right for fast spins too. */
  attitudeAt(i, j, x, h) {
    const at = (row) => {
      const [w, ...xyz] = this.attitude.map((column) => column[row]);
      return new Quaternion(...xyz, w);
    };
    const before = at(i);
    if (x === 0) return before;
    const carried = (row, from, time) => {
      const omega = new Vector3(...this.omega.map((column) => (column ? column[row] : 0)));
      const angle = omega.length() * time;
      return from.multiply(new Quaternion().setFromAxisAngle(omega.normalize(), angle));
    };
    const fade = x * x * (3 - 2 * x);
    return carried(i, before, x * h).slerp(carried(j, at(j), (x - 1) * h), fade);
  }
}

/** The cubic with these values and rates at both ends. */
function hermite(x, h, [from, to], [rateFrom, rateTo]) {
  const y = 1 - x;
  return from * y * y * (1 + 2 * x) + to * x * x * (3 - 2 * x) + h * x * y * (rateFrom * y - rateTo * x);
}
