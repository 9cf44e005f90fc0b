// SPDX-License-Identifier: Apache-2.0
// Line drawings of 24 by 24 units.
const PATHS = {
  Orbit: 'M12 4a8 8 0 1 1-7.4 5M4 4v5h5M12 9v6M9 12h6',
  Scalpel: 'M3 21l9-9M12 12l6-8c2-2 4 0 2 3l-5 8zM12 12l3 3',
  'Plane cut': 'M4 20L20 4M4 11V4h7M13 20h7v-7',
  Forceps: 'M10 3c0 6-5 8-5 13M14 3c0 6 5 8 5 13M5 16l3 4M19 16l-3 4M10 3h4',
  Scissors: 'M6 4l11 13M18 4L7 17M5 17.5a2.5 2.5 0 1 0 .01 0M19 17.5a2.5 2.5 0 1 0 .01 0',
  Retractor: 'M4 20L15 9M15 9c3-3 6-1 5 2M15 9c-3-3-1-6 2-5M20 11l-2 1M17 4l-1 2',
  Pin: 'M9 3h6l-1 6 3 4H7l3-4zM12 13v8',
  undo: 'M9 7L4 12l5 5M4 12h10a6 6 0 0 1 0 8',
  redo: 'M15 7l5 5-5 5M20 12H10a6 6 0 0 0 0 8',
  reset: 'M5 5v6h6M5.5 11A7.5 7.5 0 1 1 5 15',
  figures: 'M4 20h16M7 16v-5M12 16V6M17 16v-8',
  link: 'M10 14a4 4 0 0 0 6 0l3-3a4 4 0 0 0-6-6l-1 1M14 10a4 4 0 0 0-6 0l-3 3a4 4 0 0 0 6 6l1-1',
  shot: 'M4 8h4l2-3h4l2 3h4v11H4zM12 10a3.5 3.5 0 1 0 .01 0',
  theme: 'M12 4a8 8 0 1 0 .01 0M12 4v16M12 8h5M12 12h8M12 16h5',
  help: 'M12 3a9 9 0 1 0 .01 0M9.5 9.5a2.5 2.5 0 1 1 3.5 2.3c-.7.4-1 .9-1 1.7M12 17v.01',
};
const NAMESPACE = 'http://www.w3.org/2000/svg';

export function icon(name) {
  const drawing = document.createElementNS(NAMESPACE, 'svg');
  drawing.setAttribute('viewBox', '0 0 24 24');
  drawing.setAttribute('aria-hidden', 'true');
  const path = document.createElementNS(NAMESPACE, 'path');
  path.setAttribute('d', PATHS[name]);
  drawing.append(path);
  return drawing;
}
