// SPDX-License-Identifier: Apache-2.0
// What is drawn beside the surface: instruments, lines, balls and translucent triangles.
import { BufferGeometry, DoubleSide, GLSL3, GreaterDepth, InstancedBufferGeometry, LessEqualDepth, Mesh, RawShaderMaterial } from 'three';
import { ballShader, lineShader, rimShader, solidShader, triangleShader } from './glsl.mjs';
import { putRows } from './rows.mjs';

const LINE = [['from', 3], ['to', 3], ['width', 1], ['traits_of', 3]];
const RIM = [['before', 3], ['from', 3], ['to', 3], ['after', 3]];
const BALL = [['centre', 3], ['radius', 1], ['traits_of', 2]];
const CORNER = [['at', 3], ['opacity', 1], ['style', 1]];
const SOLID = [['position', 3], ['normal', 3], ['finish', 4], ['gloss', 1]];

function material(shader, uniforms, options = {}) {
  return new RawShaderMaterial({ glslVersion: GLSL3, ...shader, uniforms, side: DoubleSide, depthFunc: LessEqualDepth, ...options });
}

/** A square per row. */
function squares() {
  const geometry = new InstancedBufferGeometry();
  geometry.setIndex([0, 1, 2, 2, 1, 3]);
  return geometry;
}

export class Marks {
  #lines = squares();
  #rims = squares();
  #balls = squares();
  #triangles = new BufferGeometry();
  #solids = new BufferGeometry();
  #meshes = {};

  /** In the order of the window: solids with the body, ghosts, triangles, rims, lines, balls. */
  constructor(scene, shaders, uniforms) {
    const sheer = { transparent: true, depthWrite: false };
    const whole = { ...uniforms, is_core: { value: false } }, core = { ...uniforms, is_core: { value: true } };
    const isBehind = { value: true }, isBefore = { value: false };
    const lines = lineShader(shaders.lines), rims = rimShader(shaders.rims), solids = solidShader(shaders.solids);
    const add = (name, geometry, made, renderOrder) => {
      const mesh = new Mesh(geometry, made);
      mesh.frustumCulled = false;
      mesh.renderOrder = renderOrder;
      scene.add(mesh);
      this.#meshes[name] = mesh;
    };
    add('solids', this.#solids, material(solids, uniforms), 0);
    this.ghosts = new BufferGeometry();
    add('ghostDepths', this.ghosts, material(solids, uniforms, { colorWrite: false, transparent: true }), 3);
    add('ghosts', this.ghosts, material(solids, uniforms, { transparent: true }), 4);
    add('triangles', this.#triangles, material(triangleShader(shaders.triangles), uniforms, sheer), 5);
    add('rims', this.#rims, material(rims, whole, sheer), 6);
    add('rimCores', this.#rims, material(rims, core, { transparent: true }), 7);
    add('hidden', this.#lines, material(lines, { ...whole, is_behind: isBehind }, { ...sheer, depthFunc: GreaterDepth }), 8);
    add('lines', this.#lines, material(lines, { ...whole, is_behind: isBefore }, sheer), 9);
    add('lineCores', this.#lines, material(lines, { ...core, is_behind: isBefore }, { transparent: true }), 10);
    add('balls', this.#balls, material(ballShader(shaders.balls), uniforms, { transparent: true }), 11);
  }

  take({ lines, rims, balls, triangles, solids, solidCornersBeforeGhosts }) {
    this.#rows(['lines', 'lineCores', 'hidden'], this.#lines, lines, LINE);
    this.#rows(['rims', 'rimCores'], this.#rims, rims, RIM);
    this.#rows(['balls'], this.#balls, balls, BALL);
    this.#corners(['triangles'], this.#triangles, triangles, CORNER);
    const width = 11, ghosts = solidCornersBeforeGhosts * width;
    this.#corners(['solids'], this.#solids, solids.subarray(0, ghosts), SOLID);
    this.#corners(['ghosts', 'ghostDepths'], this.ghosts, solids.subarray(ghosts), SOLID);
  }

  #show(names, isShown) {
    for (const name of names) this.#meshes[name].visible = isShown;
    return isShown;
  }
  #rows(names, geometry, array, layout) {
    if (this.#show(names, array.length > 0)) geometry.instanceCount = putRows(geometry, array, layout, true);
  }
  #corners(names, geometry, array, layout) {
    if (this.#show(names, array.length > 0)) geometry.setDrawRange(0, putRows(geometry, array, layout, false));
  }
}
