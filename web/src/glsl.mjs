// SPDX-License-Identifier: Apache-2.0
// The window's shaders as WebGL 2 takes them. A shader that differs from what is expected is not guessed at.
export const HEAD = 'precision highp float;\nprecision highp int;\nprecision highp sampler2D;\nprecision highp sampler3D;\nprecision highp sampler2DShadow;\n';

/** Replaces texts; throws where one is not there any more. */
function replaced(text, pairs) {
  for (const [from, to] of pairs) {
    if (!text.includes(from)) throw new Error(`the window's shader has no "${from}" any more; see web/src/glsl.mjs`);
    text = text.replaceAll(from, to);
  }
  return text;
}

/** WebGL has no texture buffers: what a triangle is comes with its corners. */
export function surfaceShader({ vertex, fragment }, isPlain) {
  const vertexShader = replaced(vertex, [['void main() {', 'in uvec4 look;\nflat out uvec4 look_here;\nvoid main() {\n  look_here = look;']]);
  const fragmentShader = replaced(fragment, [
    ['uniform usamplerBuffer looks;', 'flat in uvec4 look_here;'],
    ['texelFetch(looks, gl_PrimitiveID)', 'look_here'],
  ]);
  return { vertexShader: HEAD + vertexShader, fragmentShader: HEAD + (isPlain ? plain(fragmentShader) : fragmentShader) };
}

/** For processors that draw: no noise, and no bumps of it; layers and materials stay. */
function plain(fragment) {
  return replaced(fragment, [
    ['uniform sampler3D noise;  // repeats', ''],
    ['return 0.65 * texture(noise, at).r + 0.35 * texture(noise, 3.7 * at + 0.31).r;', 'return 0.5;'],
    ['texture(noise, place.xyz * vec3(0.6, 4.0, 4.0)).r', '0.5'],
    ['texture(noise, place.xyz * 9.0).r', '0.5'],
    ['if (is_tissue) n = bumped(n,', 'if (false) n = bumped(n,'],
  ]);
}

/** Rows of numbers of one kind: what the window has as whole numbers comes as others. */
export const withTraits = (vertex, from) => replaced(vertex, [[`in ${from} traits;`, `in ${from.slice(1)} traits_of;\n#define traits ${from}(traits_of)`]]);

/** WebGL interpolates in perspective alone. With a depth of 1 that is what the window's way across the picture is. */
export function lineShader({ vertex, fragment }) {
  const flat = replaced(withTraits(vertex, 'uvec3'), [
    ['noperspective out', 'out'],
    ['nearer * to_clip[3][2], at.w);', 'nearer * to_clip[3][2], at.w);\n  gl_Position /= at.w;'],
  ]);
  return { vertexShader: HEAD + flat, fragmentShader: HEAD + replaced(fragment, [['noperspective in', 'in']]) };
}

export const rimShader = ({ vertex, fragment }) => ({ vertexShader: HEAD + vertex, fragmentShader: HEAD + fragment });

export const ballShader = ({ vertex, fragment }) => ({ vertexShader: HEAD + withTraits(vertex, 'uvec2'), fragmentShader: HEAD + fragment });

export const triangleShader = ({ vertex, fragment }) => ({
  vertexShader: HEAD + replaced(vertex, [['in uint style;', 'in float style;'], ['look = style;', 'look = uint(style);']]),
  fragmentShader: HEAD + fragment,
});

export const solidShader = ({ vertex, fragment }) => ({ vertexShader: HEAD + vertex, fragmentShader: HEAD + fragment });

export const GROUND = {
  vertexShader: `${HEAD}
out float height;
void main() {
  vec2 place = vec2((gl_VertexID & 1) * 2, (gl_VertexID >> 1) * 2);
  height = place.y;
  gl_Position = vec4(2.0 * place - 1.0, 1, 1);
}`,
  fragmentShader: `${HEAD}
in float height;
uniform vec3 top, bottom;
out vec4 color;
void main() { color = vec4(mix(bottom, top, height), 1); }`,
};
