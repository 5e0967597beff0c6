// Time: a slider, play at a chosen speed, events to go to, and keys for all of it.

import { eventName } from './events.js';
import { element } from './text.js';

/** Seconds that the whole motion takes at the usual speed, and the choices of speed. */
const WHOLE = 12;
const SPEEDS = [0.1, 0.25, 0.5, 1, 2, 5];

/** Parts of the motion that an arrow key moves by. */
const STEPS = 200;

export class Player {
  /** Calls `show` with each time. */
  constructor(run, show) {
    Object.assign(this, { run, showTime: show, playing: false, speed: 1 });
    [this.from, this.to] = run.span;
    this.time = this.from;
    this.instants = [...new Set(run.events.map(({ t }) => t))].sort((a, b) => a - b);
    this.slider = element('input', {
      type: 'range', min: 0, max: 1, step: 'any', value: 0, 'aria-label': 'Time', id: `time-${run.number}`, class: 'time',
      input: () => { this.pause(); this.go(this.from + (this.to - this.from) * this.slider.valueAsNumber); },
    });
    this.button = element('button', { type: 'button', class: 'play', title: 'Play or pause (space)', click: () => this.toggle() }, 'Play');
    this.clock = element('output', { class: 'clock' });
    this.what = element('output', { class: 'what', 'aria-live': 'polite' });
    this.element = this.build();
  }

  build() {
    const marks = this.instants.map((time) => {
      const names = this.run.events.filter(({ t }) => t === time).map((event) => eventName(event, this.run));
      const mark = element('button', {
        type: 'button', class: 'mark', tabindex: -1, 'aria-label': `t = ${this.run.time(time, 4)}: ${names.join(', ')}`,
        title: `t = ${this.run.time(time, 4)}: ${names.join(', ')}`, click: () => { this.pause(); this.go(time); },
      });
      mark.style.left = `${100 * this.share(time)}%`;
      return mark;
    });
    const speeds = element('select', {
      'aria-label': 'Speed', change: ({ target }) => { this.speed = Number(target.value); },
    }, SPEEDS.map((speed) => element('option', { value: speed, selected: speed === 1 }, `${speed}×`)));
    const step = (label, title, act) => element('button', { type: 'button', title, 'aria-label': title, click: act }, label);
    return element('div', { class: 'player' },
      element('div', { class: 'track' }, this.slider, element('div', { class: 'marks' }, marks)),
      element('div', { class: 'row' },
        this.button,
        step('◂ event', 'Event before (p)', () => this.event(-1)),
        step('event ▸', 'Next event (n)', () => this.event(1)),
        element('label', {}, 'Speed ', speeds),
        this.clock, this.what));
  }

  share(time) {
    return this.to > this.from ? (time - this.from) / (this.to - this.from) : 0;
  }

  toggle() {
    if (this.playing) this.pause();
    else this.play();
  }

  play() {
    if (this.time >= this.to) this.go(this.from);
    this.playing = true;
    this.button.textContent = 'Pause';
    let last = performance.now();
    const tick = (now) => {
      if (!this.playing) return;
      const passed = ((now - last) / 1000 / WHOLE) * (this.to - this.from) * this.speed;
      last = now;
      this.go(Math.min(this.time + passed, this.to));
      if (this.time >= this.to) this.pause();
      else requestAnimationFrame(tick);
    };
    requestAnimationFrame(tick);
  }

  pause() {
    this.playing = false;
    this.button.textContent = 'Play';
  }

  /** The event after, or before, the time shown. */
  event(direction) {
    this.pause();
    const { instants, time } = this;
    const next = direction > 0 ? instants.find((t) => t > time) : instants.findLast((t) => t < time);
    if (next !== undefined) this.go(next);
  }

  go(time) {
    this.time = Math.min(Math.max(time, this.from), this.to);
    this.slider.value = this.share(this.time);
    this.clock.textContent = `t = ${this.run.time(this.time)} ${this.run.units.time}`;
    const names = this.run.events.filter(({ t }) => t === this.time).map((event) => eventName(event, this.run));
    this.what.replaceChildren(names.length > 3 ? `${names.slice(0, 3).join(', ')} and ${names.length - 3} more` : names.join(', '));
    this.showTime(this.time);
  }

  /** What a key does; false if it does nothing. */
  key(key) {
    const step = (this.to - this.from) / STEPS;
    const acts = {
      ' ': () => this.toggle(),
      ArrowRight: () => { this.pause(); this.go(this.time + step); },
      ArrowLeft: () => { this.pause(); this.go(this.time - step); },
      Home: () => { this.pause(); this.go(this.from); },
      End: () => { this.pause(); this.go(this.to); },
      n: () => this.event(1),
      p: () => this.event(-1),
    };
    if (!acts[key]) return false;
    acts[key]();
    return true;
  }
}
