// Where bodies are: forward kinematics of the scene's tree.

import { Matrix4, Quaternion, Vector3 } from 'three';

/** The matrix with these rows. */
export function rotation(rows) {
  const [a, b, c, d, e, f, g, h, i] = rows;
  return new Matrix4().set(a, b, c, 0, d, e, f, 0, g, h, i, 0, 0, 0, 0, 1);
}

export class Tree {
  constructor(scene) {
    this.scene = scene;
    this.mounts = scene.bodies.map(({ point, rotation: rows }) =>
      rotation(rows).setPosition(new Vector3(...point)));
    this.axes = scene.bodies.map(({ axis }) => new Vector3(...axis));
    this.centers = scene.bodies.map(({ center }) => new Vector3(...center));
  }

  /** Of every hinged body its place, from O along main-body axes, at these joint coordinates. */
  places(beta) {
    const places = [];
    const joint = new Matrix4();
    this.scene.bodies.forEach(({ inboard, slides }, i) => {
      const axis = this.axes[i];
      if (slides) joint.makeTranslation(axis.x * beta[i], axis.y * beta[i], axis.z * beta[i]);
      else joint.makeRotationAxis(axis, beta[i]);
      const place = new Matrix4().multiplyMatrices(this.mounts[i], joint);
      places.push(inboard < 0 ? place : place.premultiply(places[inboard]));
    });
    return places;
  }

  /** The mass centre of all bodies, from O along main-body axes. */
  massCenter(places) {
    const { main_body: main, bodies } = this.scene;
    const sum = new Vector3(...main.center).multiplyScalar(main.mass);
    let mass = main.mass;
    bodies.forEach((body, i) => {
      sum.addScaledVector(this.centers[i].clone().applyMatrix4(places[i]), body.mass);
      mass += body.mass;
    });
    return sum.divideScalar(mass);
  }

  /** What stands still in a picture, along main-body axes: the mass centre, of a main body that is held O. */
  middle(places) {
    return this.scene.main_body.is_held ? new Vector3() : this.massCenter(places);
  }
}

/** From main-body axes to inertial ones about a point given along the former. */
export function inertial(attitude, point) {
  const turned = point.clone().applyQuaternion(attitude).negate();
  return new Matrix4().compose(turned, new Quaternion().copy(attitude), new Vector3(1, 1, 1));
}
