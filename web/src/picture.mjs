// SPDX-License-Identifier: Apache-2.0
// Draws frames with three.js, by the window's own shaders: ground, surface, instruments, marks.
import {
  BufferGeometry, Color, Data3DTexture, DataTexture, DoubleSide, GLSL3, LinearFilter, Matrix4, Mesh, NearestFilter,
  PerspectiveCamera, RawShaderMaterial, RedFormat, RepeatWrapping, Scene, Vector2, WebGLRenderer,
} from 'three';
import { LEVELS } from './detail.mjs';
import { GROUND, surfaceShader } from './glsl.mjs';
import { Marks } from './marks.mjs';
import { put } from './rows.mjs';

const TISSUE = 0; // of `Frame.color`
const AFTER_SOLIDS = 1; // of the order in which things are drawn; see marks.mjs
const RATIOS = { full: 2, plain: 1, coarse: 0.6 }; // pixels of the picture in one of the page, at most

/** What a picture is drawn with; null where the browser has no WebGL 2. */
export const contextOf = (canvas, antialias) => canvas.getContext('webgl2', { antialias, alpha: false, powerPreference: 'high-performance' });

export class Picture {
  /** @param context  of WebGL 2, as `contextOf` makes it */
  constructor(canvas, context, look) {
    this.renderer = new WebGLRenderer({ canvas, context });
    this.scene = new Scene();
    this.camera = new PerspectiveCamera();
    this.level = LEVELS[0];
    this.size = [1, 1];
    const value = (first) => ({ value: first });
    this.uniforms = {
      to_view: value(new Matrix4()), to_clip: value(new Matrix4()), palette: value(null), noise: value(makeNoise(look)),
      color_by: value(0), tissue_look: value(0), extent: value(1), red_from: value(look.redFrom), only: value(0),
      shows_newest: value(true), is_flat_light: value(false), opacity: value(1), rim: value(0), lone_wire: value(new Color(-1, 0, 0)),
      pixels: value(new Vector2(1, 1)), pixel_scale: value(1), inks: value([]), casings: value([]), shapes: value([]),
      top: value([0, 0, 0]), bottom: value([0, 0, 0]),
    };
    this.shaders = look.shaders;
    this.makeGround();
    this.makeSurface();
    this.marks = new Marks(this.scene, look.shaders, this.uniforms);
    this.setLook(look);
  }

  makeGround() {
    const geometry = new BufferGeometry();
    geometry.setIndex([0, 1, 2]);
    const material = new RawShaderMaterial({ glslVersion: GLSL3, ...GROUND, uniforms: this.uniforms, depthWrite: false });
    const mesh = new Mesh(geometry, material);
    mesh.frustumCulled = false;
    mesh.renderOrder = AFTER_SOLIDS; // where the body is no ground is drawn
    this.scene.add(mesh);
  }

  makeSurface() {
    this.geometry = new BufferGeometry();
    const material = (isPlain) => new RawShaderMaterial({
      glslVersion: GLSL3, ...surfaceShader(this.shaders.surface, isPlain), uniforms: this.uniforms, side: DoubleSide,
    });
    this.materials = { full: material(false), plain: material(true) };
    this.surface = new Mesh(this.geometry, this.materials.full);
    this.surface.frustumCulled = false;
    this.surface.visible = false;
    this.scene.add(this.surface);
  }

  /** One of `LEVELS`. */
  setLevel(level) {
    this.level = level;
    this.surface.material = level === 'full' ? this.materials.full : this.materials.plain;
    this.resize(...this.size, this.ratio);
  }

  /** Colours of a theme. */
  setLook(look) {
    const all = (what) => look.inks.flatMap((ink) => [...ink[what]]);
    this.uniforms.inks.value = all('color');
    this.uniforms.casings.value = all('casing');
    this.uniforms.shapes.value = all('shapes');
    this.uniforms.palette.value?.dispose();
    this.uniforms.palette.value = makePalette(look);
    this.uniforms.rim.value = look.rim;
    this.uniforms.top.value = [...look.top];
    this.uniforms.bottom.value = [...look.bottom];
  }

  resize(width, height, ratio = 1) {
    this.size = [width, height];
    this.ratio = ratio;
    this.renderer.setPixelRatio(Math.min(ratio, RATIOS[this.level]));
    this.renderer.setSize(width, height, false);
    this.uniforms.pixels.value.set(width, height);
  }

  take({ surface, marks, camera, color }) {
    const { to_view, to_clip, pixel_scale, color_by, is_flat_light, tissue_look, extent } = this.uniforms;
    to_view.value.fromArray(camera.view);
    to_clip.value.fromArray(camera.clip);
    pixel_scale.value = 2 / (camera.clip[5] * this.size[1]);
    color_by.value = color;
    is_flat_light.value = color !== TISSUE;
    if (surface) {
      put(this.geometry, 'position', surface.positions, 3);
      put(this.geometry, 'normal', surface.normals, 3);
      this.geometry.setDrawRange(0, surface.positions.length / 3);
      this.surface.visible = true;
    }
    if (surface?.looks) {
      put(this.geometry, 'look', surface.looks, 4);
      put(this.geometry, 'rest', surface.places, 4);
      tissue_look.value = surface.tissue;
      extent.value = surface.extent;
    }
    this.marks.take(marks);
  }

  draw() {
    this.renderer.render(this.scene, this.camera);
  }
}

function makeNoise({ noise, noiseSide }) {
  const texture = new Data3DTexture(noise, noiseSide, noiseSide, noiseSide);
  texture.format = RedFormat;
  texture.minFilter = texture.magFilter = LinearFilter;
  texture.wrapS = texture.wrapT = texture.wrapR = RepeatWrapping;
  texture.unpackAlignment = 1;
  texture.needsUpdate = true;
  return texture;
}

function makePalette({ palette }) {
  const texture = new DataTexture(palette, 256, 2);
  texture.minFilter = texture.magFilter = NearestFilter;
  texture.needsUpdate = true;
  return texture;
}
