// SPDX-License-Identifier: Apache-2.0
// Types of the package `incise`. Lengths are in the mesh's own unit, forces in N, times in s unless they say
// otherwise. Every call but `load` is synchronous and may take long on large meshes: run it in a Worker.

/// <reference lib="esnext.disposable" />

/** A kind of failure; see `InciseError.code`. */
export type ErrorCode = 'BadArgument' | 'BadFile' | 'Unsupported' | 'OutOfMemory' | 'Io' | 'Internal';

/**
 * What a call throws that cannot do what is asked. What it was called on stays as it was and usable, unless there is a
 * `cause`: memory was out, and the module has to be loaded anew.
 */
export declare class InciseError extends Error {
  constructor(message: string, code: ErrorCode, ids?: number[]);
  readonly name: 'InciseError';
  readonly code: ErrorCode;
  /** Offending elements, at most a few; the message says what they are. */
  readonly ids: number[];
  /** Where memory was out: what was thrown inside. */
  readonly cause?: unknown;
}

export type Vec3 = readonly [number, number, number];
/** A file's content; a string is taken as UTF-8. */
export type Bytes = string | ArrayBuffer | ArrayBufferView;

export interface LoadOptions {
  /** Where the `.wasm` file of this name is, seen from the page; by default beside this module. */
  locateFile?: (name: string) => string;
  /** The content of the `.wasm` file, for those who have it already; nothing is fetched then. */
  wasmBinary?: ArrayBuffer | ArrayBufferView;
  /** Which build: by default the one with SIMD, where the engine has it and WebAssembly's own exceptions (Chrome 95, Firefox 100, Safari 16.4). */
  simd?: boolean;
  /** Hears what the module prints; by default nobody. */
  print?: (line: string) => void;
}

/** What one stroke did. */
export interface StrokeReport {
  stroke: number;
  cutTets: number;
  createdTets: number;
  newVertices: number;
  snappedVertices: number;
}

/** L/r is a tet's longest edge over its inscribed radius: 4.9 for a regular one, infinite for a flat one. */
export interface Quality {
  lrMin: number;
  lrMean: number;
  lrMax: number;
  dihedralMinDeg: number;
  dihedralMaxDeg: number;
}

/** A mesh at rest that can be cut. */
export declare class Engine {
  private constructor();
  /**
   * Opens a tetrahedral mesh: MEDIT, Gmsh, VTK, TetGen, Vega or Abaqus. `name` is for messages and, where the bytes do
   * not tell, for its extension. Throws BadFile, naming the line. Cost: O(size).
   */
  static open(bytes: Bytes, name: string): Engine;
  readonly tetCount: number;
  readonly vertexCount: number;
  /** Face-connected pieces. Cost: O(tets). */
  readonly pieces: number;
  /** Sixteen hexadecimal digits: of connectivity, rest positions and tags; the same on every platform. */
  readonly hash: string;
  /** Cuts by the strokes of a blade file (docs/formats.md): an object, or its JSON. Cost: O(tets). */
  cut(blade: object | string): StrokeReport[];
  /** Cuts through all along normal·x = offset; the normal is of any length but zero. */
  cutPlane(normal: Vec3, offset: number): StrokeReport;
  /** Maintains the whole mesh. */
  improve(): void;
  /** Takes the last stroke back, bit for bit; false where there is none. */
  undo(): boolean;
  redo(): boolean;
  /** Three numbers per point, compact; a copy. */
  points(): Float64Array;
  /** Four points per tet; a copy. */
  tets(): Uint32Array;
  quality(): Quality;
  /** The bytes of a mesh file: ".mesh", ".msh", ".vtk", ".node", ".ele", ".veg" or ".inp". */
  write(extension: string): Uint8Array;
  /** Frees its memory. Later calls throw. */
  dispose(): void;
  [Symbol.dispose](): void;
}

export type ToolName = 'Orbit' | 'Scalpel' | 'Plane cut' | 'Forceps' | 'Pin' | 'Probe' | 'Hook' | 'Retractor' | 'Scissors' | 'Punch' | 'Suture' | 'Staple';
export type ColorName = 'tissue' | 'region' | 'stroke' | 'quality' | 'defects';
export type PointerKind = 'move' | 'press' | 'release' | 'wheel';

export interface PointerOptions {
  /** Of press and release. Right and middle drags turn the view. */
  button?: 'left' | 'right' | 'middle';
  /** With a left drag: grasp, whatever the tool. With a right one: move the view. */
  shift?: boolean;
  control?: boolean;
  /** With a left drag: turn the view. */
  alt?: boolean;
  /** Notches, positive away from the person. */
  wheel?: number;
  /** Of a pen, in [0, 1]: how much of its depth a scalpel goes in. */
  pressure?: number;
}

/** What is seen: three corners per triangle. Views of the module's memory: copy them before the next call. */
export interface Surface {
  /** Three numbers per corner. */
  positions: Float32Array;
  /** Three numbers per corner, of any length. */
  normals: Float32Array;
  /** Four bytes per corner: flags (1 wall of a cut, 2 of the newest stroke, 8 of a tet that is too small), stroke, region, quality. */
  looks: Uint8Array;
  /** Four numbers per corner: its place in the rest shape and its depth below the skin, in `extent`s; patterns stick to it. */
  places: Float32Array;
  /** Of the body at rest. */
  extent: number;
  /** What it is drawn as: 0 skin over fat and muscle, 1 liver, 2 vessel, 3 bone. */
  tissue: number;
}

/** Column by column, as WebGL takes them. */
export interface CameraMatrices {
  view: Float64Array;
  clip: Float64Array;
}

/** Views of the module's memory: copy them before the next call. An ink is a place in `Look.inks`. */
export interface Marks {
  /**
   * Ten numbers each: from, to, width in pixels, ink, depth (0 where it is, 1 seen through what is before it, 2 only behind a
   * surface), 1 where it is dashed.
   */
  lines: Float32Array;
  /** Stretches of the rims of wounds, twelve numbers each: the point before it, its two ends, the point after it; where a rim does not go on, an end again. */
  rims: Float32Array;
  /** Six numbers each: centre, radius, ink, 1 where the radius is in pixels. */
  balls: Float32Array;
  /** Five numbers for each corner of a triangle: place, opacity, ink. The furthest triangles come first. */
  triangles: Float32Array;
  /** Instruments: eleven numbers for each corner of a triangle: place, normal, red, green, blue, opacity, gloss. */
  solids: Float32Array;
  /** How many corners come before those that are seen through. */
  solidCornersBeforeGhosts: number;
}

export interface Figures {
  frames: number;
  seconds: number;
  /** What the last frame took, ms. */
  frameMs: number;
  /** What a frame simulates, s. */
  frameSeconds: number;
  tets: number;
  tetsAtStart: number;
  vertices: number;
  strokes: number;
  cutTets: number;
  /** On the blade in the last frame, N. */
  force: number;
  peakForce: number;
}

export interface QualityFigures {
  lrMin: number;
  lrMean: number;
  lrMax: number;
  lrOver200Pct: number;
  /** Tets by L/r, logarithmic from 2√6 to 200. */
  histogram: number[];
}

export interface SessionOptions {
  /** Files that a scene or a recording names, by name; those that it names in a folder go by the last part of their names. */
  files?: Record<string, Bytes> | null;
  /** Which way is up in a mesh without a scene; by default z. */
  up?: Vec3;
}

/** A body under hands: it moves, is cut and held by pointer events, and everything is recorded. */
export declare class Session {
  private constructor();
  /** Opens a mesh, a scene or a recording, told apart by what is in it. A scene's body is at rest when this returns. */
  static open(bytes: Bytes, name: string, options?: SessionOptions): Session;
  tool: ToolName;
  /** What the colours of the surface tell. */
  color: ColorName;
  /** Of the scalpel, as a share of the body's shortest side, in [0.01, 2]. */
  depth: number;
  /** A drag, or a cut by a plane, is under way. */
  readonly isBusy: boolean;
  readonly isReplay: boolean;
  /** Face-connected pieces. Cost: O(tets). */
  readonly pieces: number;
  readonly title: string;
  /** Sixteen hexadecimal digits: of the mesh and of the moving body, as recordings have them. */
  readonly hash: string;
  /** Of the mesh alone. */
  readonly meshHash: string;
  /** The picture's size in CSS pixels, above 0. Bodies are framed in `freeHeight` of it, around its middle. */
  resize(width: number, height: number, freeHeight?: number): void;
  /** A pointer event at a place of the picture, in CSS pixels from its upper left corner. */
  pointer(kind: PointerKind, x: number, y: number, options?: PointerOptions): void;
  /** Gives up a drag. Returns whether there was one. */
  cancel(): boolean;
  /** Looks at the whole body. */
  frameBody(): void;
  /** One frame: of the simulation, or the next call of a recording. */
  frame(): void;
  undo(): boolean;
  redo(): boolean;
  /** Back to the start. */
  reset(): void;
  /** How far a recording has been played. */
  place(): { call: number; calls: number };
  /** Plays a recording up to a call. */
  seek(call: number): void;
  /** Goes on by hand from where a recording stands. Returns whether the session is live now. */
  takeOver(): boolean;
  /** Brings `surface` up to date. Returns whether triangles came or went. */
  refresh(): boolean;
  surface(): Surface;
  marks(): Marks;
  /** As the last call of `marks` left it: what that shows is not cut off. */
  camera(): CameraMatrices;
  figures(): Figures;
  /** Of all tets at rest, now and before the first cut. */
  quality(): { now: QualityFigures; before: QualityFigures };
  /** What was done, a line each. */
  log(): string[];
  /** The recording so far: `open` and `incise replay` do the same again, bit for bit. */
  recording(): Uint8Array;
  /** The mesh at rest, as `Engine.write`. */
  write(extension: string): Uint8Array;
  dispose(): void;
  [Symbol.dispose](): void;
}

/** GLSL 3.30 without its version line. */
export interface Shader {
  vertex: string;
  fragment: string;
}

/** How marks of one kind look: numbers of patterns for lines, balls and triangles that the shaders know. */
export interface Ink {
  color: Vec3;
  casing: Vec3;
  shapes: Vec3;
}

/** How the window draws. Colours are sRGB in [0, 1]. */
export interface Look {
  shaders: Record<'surface' | 'solids' | 'lines' | 'rims' | 'balls' | 'triangles', Shader>;
  /** 256 × 2 RGBA: colours of labels, then of quality. */
  palette: Uint8Array;
  /** `noiseSide` cubed: the pattern of tissue. */
  noise: Uint8Array;
  noiseSide: number;
  /** The quality byte from which a tet is bad-shaped. */
  redFrom: number;
  inks: Ink[];
  top: Vec3;
  bottom: Vec3;
  rim: number;
}

export interface Incise {
  readonly version: string;
  readonly tools: readonly ToolName[];
  readonly colors: readonly ColorName[];
  /** Bytes of the module's memory: what objects hold, and what it has taken from the machine, which never shrinks. */
  memory(): { used: number; taken: number };
  look(theme: 'light' | 'dark'): Look;
  readonly Engine: typeof Engine;
  readonly Session: typeof Session;
}

/** Loads the module. Each call makes one of its own, with memory of its own. */
export declare function load(options?: LoadOptions): Promise<Incise>;

/** Whether this engine has WebAssembly's SIMD instructions. */
export declare function hasSimd(): boolean;
