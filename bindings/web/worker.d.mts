// SPDX-License-Identifier: Apache-2.0
// Types of `incise/worker`: a session that runs in a Worker at the pace of the clock, so that the page never waits for it.
/// <reference lib="dom" />
import type { Bytes, CameraMatrices, ColorName, Figures, Look, Marks, PointerKind, PointerOptions, QualityFigures, Surface, ToolName } from 'incise';

/** What is opened: a mesh, a scene or a recording; see `Session.open`. */
export interface Opening {
  bytes: Bytes;
  name: string;
  files?: Record<string, Bytes>;
  up?: readonly [number, number, number];
  /** The bytes are a recording: go on from its end instead of playing it. */
  resumes?: boolean;
  /** The body is at rest: nothing is simulated until a hand comes. */
  isAtRest?: boolean;
  /** A recording is played as fast as it goes, and its end is what is seen first. */
  isStill?: boolean;
}

/** One picture's worth of a session. The arrays are the page's own. */
export interface Frame {
  camera: CameraMatrices;
  figures: Figures & { rate: number; longestFrameMs: number };
  isReplay: boolean;
  /** False where the body is at rest: nothing is simulated until a hand comes. */
  isAwake: boolean;
  place?: { call: number; calls: number };
  /** The place of `Session.color` in `Incise.colors`. */
  color: number;
  marks: Marks;
  /** Where it has changed; all but the first two where the triangles have. */
  surface?: Pick<Surface, 'positions' | 'normals'> & Partial<Omit<Surface, 'positions' | 'normals'>>;
}

/** What may be asked, with what, and what the answer is. Answers that fail reject with an Error that has a `code`. */
export interface Questions {
  open: [Opening, { title: string; tets: number; isReplay: boolean }];
  undo: [void, boolean];
  redo: [void, boolean];
  reset: [void, void];
  cancel: [void, boolean];
  takeOver: [void, boolean];
  /** Shows all of the body. */
  frameBody: [void, void];
  tool: [{ name: ToolName }, void];
  /** The scalpel's depth as a share of the body's shortest side, in [0.01, 2]. */
  depth: [{ share: number }, void];
  /** Of the whole state: sixteen hexadecimal digits. */
  hash: [void, string];
  quality: [void, { now: QualityFigures; before: QualityFigures; pieces: number; log: string[] }];
  recording: [void, Uint8Array];
  write: [{ extension: string }, Uint8Array];
  look: [{ theme: 'light' | 'dark' }, Look];
  /** 'scene': the one that the scene was opened with. */
  color: [{ name: ColorName | 'scene' }, void];
  /** Whether the last `kept` has all that was done. */
  isKept: [void, boolean];
  /** See `Incise.memory`. */
  memory: [void, { used: number; taken: number }];
  /** Pointer events of the time since the last ones: they are spread over the frames until the next. */
  events: [[PointerKind, number, number, PointerOptions?][], void];
  /** Width, height, and the height that controls leave free, in pixels of the page. */
  resize: [readonly [number, number, number], void];
}

export type Message =
  /** Asks for the next frame that differs from the last one shown; `isWhole`: with all of its surface, in any case. */
  | { type: 'want'; isWhole?: boolean }
  /** Whether the page is seen; nothing is simulated while it is not. */
  | { type: 'shown'; isShown: boolean };

/**
 * Starts the worker. Events, each with its data as `detail`: `loaded` {version, look}; `warm`, when a session is opened without waiting (what is asked before is answered then);
 * `frame` (a `Frame`); `replayed` {verdict, hash}, at a recording's end; `kept` {recording, isAtRest}, from which `open` with `resumes` goes on
 * in another worker; `failed` {error}, after which the session goes on; `broken` {error}, once, with the code `BadFile` where the module could not be fetched: the worker is gone, and whatever waits for an
 * answer is rejected. Where the page is served securely that is told at once, however the worker ended.
 */
export declare class SessionWorker extends EventTarget {
  constructor();
  ask<Q extends keyof Questions>(what: Q, ...data: Questions[Q][0] extends void ? [] : [Questions[Q][0]]): Promise<Questions[Q][1]>;
  send(message: Message): void;
  /** How many questions wait for their answers. */
  readonly waiting: number;
  /** Ends the worker. What waits for an answer is rejected. */
  end(): void;
}
