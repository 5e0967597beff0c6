// How numbers are written:
//
//     npm test

import assert from 'node:assert/strict';
import { test } from 'node:test';
import { digits, moment, numeric, stepped, visible, whole } from '../src/text.js';

test('labels a step apart are the numbers at their places', () => {
  for (const step of [1, 2, 2.5, 5, 10, 20, 25, 50, 0.1, 0.25, 0.05, 2.5e-7, 2.5e7]) {
    for (const offset of [0, 3 * step, 100 * step]) {
      for (let i = -4; i <= 4; i++) {
        const value = offset + i * step;
        const [mantissa, power] = stepped(value, step).replaceAll('\u2212', '-').split('\u202f\u00b7\u202f10');
        const raised = [...(power ?? '')].map((c) => '0123456789-'['\u2070\u00b9\u00b2\u00b3\u2074\u2075\u2076\u2077\u2078\u2079\u207b'.indexOf(c)]).join('');
        assert.ok(Math.abs(Number(mantissa) * 10 ** Number(raised) - value) < 1e-6 * step, `${value}, ${step} apart: ${stepped(value, step)}`);
      }
    }
  }
});

test('numbers have their digits, and what is none is a dash', () => {
  assert.deepEqual([0, 1234.56, -0.00123456, 1.5e7].map((value) => digits(value)), ['0', '1235', '\u22120.001235', '1.5\u202f\u00b7\u202f10\u2077']);
  assert.deepEqual([null, undefined, NaN, Infinity].map((value) => digits(value)), Array(4).fill('\u2013'));
  assert.deepEqual([numeric('').number, whole(undefined), whole(1234567)], ['\u2013', '\u2013', '1,234,567']);
  assert.equal(moment(2592001.25, 10, 5), '2592001.25');
});

test('marks that turn text, and controls, are replaced; line ends stay', () => {
  assert.equal(visible('a\u202eb\u200bc\u0007d\n\te'), 'a\ufffdb\ufffdc\ufffdd\n\te');
});
