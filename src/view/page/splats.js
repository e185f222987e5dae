// SPDX-FileCopyrightText: 2026 The liod authors
// SPDX-License-Identifier: MIT
// The map's points for browsers that draw WebGL in software. Such a renderer takes 0.3 us a point; here
// they are projected in plain JavaScript into a picture, at a twentieth of that, which is then drawn
// behind everything else.
import {BufferAttribute, BufferGeometry, DataTexture, Mesh, ShaderMaterial} from "./three.js";

const VERTEX = `
varying vec2 place;
void main() {
  place = 0.5 * position.xy + 0.5;
  gl_Position = vec4(position.xy, 0.0, 1.0);
}`;
const FRAGMENT = `
uniform sampler2D picture;
varying vec2 place;
void main() { gl_FragColor = texture2D(picture, place); }`;
const SHADES = 64, BACKGROUND = 0xff120e0b;
const NEAR_M = 80;  // up to there a point is four pixels

// The address ends with #webgl where a test wants WebGL all the same.
export function isSoftware(gl) {
  if (location.hash === "#webgl") return false;
  const info = gl.getExtension("WEBGL_debug_renderer_info");
  return /swiftshader|llvmpipe|softpipe|software|basic render/i.test(info ? gl.getParameter(info.UNMASKED_RENDERER_WEBGL) : "");
}

// The colours of cloud.js by height, as words of the picture: alpha, blue, green, red.
function shades() {
  const stops = [[41, 64, 158], [31, 158, 184], [115, 204, 97], [242, 199, 77]];
  return Uint32Array.from({length: SHADES}, (_, i) => {
    const at = 3 * i / (SHADES - 1), k = Math.min(2, Math.floor(at)), f = at - k;
    const [r, g, b] = [0, 1, 2].map(c => Math.round(stops[k][c] * (1 - f) + stops[k + 1][c] * f));
    return (255 << 24 | b << 16 | g << 8 | r) >>> 0;
  });
}

export class Splats {
  constructor() {
    this.shades = shades();
    this.material = new ShaderMaterial({vertexShader: VERTEX, fragmentShader: FRAGMENT, depthTest: false,
      depthWrite: false, uniforms: {picture: {value: null}}});
    const corners = new BufferAttribute(Float32Array.of(-1, -1, 0, 3, -1, 0, -1, 3, 0), 3);
    this.mesh = new Mesh(new BufferGeometry().setAttribute("position", corners), this.material);
    this.mesh.frustumCulled = false;
    this.mesh.renderOrder = -1;
  }

  resize(width, height) {
    this.width = width;
    this.height = height;
    this.words = new Uint32Array(width * height);
    this.depths = new Float32Array(width * height);
    this.texture?.dispose();
    this.texture = new DataTexture(new Uint8Array(this.words.buffer), width, height);
    this.material.uniforms.picture.value = this.texture;
  }

  // `whole` maps the map's coordinates to those of clipping, in the order of three.js' matrices.
  draw(blocks, whole, low, scale) {
    this.words.fill(BACKGROUND);
    this.depths.fill(Infinity);
    for (const {xyz, num, points} of blocks) if (points.visible) this.drawBlock(xyz.array, num, whole, low, scale);
    this.texture.needsUpdate = true;
  }

  drawBlock(xyz, num, whole, low, scale) {
    const [m0, m1, , m3, m4, m5, , m7, m8, m9, , m11, m12, m13, , m15] = whole;
    const {words, depths, width, height, shades: inks} = this, halfWidth = width / 2, halfHeight = height / 2;
    const [, , m2, , , , m6, , , , m10, , , , m14] = whole;
    for (let i = 0; i < 3 * num; i += 3) {
      const x = xyz[i], y = xyz[i + 1], z = xyz[i + 2], w = m3 * x + m7 * y + m11 * z + m15;
      if (w <= 0.1) continue;
      const column = (1 + (m0 * x + m4 * y + m8 * z + m12) / w) * halfWidth | 0;
      const row = (1 + (m1 * x + m5 * y + m9 * z + m13) / w) * halfHeight | 0;
      if (column < 0 || column >= width || row < 0 || row >= height) continue;
      const depth = (m2 * x + m6 * y + m10 * z + m14) / w, at = row * width + column;
      if (depth >= depths[at]) continue;
      const ink = inks[Math.max(0, Math.min(SHADES - 1, (z - low) * scale * SHADES | 0))];
      depths[at] = depth;
      words[at] = ink;
      if (w > NEAR_M || column + 1 >= width || row + 1 >= height) continue;
      for (let k = 1; k < 4; ++k) {
        const beside = at + (k & 1) + (k >> 1) * width;
        if (depth >= depths[beside]) continue;
        depths[beside] = depth;
        words[beside] = ink;
      }
    }
  }
}
