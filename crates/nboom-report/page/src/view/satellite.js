// The satellite in three dimensions, at one time.

import {
  AmbientLight, Color, DirectionalLight, Group, Matrix4, PerspectiveCamera, Quaternion, Scene, Vector3, WebGLRenderer,
} from 'three';
import { OrbitControls } from 'three/examples/jsm/controls/OrbitControls.js';
import { inertial, Tree } from '../pose.js';
import { Momentum, centre, jointAxis, triad } from './marks.js';
import { paint, paintAlong, solid } from './shapes.js';
import { StressColours, colour } from './stress_colours.js';
import { Trails, outerEnd } from './trails.js';

/** What may be shown or hidden, with its name and whether it is there at first. */
export const LAYERS = [
  ['axes', 'Body axes', true],
  ['joints', 'Joint axes', true],
  ['centre', 'Mass centre', true],
  ['momentum', 'Momentum and nutation', true],
  ['trails', 'Trails of tips', false],
  ['stress', 'Stress', true],
];

/** Looks from here at first, along axes of which the third is up. */
const EYE = new Vector3(0.75, -1.15, 0.62).normalize();

/** Room around the satellite. */
const MARGIN = 1.1;

/** Times at which room for the satellite is measured. */
const LOOKS = 60;

export class Satellite {
  constructor(run, motion, canvas, colours) {
    Object.assign(this, { run, motion, canvas });
    this.tree = new Tree(run.scene);
    this.riding = false;
    this.layers = Object.fromEntries(LAYERS.map(([key, , on]) => [key, on]));
    this.stress = run.stress && run.stress.rows > 0 ? new StressColours(run) : null;
    this.renderer = new WebGLRenderer({ canvas, antialias: true, alpha: true, preserveDrawingBuffer: true });
    this.camera = new PerspectiveCamera(32, 1, 0.01, 1000);
    this.controls = new OrbitControls(this.camera, canvas);
    this.controls.addEventListener('change', () => this.draw());
    this.measure();
    this.build(colours);
    this.look();
  }

  /** The extent of the satellite over the whole motion, and which way is up. */
  measure() {
    const far = this.outline().reduce((most, point) => Math.max(most, point.length()), 0);
    this.size = 2 * (far || 1);
    const { momentum, attitude } = this.motion.at(this.run.span[0]);
    const body = momentum.clone().applyQuaternion(attitude.clone().invert());
    const parts = body.toArray().map(Math.abs);
    const largest = parts.indexOf(Math.max(...parts));
    // About the axis of a spin; the third axis where there is none.
    const spins = this.motion.hasMomentum && parts[largest] > 0.8 * momentum.length();
    this.upOfBody = new Vector3().setComponent(spins ? largest : 2, spins ? Math.sign(body.getComponent(largest)) : 1);
    this.upInertial = spins ? momentum.clone().normalize() : this.upOfBody.clone().applyQuaternion(attitude);
  }

  /** Points that the picture has room for at all times, from its middle, along the axes of the view. */
  outline() {
    const [from, to] = this.run.span;
    const points = [];
    for (let k = 0; k <= LOOKS; k++) {
      const { beta, attitude } = this.motion.at(from + ((to - from) * k) / LOOKS);
      const places = this.tree.places(beta);
      const frame = this.frame(attitude, this.tree.middle(places));
      places.forEach((place, i) => {
        const ends = [new Vector3(), outerEnd(this.run.scene, i)];
        points.push(...ends.map((end) => end.applyMatrix4(place).applyMatrix4(frame)));
      });
      points.push(...corners(this.run.scene.main_body.shape).map((corner) => corner.applyMatrix4(frame)));
    }
    return points;
  }

  /** From main-body axes to the axes of the view, about the middle of the picture. */
  frame(attitude, middle) {
    return this.riding ? new Matrix4().makeTranslation(middle.clone().negate()) : inertial(attitude, middle);
  }

  build(colours) {
    this.colours = colours;
    this.world?.traverse((part) => { part.geometry?.dispose(); part.material?.dispose(); });
    this.world = new Scene();
    this.root = new Group();
    this.root.matrixAutoUpdate = false;
    const { bodies, main_body: main } = this.run.scene;
    const onMain = bodies.filter(({ inboard }) => inboard < 0);
    this.solids = [solid(main, onMain, this.size, colours, true)];
    this.groups = bodies.map((body, i) => {
      const group = new Group();
      group.matrixAutoUpdate = false;
      const made = solid(body, bodies.filter(({ inboard }) => inboard === i), this.size, colours, false);
      const axis = jointAxis(body, this.size, colours.joint);
      group.add(made, axis);
      group.userData = { made, axis };
      this.solids.push(made);
      return group;
    });
    this.triad = triad(this.size, colours);
    this.root.add(this.solids[0], this.triad, ...this.groups);
    this.centre = centre(this.size, colours.centre);
    this.momentum = new Momentum(this.size, colours);
    this.lights();
    this.world.add(this.root, this.centre, this.momentum.group);
    this.solids.forEach(({ userData }, i) => paint(userData, new Color(i === 0 ? colours.main : colours.body)));
    this.trails?.dispose();
    this.trails = null;
  }

  lights() {
    const sun = new DirectionalLight('#ffffff', 2.1);
    sun.position.set(0.4, 0.8, 1);
    this.camera.clear();
    this.camera.add(sun);
    this.world.add(new AmbientLight('#ffffff', 1.25), this.camera);
  }

  /** Puts the camera where all of the motion is seen. */
  look() {
    const { camera } = this;
    const up = this.riding ? this.upOfBody : this.upInertial;
    const turn = new Quaternion().setFromUnitVectors(new Vector3(0, 0, 1), up);
    const back = EYE.clone().applyQuaternion(turn);
    const right = up.clone().cross(back).normalize();
    const above = back.clone().cross(right);
    const half = Math.tan((camera.fov * Math.PI) / 360);
    const points = this.outline();
    if (this.motion.hasMomentum) points.push(up.clone().multiplyScalar(0.5 * this.size));
    const needed = points.map((point) => point.dot(back)
      + Math.max(Math.abs(point.dot(right)) / (half * (camera.aspect || 1)), Math.abs(point.dot(above)) / half));
    const distance = MARGIN * Math.max(...needed, 0.1 * this.size);
    camera.up.copy(up);
    [camera.near, camera.far] = [distance / 100, distance * 10];
    camera.position.copy(back).multiplyScalar(distance);
    this.controls.target.set(0, 0, 0);
    camera.updateProjectionMatrix();
    this.controls.update();
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.camera.aspect = width / height;
    this.camera.updateProjectionMatrix();
    this.draw();
  }

  /** Shows the motion at a time, and returns it. */
  show(time) {
    const now = this.motion.at(time);
    const places = this.tree.places(now.beta);
    const middle = this.tree.middle(places);
    this.groups.forEach((group, i) => group.matrix.copy(places[i]));
    this.root.matrix.copy(this.frame(now.attitude, middle));
    this.centre.position.copy(this.tree.massCenter(places)).applyMatrix4(this.root.matrix);
    this.momentum.group.position.copy(this.centre.position);
    this.root.matrixWorldNeedsUpdate = true;
    const back = now.attitude.clone().invert();
    const momentum = this.riding ? now.momentum.clone().applyQuaternion(back) : now.momentum;
    const spin = new Vector3().setComponent(this.motion.spinAxis, 1);
    this.momentum.show(momentum, now.nutation, this.riding ? spin : spin.applyQuaternion(now.attitude));
    this.showLayers(time, middle);
    this.draw();
    return now;
  }

  showLayers(time, middle) {
    const { axes, joints, centre: point, momentum, trails, stress } = this.layers;
    this.triad.visible = axes;
    this.groups.forEach((group) => { group.userData.axis.visible = joints; });
    this.centre.visible = point;
    this.momentum.group.visible &&= momentum && this.motion.hasMomentum;
    if (trails && !this.trails) {
      this.trails = new Trails(this.motion, this.tree, this.riding, this.colours.trail);
      this.world.add(this.trails.group);
    }
    if (this.trails) {
      this.trails.group.visible = trails;
      if (this.riding) this.trails.group.position.copy(middle).negate();
      this.trails.show(time);
    }
    if (this.stress) this.paintStress(stress, time);
  }

  paintStress(isShown, time) {
    if (!isShown && !this.stressShown) return;
    this.stressShown = isShown;
    this.groups.forEach(({ userData: { made } }, i) => {
      const along = isShown ? this.stress.along(i, time) : null;
      if (along) paintAlong(made.userData, (place) => colour(along(place) / this.stress.largest));
      else paint(made.userData, new Color(this.colours.body));
    });
  }

  /** Looks from inertial space, or rides on the main body. */
  ride(riding) {
    this.riding = riding;
    if (this.trails) this.world.remove(this.trails.group);
    this.trails?.dispose();
    this.trails = null;
    this.look();
  }

  draw() {
    this.renderer.render(this.world, this.camera);
  }
}

/** Corners of a shape, or of the box around it. */
function corners(shape) {
  if (!shape) return [];
  const { sides, radius, length, middle } = shape;
  const half = sides ? sides.map((side) => side / 2) : [0, 1, 2].map(() => Math.max(radius, length / 2));
  const signs = [-1, 1];
  return signs.flatMap((x) => signs.flatMap((y) => signs.map((z) =>
    new Vector3(middle[0] + x * half[0], middle[1] + y * half[1], middle[2] + z * half[2]))));
}
