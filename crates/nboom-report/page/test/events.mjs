// What the words are for events of stops, and what a hinge is after them:
//
//     npm test

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { happening } from '../src/events.js';
import { sentence } from '../src/verdict.js';
import { Animation } from '../src/view/animation.js';

test('events of stops have words', () => {
  const words = ['impact', 'rest', 'leave'].map((kind) => happening({ kind }));
  assert.deepEqual(words, ['hits a stop', 'rests against a stop', 'leaves a stop']);
});

test('a hinge that rests against a stop is stuck until it leaves it', () => {
  const joint = { appendage: 1, segment: 1 };
  const events = [[1, 'release'], [2, 'impact'], [3, 'rest'], [4, 'leave'], [5, 'stick'], [6, 'slip']];
  const run = { scene: { bodies: [{ ...joint, start_state: 'held' }] }, events: events.map(([t, kind]) => ({ t, kind, ...joint })) };
  const states = [0.5, 1.5, 2.5, 3.5, 4.5, 5.5, 6.5].map((time) => Animation.prototype.stateOf.call({ run }, joint, time));
  assert.deepEqual(states, ['held', 'free', 'free', 'stuck', 'free', 'stuck', 'free']);
});

test('the verdict names stops beside friction', () => {
  const told = sentence({ summary: { verdict: { hinges: [{ state: 2 }, { state: 2 }, { state: 0 }] } }, units: {} });
  assert.equal(told, '1 joint free at the end, 2 joints stuck by friction or against a stop.');
});
