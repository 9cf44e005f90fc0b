// SPDX-License-Identifier: Apache-2.0
// Types of `incise/worker`: a session that runs in a Worker at the pace of the clock, so that the page never waits for it.
import type { Bytes, CameraMatrices, Figures, Look, Marks, PointerKind, PointerOptions, QualityFigures, Surface, ToolName } from 'incise';

/** What is opened: a mesh, a scene or a recording; see `Session.open`. */
export interface Opening {
  bytes: Bytes;
  name: string;
  files?: Record<string, Bytes>;
  up?: readonly [number, number, number];
}

/** One picture's worth of a session. The arrays are the page's own. */
export interface Frame {
  camera: CameraMatrices;
  figures: Figures & { rate: number; longestFrameMs: number };
  isReplay: boolean;
  /** False where the body is at rest: nothing is simulated until a hand comes. */
  isAwake: boolean;
  place?: { call: number; calls: number };
  marks: Pick<Marks, 'lines' | 'balls' | 'triangles'>;
  /** Where it has changed; `looks` where the triangles have. */
  surface?: Omit<Surface, 'looks'> & { looks?: Surface['looks'] };
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
}

export type Message =
  /** Pointer events of the time since the last ones: they are spread over the frames until the next. */
  | { type: 'events'; events: [PointerKind, number, number, PointerOptions?][] }
  /** Asks for the next frame that differs from the last one shown. */
  | { type: 'want' }
  /** Whether the page is seen; nothing is simulated while it is not. */
  | { type: 'shown'; isShown: boolean }
  /** Width, height, and the height that controls leave free, in pixels of the page. */
  | { type: 'resize'; size: readonly [number, number, number] };

/**
 * Starts the worker. Events, each with its data as `detail`: `loaded` {version, look}; `warm`, when a session may be opened;
 * `frame` (a `Frame`); `replayed` {verdict, hash}, at a recording's end; `failed` {error}, after which the session goes on;
 * `broken` {error}, after which it does not.
 */
export declare class SessionWorker extends EventTarget {
  constructor();
  ask<Q extends keyof Questions>(what: Q, ...data: Questions[Q][0] extends void ? [] : [Questions[Q][0]]): Promise<Questions[Q][1]>;
  send(message: Message): void;
  /** Ends the worker. What waits for an answer is rejected. */
  end(): void;
}
