// Angles as people want them, and labels of units.

import { digits, visible } from './text.js';

const DEGREES = 180 / Math.PI;

/** How angles are shown: in degrees, unless somebody chooses radians. */
export const angles = {
  inDegrees: true,
  get scale() {
    return this.inDegrees ? DEGREES : 1;
  },
  get unit() {
    return this.inDegrees ? '°' : 'rad';
  },
};

/** Labels of the units of a run. */
export function labels(given) {
  const shown = Object.fromEntries(Object.entries(given).map(([quantity, label]) => [quantity, visible(label)]));
  return {
    ...shown,
    get angle() { return angles.unit; },
    get rate() { return `${angles.unit}/${shown.time}`; },
  };
}

/** An angle with its unit. */
export function angleText(radians) {
  return `${digits(radians * angles.scale)}${angles.inDegrees ? '°' : '\u00a0rad'}`;
}
