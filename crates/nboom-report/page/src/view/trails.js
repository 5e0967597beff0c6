// Paths of the outer ends of the outermost bodies.

import { BufferAttribute, BufferGeometry, Group, Line, LineBasicMaterial, Matrix4, Vector3 } from 'three';
import { inertial } from '../pose.js';

/** Points along a path: enough for a curve, and for each turn of a spin. */
const LEAST = 500;
const MOST = 4000;
const OF_A_TURN = 60;

/** Most paths that are drawn; more would hide the satellite. */
const PATHS = 12;

export class Trails {
  constructor(motion, tree, riding, colour) {
    const { scene } = tree;
    const inner = new Set(scene.bodies.map(({ inboard }) => inboard));
    const outermost = scene.bodies.map((_, i) => i).filter((i) => !inner.has(i));
    const step = Math.ceil(outermost.length / PATHS);
    this.ends = outermost.filter((_, i) => i % step === 0);
    this.times = times(motion);
    this.group = new Group();
    const paths = this.ends.map(() => new Float32Array(3 * this.times.length));
    this.times.forEach((time, row) => {
      const now = motion.at(time);
      const places = tree.places(now.beta);
      const frame = riding ? new Matrix4() : inertial(now.attitude, tree.middle(places));
      this.ends.forEach((i, path) => {
        const end = outerEnd(scene, i).applyMatrix4(places[i]).applyMatrix4(frame);
        paths[path].set([end.x, end.y, end.z], 3 * row);
      });
    });
    paths.forEach((path) => {
      const geometry = new BufferGeometry();
      geometry.setAttribute('position', new BufferAttribute(path, 3));
      this.group.add(new Line(geometry, new LineBasicMaterial({ color: colour, transparent: true, opacity: 0.65 })));
    });
  }

  /** Shows the paths up to a time. */
  show(time) {
    let count = 0;
    while (count < this.times.length && this.times[count] <= time) count++;
    const from = Math.max(0, count - LEAST);
    this.group.children.forEach(({ geometry }) => geometry.setDrawRange(from, count - from));
  }

  dispose() {
    this.group.children.forEach(({ geometry, material }) => [geometry, material].forEach((part) => part.dispose()));
  }
}

export function outerEnd({ bodies }, i) {
  const { tip, center } = bodies[i];
  return Math.hypot(...tip) > 0 ? new Vector3(...tip) : new Vector3(...center).multiplyScalar(2);
}

function times(motion) {
  const { times: rows, omega } = motion;
  const [from, to] = [rows[0], rows[rows.length - 1]];
  let fastest = 0;
  for (let i = 0; i < rows.length; i++) fastest = Math.max(fastest, Math.hypot(...omega.map((w) => (w ? w[i] : 0))));
  const turns = (fastest * (to - from)) / (2 * Math.PI);
  const count = Math.min(MOST, Math.max(LEAST, Math.ceil(turns * OF_A_TURN)));
  return Array.from({ length: count + 1 }, (_, i) => from + ((to - from) * i) / count);
}
