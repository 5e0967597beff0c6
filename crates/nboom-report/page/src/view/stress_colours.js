// Stress as colour along each body, by its stations.

import { Color } from 'three';
import { rowBefore } from '../tables.js';

/** Dark to bright, so that it reads in grey too (viridis). */
const STOPS = ['#440154', '#3b528b', '#21918c', '#5ec962', '#fde725'].map((stop) => new Color(stop));

export function colour(share) {
  const place = Math.min(Math.max(share, 0), 1) * (STOPS.length - 1);
  const i = Math.min(Math.floor(place), STOPS.length - 2);
  return STOPS[i].clone().lerp(STOPS[i + 1], place - i);
}

export const GRADIENT = `linear-gradient(to right, ${STOPS.map((stop) => `#${stop.getHexString()}`).join(', ')})`;

export class StressColours {
  constructor(run) {
    const { stress, stressPeaks } = run;
    this.stress = stress;
    this.peaks = stressPeaks;
    this.largest = 0;
    for (const table of [stress, stressPeaks]) {
      for (const column of table?.columns.slice(1) ?? []) for (const value of column) this.largest = Math.max(this.largest, value);
    }
    this.bodies = run.hinges.map((hinge, i) => {
      const places = run.bodies[i]?.stations ?? [];
      // Stations come from the outer end inwards; the function wants them the other way.
      const stations = places.map((place, k) => ({ place, name: `${hinge.key}_${k + 1}` }));
      return stations.filter(({ name }) => stress.has(name)).sort((a, b) => a.place - b.place);
    });
  }

  /** Von Mises stress along body `i` at a time, as a function of the place; nothing without stations. */
  along(i, time) {
    const stations = this.bodies[i];
    if (stations.length === 0) return null;
    const values = stations.map(({ name }) => this.value(name, time));
    return (place) => {
      let k = 0;
      while (k < stations.length - 1 && stations[k + 1].place <= place) k++;
      const [from, to] = [stations[k], stations[Math.min(k + 1, stations.length - 1)]];
      const width = to.place - from.place;
      const x = width > 0 ? Math.min(Math.max((place - from.place) / width, 0), 1) : 0;
      const next = values[Math.min(k + 1, stations.length - 1)];
      return values[k] + (next - values[k]) * x;
    };
  }

  value(name, time) {
    // At a lock-up the peak of its pulses.
    const row = this.peaks ? this.peaks.times.indexOf(time) : -1;
    if (row >= 0 && this.peaks.has(name)) return this.peaks.column(name)[row];
    const { times } = this.stress;
    const i = rowBefore(times, time);
    const j = Math.min(i + 1, times.length - 1);
    const column = this.stress.column(name);
    const x = j > i ? Math.min(Math.max((time - times[i]) / (times[j] - times[i]), 0), 1) : 0;
    return column[i] + (column[j] - column[i]) * x;
  }
}
