// SPDX-License-Identifier: Apache-2.0
// Draws frames with three.js: the surface by the window's own shaders, marks as lines, discs and triangles.
import {
  BufferAttribute, BufferGeometry, Color, DataTexture, DoubleSide, DynamicDrawUsage, GLSL3, InstancedBufferAttribute,
  InstancedBufferGeometry, IntType, Matrix4, Mesh, NearestFilter, PerspectiveCamera, RawShaderMaterial, Scene, Vector2,
  WebGLRenderer,
} from 'three';

const HEAD = 'precision highp float;\nprecision highp int;\nprecision highp sampler2D;\n';

/** WebGL has no texture buffers: what a triangle is comes with its corners. A shader that differs is not guessed at. */
function replaced(text, pairs) {
  for (const [from, to] of pairs) {
    if (!text.includes(from)) throw new Error(`the window's shader has no "${from}" any more; see web/src/picture.mjs`);
    text = text.replace(from, to);
  }
  return text;
}

const LINE_VERTEX = `${HEAD}
in vec3 position, start, end, ink;
in float width;
uniform mat4 to_view, to_clip;
uniform vec2 size;
out vec3 tint;
void main() {
  vec4 a = to_clip * to_view * vec4(start, 1), b = to_clip * to_view * vec4(end, 1);
  vec2 way = (b.xy / b.w - a.xy / a.w) * size;
  float span = length(way);
  vec2 across = span > 0.0 ? vec2(-way.y, way.x) / span : vec2(0, 1);
  vec4 p = position.x < 0.5 ? a : b;
  p.xy += across * position.y * width / size * p.w;
  p.z -= 4e-4 * p.w;
  tint = ink;
  gl_Position = p;
}`;
const BALL_VERTEX = `${HEAD}
in vec3 position, start, ink;
in float width;
uniform mat4 to_view, to_clip;
uniform vec2 size;
out vec3 tint;
out vec2 place;
void main() {
  vec4 p = to_clip * to_view * vec4(start, 1);
  // Radii below 0 are in the body's length unit.
  if (width < 0.0) {
    p += to_clip * vec4(-width * position.xy, 0, 0);
  } else {
    p.xy += 2.0 * position.xy * width / size * p.w;
  }
  p.z -= 4e-4 * p.w;
  tint = ink;
  place = position.xy;
  gl_Position = p;
}`;
const PLAIN_FRAGMENT = `${HEAD}
in vec3 tint;
out vec4 color;
void main() { color = vec4(tint, 1); }`;
const BALL_FRAGMENT = `${HEAD}
in vec3 tint;
in vec2 place;
out vec4 color;
void main() {
  float r = length(place);
  if (r > 1.0) discard;
  color = vec4(r > 0.72 ? tint * 0.25 : tint, 1);
}`;
const FILL_VERTEX = `${HEAD}
in vec3 position;
in vec4 ink;
uniform mat4 to_view, to_clip;
out vec4 tint;
void main() {
  tint = ink;
  gl_Position = to_clip * to_view * vec4(position, 1);
}`;
const FILL_FRAGMENT = `${HEAD}
in vec4 tint;
out vec4 color;
void main() { color = tint; }`;

/** An attribute that holds the array: the old one where it fits, so that buffers are not made anew every frame. */
function put(geometry, name, array, width, Kind = BufferAttribute) {
  const old = geometry.getAttribute(name);
  if (old && old.array.length >= array.length && old.array.length <= 4 * array.length + 4096) {
    old.array.set(array);
    old.clearUpdateRanges();
    old.addUpdateRange(0, array.length);
    old.needsUpdate = true;
    return;
  }
  const room = new array.constructor(Math.ceil((1.5 * array.length) / width + 16) * width);
  room.set(array);
  const attribute = new Kind(room, width);
  attribute.setUsage(DynamicDrawUsage);
  if (array instanceof Uint8Array) attribute.gpuType = IntType;
  geometry.setAttribute(name, attribute);
}

/** Lines or discs of one kind: a small shape, drawn once per row. */
class Rows {
  constructor(shape, vertexShader, fragmentShader, uniforms, depthTest) {
    this.geometry = new InstancedBufferGeometry();
    this.geometry.setAttribute('position', new BufferAttribute(Float32Array.from(shape), 3));
    this.geometry.setIndex([0, 1, 2, 2, 1, 3]);
    this.geometry.instanceCount = 0;
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader, fragmentShader, uniforms, side: DoubleSide, depthTest, depthWrite: depthTest,
    });
    this.mesh = new Mesh(this.geometry, material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = depthTest ? 1 : 3;
    this.rows = { start: [], end: [], ink: [], width: [] };
  }
  clear() {
    for (const column of Object.values(this.rows)) column.length = 0;
  }
  flush() {
    const { start, end, ink, width } = this.rows;
    this.geometry.instanceCount = width.length;
    this.mesh.visible = width.length > 0;
    if (!this.mesh.visible) return;
    put(this.geometry, 'start', Float32Array.from(start), 3, InstancedBufferAttribute);
    if (end.length > 0) put(this.geometry, 'end', Float32Array.from(end), 3, InstancedBufferAttribute);
    put(this.geometry, 'ink', Float32Array.from(ink), 3, InstancedBufferAttribute);
    put(this.geometry, 'width', Float32Array.from(width), 1, InstancedBufferAttribute);
  }
}

export class Picture {
  constructor(canvas, look) {
    // Screenshots are read after drawing, so the picture has to stay.
    this.renderer = new WebGLRenderer({ canvas, antialias: true, preserveDrawingBuffer: true, powerPreference: 'high-performance' });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera();
    this.uniforms = {
      to_view: { value: new Matrix4() }, to_clip: { value: new Matrix4() }, size: { value: new Vector2(1, 1) },
      palette: { value: null }, color_by: { value: 0 }, only: { value: 0 }, shows_newest: { value: true },
      is_flat_light: { value: false }, opacity: { value: 1 }, rim: { value: 0 }, lone_wire: { value: new Color(-1, 0, 0) },
    };
    this.makeSurface(look);
    const line = [0, -1, 0, 0, 1, 0, 1, -1, 0, 1, 1, 0], disc = [-1, -1, 0, -1, 1, 0, 1, -1, 0, 1, 1, 0];
    const rows = (shape, vertex, fragment, depthTest) => new Rows(shape, vertex, fragment, this.uniforms, depthTest);
    this.lines = [rows(line, LINE_VERTEX, PLAIN_FRAGMENT, true), rows(line, LINE_VERTEX, PLAIN_FRAGMENT, false)];
    this.balls = rows(disc, BALL_VERTEX, BALL_FRAGMENT, false);
    this.makeFills();
    this.scene.add(...this.lines.map((each) => each.mesh), this.balls.mesh);
    this.setLook(look);
  }

  makeSurface(look) {
    this.geometry = new BufferGeometry();
    const vertexShader = HEAD + replaced(look.vertexShader, [
      ['void main() {', 'in uvec4 look;\nflat out uvec4 look_here;\nvoid main() {\n  look_here = look;'],
    ]);
    const fragmentShader = HEAD + replaced(look.fragmentShader, [
      // The page has no noise and no rest positions yet: skin and walls are plain.
      ['uniform sampler3D noise;  // repeats', ''],
      ['return 0.65 * texture(noise, at).r + 0.35 * texture(noise, 3.7 * at + 0.31).r;', 'return 0.5;'],
      ['texture(noise, place.xyz * vec3(0.6, 4.0, 4.0)).r', '0.5'],
      ['texture(noise, place.xyz * 9.0).r', '0.5'],
      ['uniform usamplerBuffer looks;', 'flat in uvec4 look_here;'],
      ['texelFetch(looks, gl_PrimitiveID)', 'look_here'],
    ]);
    const material = new RawShaderMaterial({ glslVersion: GLSL3, vertexShader, fragmentShader, uniforms: this.uniforms, side: DoubleSide });
    const mesh = new Mesh(this.geometry, material);
    mesh.frustumCulled = false;
    this.scene.add(mesh);
  }

  makeFills() {
    this.fills = new BufferGeometry();
    const material = new RawShaderMaterial({
      glslVersion: GLSL3, vertexShader: FILL_VERTEX, fragmentShader: FILL_FRAGMENT, uniforms: this.uniforms,
      side: DoubleSide, transparent: true, depthWrite: false,
    });
    this.fillMesh = new Mesh(this.fills, material);
    this.fillMesh.frustumCulled = false;
    this.fillMesh.renderOrder = 2;
    this.scene.add(this.fillMesh);
  }

  /** Colours of a theme. */
  setLook(look) {
    this.inks = look.inks;
    const palette = new DataTexture(look.palette, 256, 2);
    palette.minFilter = palette.magFilter = NearestFilter;
    palette.needsUpdate = true;
    this.uniforms.palette.value?.dispose();
    this.uniforms.palette.value = palette;
    this.uniforms.rim.value = look.rim;
    this.renderer.setClearColor(0, 0); // the page's ground is seen behind the body
    this.needsDraw = true;
  }

  /** 0 tissue, 1 regions, 2 strokes, 3 quality. */
  setColorBy(number) {
    this.uniforms.color_by.value = number;
    this.uniforms.is_flat_light.value = number !== 0;
    this.needsDraw = true;
  }

  resize(width, height) {
    this.renderer.setPixelRatio(Math.min(devicePixelRatio, 2));
    this.renderer.setSize(width, height, false);
    this.uniforms.size.value.set(width, height);
    this.needsDraw = true;
  }

  take({ surface, marks, camera }) {
    this.uniforms.to_view.value.fromArray(camera.view);
    this.uniforms.to_clip.value.fromArray(camera.clip);
    if (surface) {
      put(this.geometry, 'position', surface.positions, 3);
      put(this.geometry, 'normal', surface.normals, 3);
      if (surface.looks) put(this.geometry, 'look', surface.looks, 4);
      this.geometry.setDrawRange(0, surface.positions.length / 3);
    }
    this.takeMarks(marks);
    this.needsDraw = true;
  }

  takeMarks({ lines, balls, triangles }) {
    for (const each of [...this.lines, this.balls]) each.clear();
    for (let i = 0; i < lines.length; i += 9) {
      const { rows } = this.lines[lines[i + 8] > 0 ? 1 : 0];
      rows.start.push(lines[i], lines[i + 1], lines[i + 2]);
      rows.end.push(lines[i + 3], lines[i + 4], lines[i + 5]);
      rows.ink.push(...this.inks[lines[i + 6]]);
      rows.width.push(lines[i + 7]);
    }
    for (let i = 0; i < balls.length; i += 6) {
      const { rows } = this.balls;
      rows.start.push(balls[i], balls[i + 1], balls[i + 2]);
      rows.ink.push(...this.inks[balls[i + 3]]);
      rows.width.push(balls[i + 5] > 0 ? balls[i + 4] : -balls[i + 4]);
    }
    for (const each of [...this.lines, this.balls]) each.flush();
    this.takeFills(triangles);
  }

  takeFills(triangles) {
    const places = [], inks = [];
    for (let i = 0; i < triangles.length; i += 11) {
      for (let corner = 0; corner < 9; corner += 3) {
        places.push(triangles[i + corner], triangles[i + corner + 1], triangles[i + corner + 2]);
        inks.push(...this.inks[triangles[i + 9]], triangles[i + 10]);
      }
    }
    this.fillMesh.visible = places.length > 0;
    if (!this.fillMesh.visible) return;
    put(this.fills, 'position', Float32Array.from(places), 3);
    put(this.fills, 'ink', Float32Array.from(inks), 4);
    this.fills.setDrawRange(0, places.length / 3);
  }

  draw() {
    this.needsDraw = false;
    this.renderer.render(this.scene, this.camera);
  }
}
