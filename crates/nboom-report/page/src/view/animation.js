// The picture with its choices and what it says about the time shown.

import { Motion } from '../motion.js';
import { digits, element, given, note } from '../text.js';
import { angleText } from '../units.js';
import { LAYERS, Satellite } from './satellite.js';
import { GRADIENT } from './stress_colours.js';

/** Joints whose positions are listed beside the picture. */
const LISTED = 200;

export class Animation {
  constructor(run, colours) {
    this.run = run;
    this.motion = new Motion(run);
    this.canvas = element('canvas', { tabindex: 0, 'aria-label': 'The satellite; drag to turn, scroll to come closer' });
    try {
      this.satellite = new Satellite(run, this.motion, this.canvas, colours);
    } catch (error) {
      this.failure = `There is no 3-D picture: ${error.message}`;
    }
    this.element = this.build();
  }

  build() {
    if (this.failure) this.canvas.hidden = true;
    const { satellite, run } = this;
    const layers = LAYERS.filter(([key]) => key !== 'stress' || satellite?.stress).map(([key, name, on]) =>
      element('label', {}, element('input', { type: 'checkbox', checked: on, 'data-layer': key, change: ({ target }) => { satellite.layers[key] = target.checked; this.show(this.time); } }), ` ${name}`));
    this.view = element('button', { type: 'button', id: 'view', title: 'From inertial space, or riding on the main body (v)', click: () => this.turnView() }, 'View: inertial');
    const again = element('button', { type: 'button', title: 'Look as at first', click: () => { satellite.look(); satellite.draw(); } }, 'Reset view');
    this.states = element('ul', { class: 'joints' });
    this.readings = element('dl', { class: 'readings' });
    this.rows = run.hinges.slice(0, LISTED).map((hinge) => {
      const value = element('span', { class: 'angle', 'data-joint': hinge.key });
      const state = element('span', { class: 'state' });
      this.states.append(element('li', {}, given(hinge.label), value, state));
      return { hinge, value, state };
    });
    const scale = satellite?.stress ? element('div', { class: 'scale', title: 'Von Mises stress' }, element('span', {}, 'Stress 0'), this.bar(),
      element('span', {}, `${digits(satellite.stress.largest, 3)} ${run.units.stress}`)) : null;
    return element('div', { class: 'stage' },
      element('div', { class: 'picture' }, this.canvas, this.failure ? note(this.failure) : null, scale),
      element('div', { class: 'beside' },
        element('div', { class: 'layers' }, this.view, again, layers),
        this.readings, this.states));
  }

  bar() {
    const bar = element('i', {});
    bar.style.background = GRADIENT;
    return bar;
  }

  /** After the element is on the page. */
  attach() {
    this.fit();
    this.satellite?.look();
  }

  fit() {
    const { clientWidth, clientHeight } = this.canvas;
    if (clientWidth > 0) this.satellite?.resize(clientWidth, clientHeight);
  }

  recolour(colours) {
    if (!this.satellite) return;
    this.satellite.build(colours);
    this.satellite.stressShown = undefined;
  }

  turnView() {
    if (!this.satellite) return true;
    this.satellite.ride(!this.satellite.riding);
    this.view.textContent = this.satellite.riding ? 'View: riding on the main body' : 'View: inertial';
    this.show(this.time);
    return true;
  }

  show(time) {
    this.time = time;
    const now = this.satellite ? this.satellite.show(time) : this.motion.at(time);
    const { run } = this;
    this.rows.forEach(({ hinge, value, state }, i) => {
      const beta = now.beta[i];
      value.dataset.radians = String(beta);
      value.textContent = hinge.slides ? `${digits(beta, 4)} ${run.units.length}` : angleText(beta);
      state.textContent = this.stateOf(hinge, time);
      state.className = `state state-${state.textContent}`;
    });
    const readings = this.motion.hasMomentum
      ? [[`Nutation of ${'xyz'[run.spinAxis]}`, angleText(now.nutation)], ['Angular momentum', `${digits(now.momentum.length())} ${run.units.angular_momentum}`]]
      : [['Angular momentum', 'none']];
    this.readings.replaceChildren(...readings.map(([name, value]) => element('div', {}, element('dt', {}, name), element('dd', {}, value))));
  }

  /** Held, free, stuck or locked, by the events up to a time. */
  stateOf(hinge, time) {
    const { run } = this;
    const body = run.scene.bodies.find(({ appendage, segment }) => appendage === hinge.appendage && segment === hinge.segment);
    let state = body.start_state;
    for (const { t, kind, appendage, segment } of run.events) {
      if (t > time) break;
      if (appendage !== hinge.appendage || segment !== hinge.segment) continue;
      if (kind === 'lock_up') state = 'locked';
      if (kind === 'release' || kind === 'slip' || kind === 'leave') state = 'free';
      if (kind === 'stick' || kind === 'rest') state = 'stuck';
    }
    return state;
  }
}
