// Which values of a curve are dots:
//
//     npm test

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { alone } from '../src/gaps.js';

test('a value between gaps is alone, and one beside another is not', () => {
  assert.deepEqual(alone([null, 1, null, 2, 3, null, 4]), [1, 6]);
  assert.deepEqual(alone([5]), [0]);
  assert.deepEqual(alone([1, 2, 3]), []);
});

test('where only other curves have values there is no gap', () => {
  assert.deepEqual(alone([1, undefined, 2, undefined, null, undefined, 3, undefined]), [6]);
});
