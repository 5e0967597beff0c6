// Solids of bodies: those of the scene, else made from joints and stations.

import {
  BoxGeometry, BufferAttribute, CylinderGeometry, EdgesGeometry, Group, LineBasicMaterial, LineSegments,
  Matrix4, Mesh, MeshStandardMaterial, Quaternion, Vector3,
} from 'three';
import { rotation } from '../pose.js';

/** Pieces of a solid along each edge, so that colours can change along it. */
const PIECES = 24;

const Y = new Vector3(0, 1, 0);

/** The solid of a body as a group; `size` is the extent of the whole satellite. */
export function solid(body, children, size, colours, isMain) {
  const geometry = body.shape ? ofScene(body.shape, size) : isMain ? hub(body, children, size) : beam(body, children, size);
  geometry.setAttribute('color', new BufferAttribute(new Float32Array(3 * geometry.attributes.position.count), 3));
  const material = new MeshStandardMaterial({ vertexColors: true, roughness: 0.75, metalness: 0.05, flatShading: false });
  const mesh = new Mesh(geometry, material);
  const edges = new LineSegments(new EdgesGeometry(edgesOf(geometry), 30), new LineBasicMaterial({ color: colours.edge }));
  const group = new Group();
  group.add(mesh, edges);
  group.userData = { mesh, edges };
  return group;
}

/** Colours all of a solid. */
export function paint({ mesh }, colour) {
  const { color } = mesh.geometry.attributes;
  for (let i = 0; i < color.count; i++) color.setXYZ(i, colour.r, colour.g, colour.b);
  color.needsUpdate = true;
}

/** Colours a solid by a function of the distance along the body's second axis. */
export function paintAlong({ mesh }, colourAt) {
  const { color, position } = mesh.geometry.attributes;
  for (let i = 0; i < color.count; i++) {
    const { r, g, b } = colourAt(position.getY(i));
    color.setXYZ(i, r, g, b);
  }
  color.needsUpdate = true;
}

function edgesOf(geometry) {
  return geometry.userData.coarse ?? geometry;
}

function withEdges(geometry, coarse, matrix) {
  geometry.applyMatrix4(matrix);
  geometry.userData.coarse = coarse.applyMatrix4(matrix);
  return geometry;
}

function ofScene({ kind, sides, radius, length, along, middle, axes }, size) {
  const place = rotation(axes).setPosition(new Vector3(...middle));
  if (kind === 'cylinder') {
    const turn = new Quaternion().setFromUnitVectors(Y, new Vector3(...along).normalize());
    return cylinder(radius, length, place.multiply(new Matrix4().makeRotationFromQuaternion(turn)));
  }
  const [x, y, z] = sides.map((side) => Math.max(side, 0.004 * size));
  return withEdges(new BoxGeometry(x, y, z, 1, PIECES, 1), new BoxGeometry(x, y, z), place);
}

function cylinder(radius, length, place) {
  const round = new CylinderGeometry(radius, radius, length, 20, PIECES);
  return withEdges(round, new CylinderGeometry(radius, radius, length, 20, 1), place);
}

/** A box around O that reaches the joints on the main body. */
function hub(body, children, size) {
  const half = [0, 1, 2].map((axis) => Math.max(0, ...children.map(({ point }) => Math.abs(point[axis]))));
  const most = Math.max(...half, 0.06 * size);
  const sides = half.map((reach) => 2 * Math.max(reach, 0.35 * most));
  const geometry = new BoxGeometry(...sides, 1, PIECES, 1);
  return withEdges(geometry, new BoxGeometry(...sides), new Matrix4());
}

/** A rod from the joint to the outer end: the tip, else the farthest joint, else twice the mass centre. */
function beam(body, children, size) {
  const ends = [body.tip, ...children.map(({ point }) => point), body.center.map((x) => 2 * x)];
  const lengths = ends.map((end) => Math.hypot(...end));
  const found = lengths[0] > 0 ? 0 : lengths.indexOf(Math.max(...lengths));
  const end = new Vector3(...ends[found]);
  const stations = body.stations.length > 0 ? Math.max(...body.stations) : 0;
  const along = end.length() > 0 ? end.clone().normalize() : Y;
  const length = Math.max(end.length(), stations, 0.02 * size);
  const radius = Math.max(Math.min(body.radius ?? 0, 0.12 * length), 0.007 * size);
  const turn = new Quaternion().setFromUnitVectors(Y, along);
  const place = new Matrix4().compose(along.clone().multiplyScalar(length / 2), turn, new Vector3(1, 1, 1));
  return cylinder(radius, length, place);
}
