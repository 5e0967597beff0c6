// What is drawn beside the bodies: joint axes, mass centre, momentum and the cone of nutation.

import {
  ArrowHelper, BufferGeometry, ConeGeometry, DoubleSide, Group, Line, LineBasicMaterial, LineLoop, LineSegments, Mesh,
  MeshBasicMaterial, SphereGeometry, Vector3,
} from 'three';

const UP = new Vector3(0, 1, 0);

/** Half angle beyond which a cone is drawn by its rim alone. */
const FLAT = 1.2;

/** A line along the axis of each joint, in the axes of its body. */
export function jointAxis(body, size, colour) {
  const { tip, center } = body;
  const own = Math.max(Math.hypot(...tip), 2 * Math.hypot(...center));
  const axis = new Vector3(...body.axis).multiplyScalar(Math.max(Math.min(0.045 * size, 0.4 * own), 0.006 * size));
  const geometry = new BufferGeometry().setFromPoints([axis.clone().negate(), axis]);
  return new LineSegments(geometry, new LineBasicMaterial({ color: colour, depthTest: false }));
}

/** Axes of the main body. */
export function triad(size, colours) {
  const group = new Group();
  const directions = [[1, 0, 0], [0, 1, 0], [0, 0, 1]];
  directions.forEach((direction, i) => {
    group.add(arrow(new Vector3(...direction), 0.2 * size, colours.axes[i], 0.02 * size));
  });
  return group;
}

export function centre(size, colour) {
  const mesh = new Mesh(new SphereGeometry(0.008 * size, 16, 12), new MeshBasicMaterial({ color: colour, depthTest: false }));
  mesh.renderOrder = 3;
  return mesh;
}

function arrow(direction, length, colour, head) {
  const made = new ArrowHelper(direction, new Vector3(), length, colour, head * 2, head);
  return made;
}

/** The angular momentum at the mass centre, and the cone that the main body's spin axis makes about it. */
export class Momentum {
  constructor(size, colours) {
    this.size = size;
    this.group = new Group();
    this.arrow = arrow(UP, 0.5 * size, colours.momentum, 0.022 * size);
    this.cone = new Mesh(new ConeGeometry(1, 1, 64, 1, true), new MeshBasicMaterial({
      color: colours.cone, transparent: true, opacity: 0.14, side: DoubleSide, depthWrite: false,
    }));
    this.rim = new LineLoop(circle(96), new LineBasicMaterial({ color: colours.cone }));
    this.ray = new Line(new BufferGeometry().setFromPoints([new Vector3(), new Vector3(1, 0, 0)]),
      new LineBasicMaterial({ color: colours.cone }));
    this.group.add(this.arrow, this.cone, this.rim, this.ray);
  }

  /** `momentum` and the main body's axis `spin`, about which it nutates, along the axes of the group. */
  show(momentum, nutation, spin) {
    this.group.visible = momentum.length() > 0;
    if (!this.group.visible) return;
    const direction = momentum.clone().normalize();
    this.arrow.setDirection(direction);
    // Beyond a right angle the cone opens the other way.
    const backward = nutation > Math.PI / 2;
    const angle = backward ? Math.PI - nutation : nutation;
    const length = 0.4 * this.size;
    const [height, radius] = [length * Math.cos(angle), length * Math.sin(angle)];
    const along = backward ? direction.clone().negate() : direction;
    const isCone = angle > 1e-3;
    this.rim.visible = this.ray.visible = isCone;
    // A cone that is nearly flat only hides what is behind it.
    this.cone.visible = isCone && angle < FLAT;
    if (!isCone) return;
    for (const part of [this.cone, this.rim]) part.quaternion.setFromUnitVectors(UP, along);
    this.cone.scale.set(radius, Math.max(height, 1e-6), radius);
    // Its point is at the mass centre.
    this.cone.quaternion.setFromUnitVectors(UP, along.clone().negate());
    this.cone.position.copy(along).multiplyScalar(height / 2);
    this.rim.scale.setScalar(radius);
    this.rim.position.copy(along).multiplyScalar(height);
    this.ray.quaternion.setFromUnitVectors(new Vector3(1, 0, 0), spin);
    this.ray.scale.setScalar(length);
  }
}

function circle(count) {
  const points = Array.from({ length: count }, (_, i) => {
    const angle = (2 * Math.PI * i) / count;
    return new Vector3(Math.cos(angle), 0, Math.sin(angle));
  });
  return new BufferGeometry().setFromPoints(points);
}
